/// Many runs: trial i is the run with seed first + i. The caller brings threads; results do not depend on them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/metrics/paired.hpp"
#include "engine/metrics/roc.hpp"
#include "engine/run/run.hpp"

namespace vigil {

/// What one finished trial leaves behind: its metrics and whatever its metrics' own accumulators need.
class TrialResult {
 public:
  TrialResult();
  TrialResult(TrialResult&&) noexcept;
  TrialResult& operator=(TrialResult&&) noexcept;
  ~TrialResult();

  std::uint64_t seed = 0;
  std::vector<MetricValue> metrics;
  std::vector<FaultCount> faults;
  std::vector<std::string> warnings;
  Json design;
  std::int64_t ticks = 0;
  std::string error;  ///< why there is no result at all; empty: there is one
  bool more = false;  ///< part of what it leaves comes with a later trial of its block
  struct Extra;
  std::unique_ptr<Extra> extra;
};

/// Makes a fresh run keep what a campaign wants of it. Before its first step.
void prepare_trial(Run& run);
/// What the run leaves behind; it keeps its metrics, its records of bounds are taken.
TrialResult take_trial(Run& run);
/// Runs one trial to its end. Throws InputError (the scenario), nothing else of its own. Safe to call from many threads
/// at once. designs: as RunOptions has them.
TrialResult run_trial(const Scenario& scenario, std::uint64_t seed, std::shared_ptr<const Trace> trace = nullptr,
                      const Json& designs = Json::object());

/// Trials are summed in blocks of so many of a campaign's point, the last one shorter.
inline constexpr std::int64_t kTrialBlock = 32;

/// Trials first .. first + count - 1 of the list are a whole block: what a table only sums of them moves to the last,
/// summed. A table gets the same bits from them, as long as it gets all of them.
void pool_block(std::vector<TrialResult>& trials, std::size_t first, std::size_t count);

/// A finished trial as bytes, every bit kept, so that it can be made elsewhere: a table to which load_trial() of it is
/// added is the table to which the trial was added.
std::string save_trial(const TrialResult& trial);
/// Throws std::runtime_error where the bytes are cut off, damaged or of another format.
TrialResult load_trial(std::string_view bytes);

struct MetricSummary {
  MetricValue key;  ///< lane, node, name, variant; value unused
  double mean = 0;  ///< pooled root of the mean square for rmse_… and rms_…
  double se = 0;    ///< standard error (delta method for pooled roots); NaN with fewer than two
  double median = 0, min = 0, max = 0;
  double q05 = 0, q25 = 0, q75 = 0, q95 = 0;  ///< between order statistics, linearly: the median is q50
  std::int64_t n = 0;                         ///< trials with a value
};

Json to_json(const MetricSummary& summary);

/// One metric of two lanes over the trials in which both have it: same seed, same draws.
struct PairedSummary {
  MetricValue key;              ///< lane: the other; value unused
  std::string base;             ///< the lane it is compared with
  PairedDifference difference;  ///< other - base
};

Json to_json(const PairedSummary& summary);

/// Detection of one lane and output over all trials.
struct DetectionSummary {
  std::string lane, node;
  RocCounts counts;
};

/// {"lane","node","attacked","clean","own":{"fpr","tpr"},"by_factor":{"area","points":[[factor,fpr,tpr],…]},
/// "by_threshold":{…}}; the point "never" has null for its threshold.
Json to_json(const DetectionSummary& summary);

/// What a trial's values are called, so that each trial can be kept as plain numbers: doubles, little endian, one a
/// column; a column that a trial lacks holds a NaN of its own. Grows with the trials it sees.
class TrialColumns {
 public:
  std::string encode(const TrialResult& trial);
  /// Metrics and pooled ratios; of everything else nothing. Throws std::runtime_error where the bytes do not fit.
  TrialResult decode(std::string_view bytes) const;
  /// The place of a metric, -1: not there. `key.value` and `key.boolean` do not matter.
  int find(const MetricValue& key) const;
  /// The value at a place; NaN where the trial has none.
  static double value(std::string_view bytes, int place);
  std::size_t size() const { return columns_.size(); }

  Json to_json() const;
  static TrialColumns from_json(const Json& json);

 private:
  struct Column {
    MetricValue key;
    char part = 'm';  ///< m: a metric; a, b: above and below of a ratio
  };
  std::size_t place(const MetricValue& key, char part);
  static std::string name_of(const MetricValue& key, char part);

  std::vector<Column> columns_;
  std::map<std::string, std::size_t> places_;
};

/// Merges trials in the order they are added: add them by seed, whatever order they finished in.
class CampaignTable {
 public:
  CampaignTable();
  CampaignTable(CampaignTable&&) noexcept;
  CampaignTable& operator=(CampaignTable&&) noexcept;
  ~CampaignTable();
  void add(const TrialResult& trial);
  std::vector<MetricSummary> summary() const;
  /// Of every two lanes, in their order, every metric that both have.
  std::vector<PairedSummary> paired() const;
  std::vector<DetectionSummary> detection() const;
  std::int64_t trials() const;

  /// What cannot be had from trials that were encoded: sums of bounds, counts of detectors. A table to which the same
  /// trials are added, decoded, and that then loads this, is the table that saved it, bit for bit.
  std::string save() const;
  /// Throws std::runtime_error where the bytes are damaged.
  void load(std::string_view bytes);

 private:
  void add_values(const TrialResult& trial);
  void add_extra(const TrialResult::Extra& extra);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vigil
