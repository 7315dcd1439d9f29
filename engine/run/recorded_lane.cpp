#include "engine/run/recorded_lane.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace vigil {
namespace {

class Recorded final : public Method {
 public:
  Recorded(std::shared_ptr<const Trace> trace, std::vector<std::string> outputs, std::vector<std::vector<int>> columns)
      : trace_(std::move(trace)),
        outputs_(std::move(outputs)),
        columns_(std::move(columns)),
        estimates_(columns_.size()) {
    for (std::size_t o = 0; o < columns_.size(); ++o)
      estimates_[o].resize(static_cast<Eigen::Index>(columns_[o].size()));
    read();
  }

  std::unique_ptr<Method> clone() const override { return std::make_unique<Recorded>(*this); }
  std::vector<std::string> outputs() const override { return outputs_; }
  void predict(const Eigen::VectorXd& /*input*/, FaultReport& /*report*/) override {
    ++k_;
    read();
  }
  void update(const Readings& /*readings*/, std::span<const Delivery> /*inbox*/, FaultReport& /*report*/) override {}
  Belief belief(int output) const override { return {.mean = estimates_[static_cast<std::size_t>(output)].data()}; }
  bool has_bound() const override { return false; }
  void retune(const Params& /*params*/) override {}
  void rewire(const Graph& /*graph*/, const std::vector<LinkRates>& /*rates*/) override {}

 private:
  void read() {
    for (std::size_t o = 0; o < columns_.size(); ++o) {
      for (std::size_t c = 0; c < columns_[o].size(); ++c)
        estimates_[o][static_cast<Eigen::Index>(c)] = trace_->at(k_, columns_[o][c]);
    }
  }

  std::shared_ptr<const Trace> trace_;
  std::vector<std::string> outputs_;
  std::vector<std::vector<int>> columns_;  ///< output, component
  std::vector<Eigen::VectorXd> estimates_;
  std::int64_t k_ = 0;
};

/// "lane.<lane>.<node>.estimate.<component>" -> (lane, node); empty where the name is not of that form.
std::pair<std::string, std::string> lane_and_node(std::string_view name, const std::string& component) {
  const std::string tail = ".estimate." + component;
  if (!name.starts_with("lane.") || !name.ends_with(tail)) return {};
  const std::string_view middle = name.substr(5, name.size() - 5 - tail.size());
  const std::size_t dot = middle.find('.');
  if (dot == std::string_view::npos || middle.find('.', dot + 1) != std::string_view::npos) return {};
  return {std::string(middle.substr(0, dot)), std::string(middle.substr(dot + 1))};
}

}  // namespace

std::vector<RecordedLane> find_recorded_lanes(const std::shared_ptr<const Trace>& trace, const Json& lanes,
                                              const Plant& plant) {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> outputs;
  std::vector<std::vector<std::vector<int>>> columns;
  for (const std::string& column : trace->columns()) {
    const auto [lane, node] = lane_and_node(column, plant.state().front().name);
    if (lane.empty() || lanes.contains(lane)) continue;
    std::vector<int> mine;
    for (const Component& c : plant.state())
      mine.push_back(trace->find("lane." + lane + "." + node + ".estimate." + c.name));
    if (std::find(mine.begin(), mine.end(), -1) != mine.end()) continue;
    std::size_t place = static_cast<std::size_t>(std::find(names.begin(), names.end(), lane) - names.begin());
    if (place == names.size()) {
      names.push_back(lane);
      outputs.emplace_back();
      columns.emplace_back();
    }
    outputs[place].push_back(node);
    columns[place].push_back(std::move(mine));
  }
  std::vector<RecordedLane> result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    result.push_back({names[i], std::make_unique<Recorded>(trace, std::move(outputs[i]), std::move(columns[i]))});
  }
  return result;
}

}  // namespace vigil
