/// A Kalman filter at each node that takes the attack its window shows off the innovation, and may play the game.
/// Seed 001, section 3; specification, section 9.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/methods/kalman.hpp"
#include "engine/methods/method.hpp"
#include "engine/methods/sparse/game.hpp"
#include "engine/methods/sparse/reconstructor.hpp"

namespace vigil::sparse {

using MakeReconstructor = std::unique_ptr<Reconstructor> (*)(const Params& params, const WindowShape& shape);

class SparseFilter final : public Method {
 public:
  /// `make` null: no reconstruction (an unprotected filter). `game`: plays, with the game's params. Throws InputError
  /// where the plant is not linear, sensors differ in their channels, or q exceeds them.
  SparseFilter(const Params& params, const Knowledge& knowledge, MakeReconstructor make, bool game);
  SparseFilter(const SparseFilter& other);

  std::unique_ptr<Method> clone() const override { return std::make_unique<SparseFilter>(*this); }
  std::vector<std::string> outputs() const override { return ids_; }
  int message() const override { return game_ ? shape_.states : 0; }
  void declare(SignalScope& scope) override;

  void predict(const Eigen::VectorXd& input, FaultReport& report) override;
  void measure(const Readings& readings, FaultReport& report) override;
  void send(int node, Eigen::Ref<Eigen::VectorXd> message) const override;
  void update(const Readings& readings, std::span<const Delivery> inbox, FaultReport& report) override;

  Belief belief(int output) const override;
  int window() const override { return reconstructor_ ? shape_.window : 0; }
  Reconstruction reconstruction(int output) const override;
  int choice(int output) const override { return game_ ? game_->choice(output) : -1; }
  void publish(std::span<double> values) const override;
  Json design() const override;
  bool has_bound() const override { return false; }

  void retune(const Params& params) override;
  void rewire(const Graph& graph, const std::vector<LinkRates>& rates) override;

 private:
  struct Node {
    std::shared_ptr<const Sensor> sensor;
    Window window;
    Gaussian state;
    Innovation innovation;  ///< with the attack taken off; empty in a tick without an update
    BoundedMatrix innovation_covariance;
    double statistic = 0, threshold = 0;
    bool searched = false;  ///< the window was full and the attack sought
  };
  struct Slots {
    int attack = -1, statistic = -1, threshold = -1, alarm = -1, choice = -1;
    std::vector<std::pair<int, int>> utility, probability;  ///< candidate, signal
  };
  void measure_node(std::size_t i, const Eigen::VectorXd& reading, FaultReport& report);
  bool search(std::size_t i, FaultReport& report);
  void update_node(std::size_t i, FaultReport& report);
  void play(std::span<const Delivery> inbox);
  void publish_game(int output, std::span<double> values) const;

  std::shared_ptr<const Plant> plant_;
  std::vector<std::string> ids_;
  Eigen::MatrixXd Q_;
  WindowShape shape_;
  bool update_at_once_;  ///< startup: update
  bool as_printed_;
  MakeReconstructor make_;
  Transition transition_;
  Regression regression_;
  std::unique_ptr<Reconstructor> reconstructor_;  ///< null: none
  std::optional<PotentialGame> game_;
  Graph graph_;
  std::vector<Node> nodes_;
  std::vector<Gaussian> own_;  ///< before the game
  Eigen::MatrixXd E_;          ///< p T x nodes
  std::vector<char> ready_, heard_;
  std::vector<Slots> slots_;
  std::int64_t tick_ = 0;
  Json identifiability_;
};

}  // namespace vigil::sparse
