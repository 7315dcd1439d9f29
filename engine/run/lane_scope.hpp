/// Puts signals under a lane's name.
#pragma once

#include <string>
#include <vector>

#include "engine/methods/method.hpp"
#include "engine/run/frame.hpp"

namespace vigil {

class LaneScope final : public SignalScope {
 public:
  /// outputs: what stands in a node's place in names; must outlive this, as the catalogue must.
  LaneScope(std::string lane, const std::vector<std::string>& outputs, Catalogue& catalogue)
      : lane_(std::move(lane)), outputs_(outputs), catalogue_(catalogue) {}

  int add(int output, const std::string& name, const std::string& unit, SignalKind kind) override {
    return add(output, name, Signal{.unit = unit, .kind = kind});
  }

  int add_category(int output, const std::string& name, const std::vector<std::string>& words) override {
    Signal signal{.kind = SignalKind::category};
    for (const std::string& word : words) signal.labels.emplace_back(static_cast<int>(signal.labels.size()), word);
    return add(output, name, std::move(signal));
  }

 private:
  int add(int output, const std::string& name, Signal signal) {
    signal.lane = lane_;
    if (output >= 0) signal.node = outputs_[static_cast<std::size_t>(output)];
    signal.name = "lane." + lane_ + "." + (signal.node.empty() ? "" : signal.node + ".") + name;
    return catalogue_.add(std::move(signal));
  }

  std::string lane_;
  const std::vector<std::string>& outputs_;
  Catalogue& catalogue_;
};

}  // namespace vigil
