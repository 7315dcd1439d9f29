/// The order of a list of runs, and the place in it where a page begins.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "db/database.hpp"
#include "db/query.hpp"

namespace vigil {

class RowOrder {
 public:
  /// Adds what it binds to `values`. Throws QueryError on an unknown field or a cursor that is not of this order.
  RowOrder(std::string_view sort, std::string_view cursor, std::vector<Query::Value>& values);
  const std::string& key() const { return key_; }      ///< the expression sorted by
  const std::string& after() const { return after_; }  ///< a condition: behind the cursor
  std::string clause() const;                          ///< " ORDER BY …" over the alias sort_key
  std::string cursor_of(const Statement& row, int key_column, std::int64_t id) const;

 private:
  void read_cursor(std::string_view cursor, std::vector<Query::Value>& values);
  std::string sort_;
  bool falling_ = true;
  std::string key_;
  std::string after_ = "1";
};

}  // namespace vigil
