/// A trial as bytes and back: what crosses from the process that made it to the one that merges.
#include <stdexcept>

#include "engine/core/bytes.hpp"
#include "engine/run/campaign_state.hpp"

namespace vigil {
namespace {

constexpr std::uint64_t kFormat = 0x3230'4c41'4952'5456;  // "VTRIAL02"
constexpr int kMostStates = 10'000;

void put(ByteWriter& out, const MetricValue& metric) {
  for (const std::string* word : {&metric.lane, &metric.node, &metric.name, &metric.variant}) out.text(*word);
  out.number(metric.value);
  out.word(metric.boolean ? 1 : 0);
}

MetricValue metric_of(ByteReader& in) {
  MetricValue metric;
  for (std::string* word : {&metric.lane, &metric.node, &metric.name, &metric.variant}) *word = in.text();
  metric.value = in.number();
  metric.boolean = in.word() != 0;
  return metric;
}

void put(ByteWriter& out, const FaultCount& fault) {
  for (const std::string* word : {&fault.lane, &fault.node, &fault.code, &fault.detail}) out.text(*word);
  for (const std::int64_t number : {fault.first, fault.last, fault.count}) out.integer(number);
  out.word(fault.stopped ? 1 : 0);
}

FaultCount fault_of(ByteReader& in) {
  FaultCount fault;
  for (std::string* word : {&fault.lane, &fault.node, &fault.code, &fault.detail}) *word = in.text();
  for (std::int64_t* number : {&fault.first, &fault.last, &fault.count}) *number = in.integer();
  fault.stopped = in.word() != 0;
  return fault;
}

void put(ByteWriter& out, const std::vector<double>& numbers) {
  out.word(numbers.size());
  for (const double number : numbers) out.number(number);
}

std::vector<double> numbers_of(ByteReader& in) {
  std::vector<double> numbers(in.count(8));
  for (double& number : numbers) number = in.number();
  return numbers;
}

void put(ByteWriter& out, const BoundRecord& record) {
  out.text(record.lane);
  out.integer(record.states);
  put(out, record.errors);
  put(out, record.bounds);
}

/// The sizes fit each other, as BoundRatio takes for granted.
BoundRecord bound_of(ByteReader& in) {
  BoundRecord record;
  record.lane = in.text();
  const std::int64_t states = in.integer();
  record.errors = numbers_of(in);
  record.bounds = numbers_of(in);
  if (states < 0 || states > kMostStates) throw std::runtime_error("A saved trial has bounds of an impossible size.");
  record.states = static_cast<int>(states);
  const auto n = static_cast<std::size_t>(states);
  const bool fits = record.errors.empty() || n == 0 ||
                    (record.errors.size() % n == 0 && record.bounds.size() == record.errors.size() * n);
  if (!fits) throw std::runtime_error("A saved trial has errors and bounds that do not fit.");
  return record;
}

void put(ByteWriter& out, const std::pair<std::string, BoundSums>& sums) {
  out.text(sums.first);
  sums.second.save(out);
}

std::pair<std::string, BoundSums> sums_of(ByteReader& in) {
  std::pair<std::string, BoundSums> sums;
  sums.first = in.text();
  sums.second.load(in);
  return sums;
}

void put(ByteWriter& out, const RatioRecord& ratio) {
  for (const std::string* word : {&ratio.lane, &ratio.name, &ratio.variant}) out.text(*word);
  out.number(ratio.above);
  out.number(ratio.below);
}

RatioRecord ratio_of(ByteReader& in) {
  RatioRecord ratio;
  for (std::string* word : {&ratio.lane, &ratio.name, &ratio.variant}) *word = in.text();
  ratio.above = in.number();
  ratio.below = in.number();
  return ratio;
}

void put(ByteWriter& out, const DetectionSummary& detection) {
  out.text(detection.lane);
  out.text(detection.node);
  detection.counts.save(out);
}

DetectionSummary detection_of(ByteReader& in) {
  DetectionSummary detection;
  detection.lane = in.text();
  detection.node = in.text();
  detection.counts.load(in);
  return detection;
}

template <class Item>
void put_all(ByteWriter& out, const std::vector<Item>& items) {
  out.word(items.size());
  for (const Item& item : items) put(out, item);
}

template <class Item>
std::vector<Item> all_of(ByteReader& in, Item (*read)(ByteReader&)) {
  std::vector<Item> items;
  for (std::size_t left = in.count(8); left > 0; --left) items.push_back(read(in));
  return items;
}

}  // namespace

std::string save_trial(const TrialResult& trial) {
  ByteWriter out;
  out.word(kFormat);
  out.word(trial.seed);
  out.integer(trial.ticks);
  out.text(trial.error);
  out.text(trial.design.dump());
  put_all(out, trial.metrics);
  put_all(out, trial.faults);
  out.word(trial.warnings.size());
  for (const std::string& warning : trial.warnings) out.text(warning);
  out.word(trial.more ? 1 : 0);
  out.word(trial.extra ? 1 : 0);
  if (!trial.extra) return out.take();
  put_all(out, trial.extra->bounds);
  put_all(out, trial.extra->sums);
  put_all(out, trial.extra->ratios);
  put_all(out, trial.extra->detection);
  return out.take();
}

TrialResult load_trial(std::string_view bytes) {
  ByteReader in(bytes);
  if (in.word() != kFormat) throw std::runtime_error("These bytes are no trial.");
  TrialResult trial;
  trial.seed = in.word();
  trial.ticks = in.integer();
  trial.error = in.text();
  trial.design = Json::parse(in.text(), nullptr, false);
  if (trial.design.is_discarded()) throw std::runtime_error("A saved trial's design is damaged.");
  trial.metrics = all_of(in, metric_of);
  trial.faults = all_of(in, fault_of);
  for (std::size_t left = in.count(8); left > 0; --left) trial.warnings.push_back(in.text());
  trial.more = in.word() != 0;
  if (in.word() != 0) {
    trial.extra = std::make_unique<TrialResult::Extra>();
    trial.extra->bounds = all_of(in, bound_of);
    trial.extra->sums = all_of(in, sums_of);
    trial.extra->ratios = all_of(in, ratio_of);
    trial.extra->detection = all_of(in, detection_of);
  }
  if (!in.done()) throw std::runtime_error("A saved trial has something left over.");
  return trial;
}

}  // namespace vigil
