/// What a message of a plant says, as rows of one run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/ingest/plant_options.hpp"
#include "server/ingest/read_rows.hpp"

namespace vigil {

/// What a topic says of its messages; empty where it does not.
struct TopicPlace {
  std::string run;  ///< id or name
  std::string node;
  std::string channel;  ///< of the node, or where there is none a whole name or one of the plant's
};

class PlantReader {
 public:
  /// References outlive it. `dt` in s. Throws InputError below /input/ingest/mqtt/signals where a column is not there.
  PlantReader(const PushedColumns& columns, const RowReader& rows, PlantOptions options, double dt);

  const PlantOptions& options() const { return options_; }

  /// A topic with a channel brings one value (a number, "null", "true", "false", or {"value",…}), every other one rows:
  /// as POST /ingest/{run} takes them, or flat objects whose members are channels. Under the clock "arrival" k is 0.
  /// Throws HttpError and InputError with one sentence.
  std::vector<IngestRow> read(const TopicPlace& place, const std::string& payload);

 private:
  std::vector<IngestRow> read_message(const TopicPlace& place, const std::string& payload);
  IngestRow value(const TopicPlace& place, const std::string& payload);
  IngestRow object(const TopicPlace& place, const Json& message, std::size_t index);
  Json row_of(const TopicPlace& place, const Json& message) const;
  std::string column(const std::string& name) const;
  void set_tick(const Json& message, Json& row);
  std::uint64_t tick_at(double seconds);

  const PushedColumns& columns_;
  const RowReader& rows_;
  const PlantOptions options_;
  const double dt_;
  std::optional<double> start_;  ///< s: when tick 0 is
};

/// s of a number (beyond 1e11 it is in ms, beyond 1e14 in us, beyond 1e17 in ns) or of a text as ISO 8601; empty where
/// it is neither.
std::optional<double> plant_seconds(const Json& value);

}  // namespace vigil
