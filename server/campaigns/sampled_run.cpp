#include "server/campaigns/sampled_run.hpp"

#include <spdlog/spdlog.h>

#include <chrono>

#include "server/runs/order.hpp"

namespace vigil {
namespace {

WallTime now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

SampledRun::SampledRun(LogWriter& log, std::int64_t campaign, std::int64_t index, const CampaignPlan& plan,
                       const Run& run)
    : log_(log) {
  const CampaignPoint& point = plan.points[static_cast<std::size_t>(index / plan.runs)];
  RunOrder order;
  order.scenario = point.scenario;
  order.seed = run.seed();
  order.designs = point.designs;
  order.trace_id = plan.trace_id;
  order.tags = {"campaign:" + std::to_string(campaign)};
  order.idempotency_key = "campaign:" + std::to_string(campaign) + ":" + std::to_string(index);
  order.idempotency_hash = order.idempotency_key;
  RunRecord record = make_record(order, run);
  record.policy = LogPolicy::lossless;
  record.state = "running";
  CreatedRun created = log_.create_run(record);
  if (!created.fresh) {
    log_.delete_run(created.id);
    created = log_.create_run(record);
  }
  id_ = created.id;
  log_.set_signals(id_, run.catalogue(), log_selection(record.document, run.catalogue()), LogPolicy::lossless,
                   run.dt());
  RunUpdate update;
  update.started = now();
  log_.post(id_, update);
}

SampledRun::~SampledRun() {
  if (finished_) return;
  try {
    log_.delete_run(id_);
  } catch (const std::exception& failure) {
    spdlog::warn("run {} of a campaign was not removed: {}", id_, failure.what());
  }
}

void SampledRun::finish(const Run& run) {
  RunUpdate update;
  update.state = "finished";
  update.ended = now();
  update.metrics = run.metrics();
  update.faults = run.faults();
  update.warnings = run.warnings();
  update.design = run.design();
  update.world = run.world();
  log_.finish(id_, update);
  finished_ = true;
}

}  // namespace vigil
