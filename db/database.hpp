/// SQLite held by its scope: connections and statements.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>

namespace vigil {

/// SQLite refused; `code` is its extended result code.
class SqlError : public std::runtime_error {
 public:
  SqlError(int code, const std::string& what) : std::runtime_error(what), code_(code) {}
  int code() const { return code_; }
  /// The disk, not the request: the same transaction may succeed later.
  bool disk() const;

 private:
  int code_;
};

/// A prepared statement. Columns and parameters are bound from 1, read from 0. Throws SqlError.
class Statement {
 public:
  /// A statement of its own, finalised at the end.
  Statement(sqlite3* connection, std::string_view sql);
  /// A borrowed one, reset at the end.
  explicit Statement(sqlite3_stmt* borrowed) : statement_(borrowed), owned_(false) {}
  ~Statement();
  Statement(Statement&& other) noexcept;
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& bind(int index, std::int64_t value);
  Statement& bind(int index, int value) { return bind(index, std::int64_t{value}); }
  Statement& bind(int index, bool value) { return bind(index, std::int64_t{value}); }
  Statement& bind(int index, double value);  ///< NaN becomes NULL
  Statement& bind(int index, std::string_view text);
  Statement& bind(int index, const char* text) { return bind(index, std::string_view(text)); }
  Statement& bind(int index, const std::string& text) { return bind(index, std::string_view(text)); }
  Statement& bind(int index, std::nullopt_t);
  /// The bytes must outlive the statement's run.
  Statement& blob(int index, std::string_view bytes);
  template <class T>
  Statement& bind(int index, const std::optional<T>& value) {
    return value ? bind(index, *value) : bind(index, std::nullopt);
  }
  /// Binds 1, 2, … in order.
  template <class... Values>
  Statement& all(const Values&... values) {
    int index = 0;
    (bind(++index, values), ...);
    return *this;
  }

  bool step();  ///< true: a row
  void run();   ///< to the end, then reset for the next values
  void reset();

  bool null(int column) const;
  int type(int column) const { return sqlite3_column_type(statement_, column); }
  std::int64_t integer(int column) const;
  double real(int column) const;  ///< NULL is NaN
  std::string text(int column) const;
  std::string_view bytes(int column) const;  ///< until the next step
  std::optional<std::int64_t> maybe_integer(int column) const;
  std::optional<double> maybe_real(int column) const;

 private:
  void check(int code) const;
  sqlite3_stmt* statement_ = nullptr;
  bool owned_ = true;
};

/// The parts of a text one after another.
std::string joined(std::initializer_list<std::string_view> parts);

class Database {
 public:
  enum class Mode { create, read_write, read_only };
  Database(const std::string& path, Mode mode);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  sqlite3* handle() const { return handle_; }
  void execute(const std::string& sql);
  /// Prepared once and kept; for constant texts.
  Statement cached(std::string_view sql);
  Statement statement(std::string_view sql) const { return Statement(handle_, sql); }
  std::int64_t integer(const std::string& sql) const;  ///< first column of the first row
  std::string text(const std::string& sql) const;
  std::int64_t last_id() const { return sqlite3_last_insert_rowid(handle_); }
  int changes() const { return sqlite3_changes(handle_); }
  bool in_transaction() const { return sqlite3_get_autocommit(handle_) == 0; }
  void roll_back() noexcept;

 private:
  sqlite3* handle_ = nullptr;
  std::unordered_map<std::string, sqlite3_stmt*> cache_;
};

/// One transaction: rolled back at the end of its scope unless committed.
class Transaction {
 public:
  explicit Transaction(Database& database, const char* begin = "BEGIN IMMEDIATE") : database_(database) {
    database_.cached(begin).run();
  }
  ~Transaction() {
    if (!done_) database_.roll_back();
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit() {
    database_.cached("COMMIT").run();
    done_ = true;
  }

 private:
  Database& database_;
  bool done_ = false;
};

}  // namespace vigil
