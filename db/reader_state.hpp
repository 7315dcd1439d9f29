/// Inside of LogReader: idle read-only connections, handed to one caller at a time.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "db/database.hpp"
#include "db/reader.hpp"
#include "engine/core/json.hpp"

namespace vigil {

/// A column of JSON; null where nothing was written.
inline Json parsed(const std::string& text) { return text.empty() ? Json() : Json::parse(text); }

struct LogReader::State {
  explicit State(std::string file) : path(std::move(file)) {}

  /// A connection for the scope of one call.
  class Lease {
   public:
    Lease(const State& state, std::unique_ptr<Database> database) : state_(state), database_(std::move(database)) {}
    ~Lease() {
      const std::scoped_lock lock(state_.mutex);
      if (state_.idle.size() < 8) state_.idle.push_back(std::move(database_));
    }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    Database* operator->() const { return database_.get(); }
    Database& operator*() const { return *database_; }

   private:
    const State& state_;
    std::unique_ptr<Database> database_;
  };
  Lease lease() const;

  const std::string path;
  mutable std::mutex mutex;
  mutable std::vector<std::unique_ptr<Database>> idle;
};

}  // namespace vigil
