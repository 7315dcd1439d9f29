/// A trial that is kept as an ordinary run, with its samples.
#pragma once

#include "db/writer.hpp"
#include "server/runs/campaign_runner.hpp"

namespace vigil {

/// Used by one worker. A run of the same trial that a crash left behind is replaced.
class SampledRun final : public Sink {
 public:
  SampledRun(LogWriter& log, std::int64_t campaign, std::int64_t index, const CampaignPlan& plan, const Run& run);
  ~SampledRun() override;  ///< deletes a run that was not finished: its trial does not count
  SampledRun(const SampledRun&) = delete;
  SampledRun& operator=(const SampledRun&) = delete;
  RunId id() const { return id_; }
  void frame(const Frame& frame) override { log_.frame(id_, frame); }
  void mark(const Mark& mark) override { log_.mark(id_, mark); }
  void finish(const Run& run);

 private:
  LogWriter& log_;
  RunId id_ = 0;
  bool finished_ = false;
};

}  // namespace vigil
