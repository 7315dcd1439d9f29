/// One trial: how it runs, and how its numbers are kept.
#include <bit>
#include <limits>

#include "engine/core/bytes.hpp"
#include "engine/run/campaign_state.hpp"
#include "engine/run/state.hpp"

namespace vigil {
namespace {

/// Stands for "this trial has no such column"; a metric that is not a number is stored as the ordinary NaN.
constexpr std::uint64_t kAbsent = 0x7ff8'0000'0000'0a55;

class NullSink final : public Sink {
 public:
  void frame(const Frame& /*frame*/) override {}
  void mark(const Mark& /*mark*/) override {}
};

}  // namespace

TrialResult::TrialResult() = default;
TrialResult::TrialResult(TrialResult&&) noexcept = default;
TrialResult& TrialResult::operator=(TrialResult&&) noexcept = default;
TrialResult::~TrialResult() = default;

void prepare_trial(Run& run) {
  if (!run.steps())
    throw InputError("/time/steps", "steps is null: a trial of a campaign must end by itself", "a whole number");
  for (Lane& lane : TrialAccess::state(run).lanes) lane.record_detection();
}

TrialResult take_trial(Run& run) {
  TrialResult result;
  result.seed = run.seed();
  result.metrics = run.metrics();
  result.faults = run.faults();
  result.warnings = run.warnings();
  result.design = run.design();
  result.ticks = run.tick();
  result.extra = std::make_unique<TrialResult::Extra>();
  for (Lane& lane : TrialAccess::state(run).lanes) {
    result.extra->bounds.push_back(lane.take_record());
    if (const FusionSide* side = lane.fusion_side()) side->append_ratios(result.extra->ratios);
    const auto& counts = lane.detection_counts();
    for (std::size_t o = 0; o < counts.size(); ++o) {
      if (counts[o].empty()) continue;
      result.extra->detection.push_back({lane.id(), counts.size() == 1 ? "" : lane.outputs()[o], counts[o]});
    }
  }
  return result;
}

TrialResult run_trial(const Scenario& scenario, std::uint64_t seed, std::shared_ptr<const Trace> trace,
                      const Json& designs) {
  Run run(scenario, {seed, std::move(trace), {}, designs});
  prepare_trial(run);
  NullSink sink;
  while (!run.done()) run.step(sink);
  return take_trial(run);
}

std::string TrialColumns::name_of(const MetricValue& key, char part) {
  std::string name(1, part);
  for (const std::string* word : {&key.lane, &key.node, &key.name, &key.variant}) name += '\0' + *word;
  return name;
}

std::size_t TrialColumns::place(const MetricValue& key, char part) {
  const auto [place, fresh] = places_.try_emplace(name_of(key, part), columns_.size());
  if (fresh) columns_.push_back({{key.lane, key.node, key.name, key.variant, 0, key.boolean}, part});
  return place->second;
}

std::string TrialColumns::encode(const TrialResult& trial) {
  std::vector<std::uint64_t> words(columns_.size(), kAbsent);
  const auto put = [&](const MetricValue& key, char part, double value) {
    const std::size_t at = place(key, part);
    words.resize(columns_.size(), kAbsent);
    words[at] = std::bit_cast<std::uint64_t>(value == value ? value : std::numeric_limits<double>::quiet_NaN());
  };
  for (const MetricValue& metric : trial.metrics) put(metric, 'm', metric.value);
  if (trial.extra) {
    for (const RatioRecord& ratio : trial.extra->ratios) {
      const MetricValue key{ratio.lane, "", ratio.name, ratio.variant, 0, false};
      put(key, 'a', ratio.above);
      put(key, 'b', ratio.below);
    }
  }
  ByteWriter out;
  for (const std::uint64_t word : words) out.word(word);
  return out.take();
}

TrialResult TrialColumns::decode(std::string_view bytes) const {
  if (bytes.size() % 8 != 0 || bytes.size() / 8 > columns_.size())
    throw std::runtime_error("A trial's values do not fit its campaign's columns.");
  TrialResult trial;
  trial.extra = std::make_unique<TrialResult::Extra>();
  ByteReader in(bytes);
  for (const Column& column : columns_) {
    if (in.done()) break;
    const std::uint64_t word = in.word();
    if (word == kAbsent) continue;
    const auto number = std::bit_cast<double>(word);
    if (column.part == 'm') {
      trial.metrics.push_back(column.key);
      trial.metrics.back().value = number;
    } else if (column.part == 'a') {
      trial.extra->ratios.push_back({column.key.lane, column.key.name, column.key.variant, number, 0});
    } else if (!trial.extra->ratios.empty()) {
      trial.extra->ratios.back().below = number;  // its column follows that of `above`
    }
  }
  return trial;
}

int TrialColumns::find(const MetricValue& key) const {
  const auto place = places_.find(name_of(key, 'm'));
  return place == places_.end() ? -1 : static_cast<int>(place->second);
}

double TrialColumns::value(std::string_view bytes, int place) {
  const auto from = 8 * static_cast<std::size_t>(place);
  if (place < 0 || from + 8 > bytes.size()) return std::numeric_limits<double>::quiet_NaN();
  return ByteReader(bytes.substr(from, 8)).number();
}

Json TrialColumns::to_json() const {
  Json list = Json::array();
  for (const Column& column : columns_) {
    Json item{{"lane", column.key.lane},
              {"node", column.key.node},
              {"name", column.key.name},
              {"variant", column.key.variant}};
    if (column.key.boolean) item["boolean"] = true;
    if (column.part != 'm') item["part"] = column.part == 'a' ? "above" : "below";
    list.push_back(std::move(item));
  }
  return list;
}

TrialColumns TrialColumns::from_json(const Json& json) {
  TrialColumns columns;
  for (const Json& item : json) {
    const std::string part = item.value("part", "m");
    columns.place(
        {item.at("lane"), item.at("node"), item.at("name"), item.at("variant"), 0, item.value("boolean", false)},
        part.front());
  }
  return columns;
}

}  // namespace vigil
