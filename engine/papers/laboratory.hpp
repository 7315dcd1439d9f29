/// Whom an item of a paper asks for campaigns and runs: the engine has no threads, so somebody else makes them.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/run/campaign.hpp"
#include "engine/scenario/scenario.hpp"

namespace vigil::papers {

/// A figure with its standard error; NaN where there is none.
struct Estimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  double se = std::numeric_limits<double>::quiet_NaN();
};

/// What a campaign left: summaries, and each trial's value in the order of seeds.
class Study {
 public:
  /// Throws std::out_of_range naming the metric where the campaign has none of it.
  Estimate at(const std::string& lane, const std::string& name, const std::string& node = "",
              const std::string& variant = "") const;
  const MetricSummary& row(const std::string& lane, const std::string& name, const std::string& node = "",
                           const std::string& variant = "") const;
  const std::vector<double>& values(const std::string& lane, const std::string& name, const std::string& node = "",
                                    const std::string& variant = "") const;

  void add(const TrialResult& trial);
  void close(const std::vector<MetricSummary>& summary);

  Json design;  ///< of the first trial
  std::int64_t runs = 0;

 private:
  std::map<std::string, MetricSummary> rows_;
  std::map<std::string, std::vector<double>> values_;
};

/// Chosen signals of one run, tick by tick from 0 on; NaN where missing.
class Record {
 public:
  explicit Record(const std::vector<std::string>& names);
  /// Throws std::out_of_range naming the signal that was not asked for.
  const std::vector<double>& of(const std::string& name) const;
  double at(const std::string& name, std::size_t k) const { return of(name).at(k); }
  std::size_t ticks() const { return time.size(); }

  std::vector<double> time;  ///< s
  std::map<std::string, std::vector<double>> series;
};

using Records = std::vector<Record>;  ///< in the order of seeds

/// Runs a scenario to its end and keeps the chosen signals. Throws InputError, and std::out_of_range where the run has
/// no such signal. designs: as RunOptions has them.
Record record_run(const Scenario& scenario, std::uint64_t seed, const std::vector<std::string>& signals,
                  const Json& designs);

/// Answers stay the same object for the same question, so items share what they have in common.
class Laboratory {
 public:
  virtual ~Laboratory() = default;
  virtual std::int64_t runs() const = 0;         ///< of a campaign, as asked for
  virtual std::uint64_t first_seed() const = 0;  ///< trial i has seed first + i
  virtual std::shared_ptr<const Study> campaign(const Scenario& scenario, std::int64_t runs) = 0;
  virtual std::shared_ptr<const Records> samples(const Scenario& scenario, const std::vector<std::string>& signals,
                                                 std::int64_t runs) = 0;

  std::shared_ptr<const Study> campaign(const Scenario& scenario) { return campaign(scenario, runs()); }
  std::shared_ptr<const Records> samples(const Scenario& scenario, const std::vector<std::string>& signals) {
    return samples(scenario, signals, runs());
  }
};

/// The scenario with these lanes only: a lane's draws do not depend on the others.
Scenario only(const Scenario& scenario, const std::vector<std::string>& lanes);
/// A preset with these lanes only and a merge patch over it.
Scenario preset(const std::string& id, const std::vector<std::string>& lanes, const Json& patch = Json::object());

}  // namespace vigil::papers
