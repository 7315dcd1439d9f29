/// A laboratory with threads: campaigns as `vigil campaign` runs them, and runs whose samples are kept.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <string>

#include "engine/papers/laboratory.hpp"
#include "engine/run/design.hpp"

namespace vigil {

struct LaboratoryOptions {
  std::int64_t runs = 200;
  std::uint64_t first_seed = 1;
  int threads = 1;
  std::function<Json(const DesignTask&)> gains;  ///< the record of a task; not called from more than one thread
  std::function<void(std::int64_t)> progress;    ///< runs done so far, all together
  const std::atomic<bool>* stop = nullptr;       ///< once true, whatever is asked for throws TrialGivenUp
  int nice = 0;                                  ///< of the threads
};

class ThreadedLaboratory final : public papers::Laboratory {
 public:
  explicit ThreadedLaboratory(LaboratoryOptions options) : options_(std::move(options)) {}

  std::int64_t runs() const override { return options_.runs; }
  std::uint64_t first_seed() const override { return options_.first_seed; }
  std::shared_ptr<const papers::Study> campaign(const Scenario& scenario, std::int64_t runs) override;
  /// At most kMostRecords runs: samples are held in memory.
  std::shared_ptr<const papers::Records> samples(const Scenario& scenario, const std::vector<std::string>& signals,
                                                 std::int64_t runs) override;
  using Laboratory::campaign;
  using Laboratory::samples;
  std::int64_t done() const { return done_; }

  static constexpr std::int64_t kMostRecords = 1000;

 private:
  Json designs_of(const Scenario& scenario) const;
  void advance(std::int64_t runs);
  void check_stop() const;

  const LaboratoryOptions options_;
  std::map<std::string, std::shared_ptr<const papers::Study>> studies_;
  std::map<std::string, std::shared_ptr<const papers::Records>> records_;
  std::int64_t done_ = 0;
};

}  // namespace vigil
