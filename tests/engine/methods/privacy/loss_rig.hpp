/// The privacy loss that a mechanism's own signals show, tick by tick, of the noise that encode() and release() draw.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/engine/methods/privacy/fusion_rig.hpp"

namespace vigil::rig {

/// Own signals by "<output>/<name>".
class Book final : public SignalScope {
 public:
  int add(int output, const std::string& name, const std::string& /*unit*/, SignalKind /*kind*/) override {
    ids_[std::to_string(output) + "/" + name] = static_cast<int>(values.size());
    values.push_back(std::nan(""));
    return static_cast<int>(values.size()) - 1;
  }
  int add_category(int output, const std::string& name, const std::vector<std::string>& /*words*/) override {
    return add(output, name, "", SignalKind::category);
  }
  const std::map<std::string, int>& ids() const { return ids_; }
  double at(const std::string& name) const { return values[static_cast<std::size_t>(ids_.at(name))]; }

  std::vector<double> values;

 private:
  std::map<std::string, int> ids_;
};

/// Drives the mechanism alone: whatever the local estimates are, its noise is the same.
class Mechanism {
 public:
  Mechanism(const Knowledge& known, const std::string& id, const Json& params)
      : protection_(protect(known, id, params)->clone()),
        states_(known.plant->states()),
        count_(static_cast<int>(known.sensors.size())) {
    protection_->declare(book_);
    tick_.settled = true;
  }
  void tick() {
    messages = Eigen::MatrixXd::Zero(states_, count_);
    protection_->encode(tick_, messages);
    protection_->release(tick_, Eigen::VectorXd::Zero(states_));
    protection_->publish(book_.values);
    ++tick_.k;
  }
  const Book& book() const { return book_; }
  const privacy::Protection& protection() const { return *protection_; }

  Eigen::MatrixXd messages;  ///< of the newest tick

 private:
  std::unique_ptr<privacy::Protection> protection_;
  int states_, count_;
  Book book_;
  privacy::PublicTick tick_;
};

/// Shares of the ticks whose loss is above epsilon, by signal. Losses of near ticks have noise in common, so that the
/// standard errors come from batches that are long beside the longest memory.
inline std::map<std::string, Sample> sampled_losses(Mechanism& mechanism, double epsilon, int batches) {
  constexpr int kWarm = 1000, kBatch = 1000;
  for (int k = 0; k < kWarm; ++k) mechanism.tick();
  std::map<std::string, Sample> shares;
  for (int batch = 0; batch < batches; ++batch) {
    std::map<std::string, int> above;
    for (int k = 0; k < kBatch; ++k) {
      mechanism.tick();
      for (const auto& [name, id] : mechanism.book().ids()) {
        if (name.find("/loss.") == std::string::npos) continue;
        above[name] += mechanism.book().values[static_cast<std::size_t>(id)] > epsilon ? 1 : 0;
      }
    }
    for (const auto& [name, count] : above) shares[name].add(count / static_cast<double>(kBatch));
  }
  return shares;
}

/// Every view that can be sampled is, and is where the design's exact figure is.
inline void expect_exact_losses(const std::map<std::string, Sample>& shares, const Json& design,
                                const std::vector<std::string>& outputs) {
  std::size_t found = 0;
  for (const auto& [view, nodes] : design["views"].items()) {
    for (std::size_t o = 0; o < outputs.size(); ++o) {
      if (!nodes.contains(outputs[o]) || nodes[outputs[o]].contains("infinite")) continue;
      const auto sampled = shares.find(std::to_string(o) + "/loss." + view);
      ASSERT_NE(sampled, shares.end()) << view;
      ++found;
      const double exact = nodes[outputs[o]]["p_loss"].get<double>();
      EXPECT_NEAR(sampled->second.mean(), exact, 4 * sampled->second.error()) << view << " " << outputs[o];
      EXPECT_LE(sampled->second.error(), 0.02) << view;
    }
  }
  EXPECT_EQ(found, shares.size());
}

}  // namespace vigil::rig
