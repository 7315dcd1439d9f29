/// What was asked of a run, complete and checked: from the API, a fork, an import, the demo or the command line.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "db/writer.hpp"
#include "engine/run/run.hpp"
#include "engine/run/trace.hpp"
#include "engine/scenario/scenario.hpp"
#include "server/hub/hub.hpp"
#include "server/ingest/ingest_feed.hpp"
#include "server/runs/pace.hpp"
#include "server/webhook/webhooks.hpp"

namespace vigil {

/// Seeds beyond this would not survive a browser's numbers.
inline constexpr std::uint64_t kLargestSeed = 9'007'199'254'740'991;

struct RunOrder {
  Scenario scenario;
  std::uint64_t seed = 1;
  Pace pace;
  std::optional<std::int64_t> trace_id;  ///< in the log
  std::shared_ptr<const Trace> trace;    ///< its content
  std::shared_ptr<IngestFeed> feed;      ///< rows are pushed into the run; then there is no other trace
  std::optional<WebhookUrl> webhook;     ///< where its alarms are sent
  std::vector<std::string> tags;
  std::string note;
  std::optional<RunParent> parent;
  Json designs = Json::object();     ///< {"<lane>":record}: gains, for every task of the scenario when the run is made
  std::vector<Command> commands;     ///< that belong to the run from the start
  std::int64_t fast_until = -1;      ///< up to this tick the pace is not kept: what is repeated needs no waiting for
  std::optional<std::int64_t> last;  ///< the run ends after this tick, whatever its document says
  std::string end_state = "finished";  ///< the state it ends in then
  std::string idempotency_key, idempotency_hash;
  bool sleeps_unwatched = false;  ///< the demo: no ticks while nobody watches
};

/// Throws InputError where the scenario cannot be run as it is, also where it lacks a design.
Run make_run(const RunOrder& order);
/// The row the log gets. `run` was made from `order`.
RunRecord make_record(const RunOrder& order, const Run& run);
/// The row of a run that cannot be made yet: dt and steps are the document's.
RunRecord make_record(const RunOrder& order);

/// The document's "log" in the log's own terms. Where the document says nothing, a paced run is live, others lossless.
LogPolicy log_policy(const Json& document, const Pace& pace);
std::optional<double> log_keep(const Json& document);
/// Patterns that fit no signal select nothing; if none fits any, all signals are kept.
LogSelection log_selection(const Json& document, const Catalogue& catalogue);

/// overview, lane:<lane> in document order, all.
std::vector<HubTopic> hub_topics(const Catalogue& catalogue, const Json& document);

/// The features of this processor that may change the last bit of a sum, as one word list.
std::string cpu_features();

}  // namespace vigil
