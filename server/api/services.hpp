/// What the routes work with.
#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "db/reader.hpp"
#include "db/writer.hpp"
#include "server/campaigns/manager.hpp"
#include "server/front/front.hpp"
#include "server/hub/hub.hpp"
#include "server/plant/outside.hpp"
#include "server/runs/manager.hpp"

namespace vigil {

/// References live as long as the server. Handlers run on many threads; all of these allow it.
struct Services {
  LogWriter& log;
  const LogReader& reader;
  Hub& hub;
  RunManager& runs;
  CampaignManager& campaigns;
  std::function<FrontStats()> stats;           ///< of the front
  std::function<const Routes&()> routes;       ///< the table as the front has it, its own routes included
  std::function<std::optional<RunId>()> demo;  ///< the demo run, if one was started
  bool auth = false;                           ///< a token is asked for
  const Broker* broker = nullptr;              ///< NATS; null: none
  const Outside* outside = nullptr;            ///< topics that feed runs, sinks of alarms
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
};

// One file each; every one adds its routes to the table. `services` outlives the table.
void add_scenario_routes(Routes& routes, Services& services);
void add_run_routes(Routes& routes, Services& services);
void add_control_routes(Routes& routes, Services& services);
void add_design_routes(Routes& routes, Services& services);
void add_check_routes(Routes& routes, Services& services);
void add_compatibility_routes(Routes& routes, Services& services);
void add_data_routes(Routes& routes, Services& services);
void add_compare_routes(Routes& routes, Services& services);
void add_campaign_routes(Routes& routes, Services& services);
void add_trial_routes(Routes& routes, Services& services);  ///< called by the one above
void add_bundle_routes(Routes& routes, Services& services);
void add_trace_routes(Routes& routes, Services& services);
void add_ingest_routes(Routes& routes, Services& services);
void add_stream_routes(Routes& routes, Services& services);
void add_system_routes(Routes& routes, Services& services);
void add_metrics_route(Routes& routes, Services& services);

/// All of the above.
Routes make_routes(Services& services);

}  // namespace vigil
