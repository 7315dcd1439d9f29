#include "engine/papers/laboratory.hpp"

#include <algorithm>
#include <stdexcept>

#include "engine/run/run.hpp"

namespace vigil::papers {
namespace {

std::string key(const std::string& lane, const std::string& name, const std::string& node, const std::string& variant) {
  return lane + " " + name + " " + node + " " + variant;
}

template <typename Map>
const typename Map::mapped_type& find(const Map& map, const std::string& name, const char* what) {
  const auto place = map.find(name);
  if (place == map.end()) throw std::out_of_range(std::string(what) + " " + name);
  return place->second;
}

/// Keeps the chosen signals of the frames that pass.
class Keeper final : public Sink {
 public:
  Keeper(Record& record, const Catalogue& catalogue, const std::vector<std::string>& names) : record_(record) {
    for (const std::string& name : names) {
      const int id = catalogue.find(name);
      if (id < 0) throw std::out_of_range("no signal " + name);
      kept_.emplace_back(static_cast<std::size_t>(id), &record.series.at(name));
    }
  }
  void frame(const Frame& frame) override {
    record_.time.push_back(frame.t);
    for (const auto& [id, values] : kept_) values->push_back(frame.values[id]);
  }
  void mark(const Mark& /*mark*/) override {}

 private:
  Record& record_;
  std::vector<std::pair<std::size_t, std::vector<double>*>> kept_;
};

}  // namespace

Estimate Study::at(const std::string& lane, const std::string& name, const std::string& node,
                   const std::string& variant) const {
  const MetricSummary& found = row(lane, name, node, variant);
  if (found.n > 1 && found.min == found.max) return {found.min, 0};  // a sum's rounding is no error of theirs
  return {found.mean, found.se};
}

const MetricSummary& Study::row(const std::string& lane, const std::string& name, const std::string& node,
                                const std::string& variant) const {
  return find(rows_, key(lane, name, node, variant), "no metric");
}

const std::vector<double>& Study::values(const std::string& lane, const std::string& name, const std::string& node,
                                         const std::string& variant) const {
  return find(values_, key(lane, name, node, variant), "no metric");
}

void Study::add(const TrialResult& trial) {
  if (runs++ == 0) design = trial.design;
  for (const MetricValue& m : trial.metrics) values_[key(m.lane, m.name, m.node, m.variant)].push_back(m.value);
}

void Study::close(const std::vector<MetricSummary>& summary) {
  for (const MetricSummary& row : summary) rows_[key(row.key.lane, row.key.name, row.key.node, row.key.variant)] = row;
}

Record::Record(const std::vector<std::string>& names) {
  for (const std::string& name : names) series[name];
}

const std::vector<double>& Record::of(const std::string& name) const { return find(series, name, "no signal"); }

Record record_run(const Scenario& scenario, std::uint64_t seed, const std::vector<std::string>& signals,
                  const Json& designs) {
  RunOptions options;
  options.seed = seed;
  options.designs = designs;
  Run run(scenario, std::move(options));
  Record record(signals);
  Keeper keeper(record, run.catalogue(), signals);
  while (!run.done()) run.step(keeper);
  return record;
}

Scenario only(const Scenario& scenario, const std::vector<std::string>& lanes) {
  Json patch = {{"lanes", Json::object()}};
  for (const auto& [id, lane] : scenario.document().at("lanes").items()) {
    if (std::find(lanes.begin(), lanes.end(), id) == lanes.end()) patch["lanes"][id] = nullptr;
  }
  return scenario.patched(patch);
}

Scenario preset(const std::string& id, const std::vector<std::string>& lanes, const Json& patch) {
  return only(Scenario::preset(id), lanes).patched(patch);
}

}  // namespace vigil::papers
