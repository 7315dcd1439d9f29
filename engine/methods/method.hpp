/// A method: what a lane runs. It sees readings, messages and declared knowledge, never the truth, an attack or the
/// scenario.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/adversary/attack.hpp"
#include "engine/core/json.hpp"
#include "engine/core/params.hpp"
#include "engine/core/registry.hpp"
#include "engine/run/frame.hpp"
#include "engine/world/graph.hpp"
#include "engine/world/plant.hpp"
#include "engine/world/sensor.hpp"

namespace vigil {

namespace privacy {
class Protection;
}
class FusionMethod;

/// What every node may honestly know before the run.
struct Knowledge {
  std::shared_ptr<const Plant> plant;
  std::vector<std::shared_ptr<const Sensor>> sensors;  ///< one a node
  std::vector<std::string> nodes;                      ///< their ids
  Graph graph;
  Eigen::MatrixXd Q;             ///< process noise, states x states, positive semidefinite
  Eigen::MatrixXd P0;            ///< covariance of the initial estimates
  Eigen::MatrixXd estimates;     ///< initial estimates, states x nodes
  std::vector<LinkRates> rates;  ///< one a link: the adversary's published statistics (zero for a lane that is spared)
  Eigen::MatrixXd Mw;            ///< shape of the bounded process noise, states x states; zero: none
  bool monitor = false;          ///< its estimator hears what was sent, only its detector what arrived
  double dt = 1;                 ///< s
  std::uint64_t seed = 0;        ///< of a method's own draws: Draws(seed, "method.<what>"), the same for every lane
  Eigen::VectorXd prior;         ///< mean of the initial state, states
  bool stationary = false;       ///< the initial estimates come from the stationary law of the local filters
  std::shared_ptr<const privacy::Protection> protection;  ///< of a fusion centre's messages; null: none
  Json design;  ///< the record of what was solved for this lane before the run; null: nothing was
};

/// What a node received on one link in one exchange round.
struct Delivery {
  bool lost = false;  ///< nothing came (the receiver sees that: seed 000, "the detector recognises attacks correctly")
  bool flagged = false;  ///< falsified. An oracle: only methods that declare it as an input look at it
  Eigen::VectorXd payload;
};

/// Readings as received: one vector a node, NaN where a channel gave nothing.
using Readings = std::vector<Eigen::VectorXd>;

/// What a method believes at one output: views into its own memory, valid until its next call. Null: it has none.
struct Belief {
  const double* mean = nullptr;        ///< states, or those that components() names
  const double* covariance = nullptr;  ///< states x states, column-major: a covariance or an upper bound of it
  const double* innovation = nullptr;  ///< innovation_size values; null in a tick without a reading
  const double* innovation_covariance = nullptr;  ///< column-major
  int innovation_size = 0;
};

/// The attack that an output finds on its own sensor, over its last `window` readings: views valid until the method's
/// next call. Null: none was sought in this tick.
struct Reconstruction {
  const double* entries = nullptr;  ///< channels x window, newest reading last; exactly zero where no attack is found
  int channels = 0;
  int window = 0;
};

/// What an output makes of the inputs that nobody knows: views valid until the method's next call. Null: it says
/// nothing.
struct UnknownInputs {
  const double* attack = nullptr;                                ///< on the node's actuators
  const double* fault = nullptr;                                 ///< of its sensor
  double innovation = std::numeric_limits<double>::quiet_NaN();  ///< its norm
};

/// What a detector says at one output in one tick.
struct Detection {
  double statistic = std::numeric_limits<double>::quiet_NaN();  ///< NaN: none in this tick
  double threshold = std::numeric_limits<double>::quiet_NaN();  ///< NaN: none yet
  bool judged = false;                                          ///< it could have said something
  bool alarm = false;
};

/// Where a method reports what went wrong. Counted by node and code.
class FaultReport {
 public:
  virtual ~FaultReport() = default;
  /// node: output index, -1 for the whole lane; code: a string literal. Returns where to write one sentence the first
  /// time this node reports this code, null afterwards (so that a fault at every tick costs nothing).
  virtual std::string* fault(int node, const char* code) = 0;
  /// The same, and the lane stops here: its signals are empty from this tick on.
  virtual std::string* stop(int node, const char* code) = 0;
};

/// Declares a method's own signals under "lane.<lane>." and returns ids to write to in publish().
class SignalScope {
 public:
  virtual ~SignalScope() = default;
  /// output: index, or -1 for a signal of the whole lane.
  virtual int add(int output, const std::string& name, const std::string& unit, SignalKind kind) = 0;
  /// A category whose value 0, 1, … means the word at that place.
  virtual int add_category(int output, const std::string& name, const std::vector<std::string>& words) = 0;
};

/// A method's own figure of a run. output -1: the whole lane.
struct OwnMetric {
  int output = -1;
  std::string name;
  double value = 0;
  bool boolean = false;
  std::string variant;  ///< as MetricValue has it: of which of several like it
};

class ContinuousMethod;

/// One tick of the lane calls emit at every node, predict, measure, then (for message() > 0) send at every node, then
/// update, judge, where the lane controls its plant mark_input, and publish.
class Method {
 public:
  virtual ~Method() = default;
  virtual std::unique_ptr<Method> clone() const = 0;

  virtual std::vector<std::string> outputs() const = 0;  ///< ids of what it estimates at: the nodes, or "fused"
  virtual int message() const { return 0; }              ///< size of what a node sends; 0: uses no channel
  virtual bool reads() const { return true; }            ///< false: it listens to no sensor
  virtual void declare(SignalScope& /*scope*/) {}

  /// True where something of its own leaves the sensors: a mark, or a message that the sensor makes.
  virtual bool marks() const { return false; }
  /// The sensor side of a node: what leaves for a reading. input: what acted on the plant since the last tick.
  virtual void emit(int /*node*/, const Eigen::VectorXd& reading, const Eigen::VectorXd& /*input*/,
                    Eigen::VectorXd& sent) {
    sent = reading;
  }
  virtual void predict(const Eigen::VectorXd& input, FaultReport& report) = 0;
  /// What a node does with its own reading before it speaks to others.
  virtual void measure(const Readings& /*readings*/, FaultReport& /*report*/) {}
  virtual void send(int /*node*/, Eigen::Ref<Eigen::VectorXd> /*message*/) const {}
  /// `inbox` has one delivery a link of the graph.
  virtual void update(const Readings& /*readings*/, std::span<const Delivery> /*inbox*/, FaultReport& /*report*/) {}

  /// The detector's part: readings as they arrived (for the path "monitor" these are not what measure() was given).
  virtual void judge(const Readings& /*arrived*/, FaultReport& /*report*/) {}
  /// Adds the keyed mark of a controlled plant's input, known to the method alone. u: inputs, acts from tick k on.
  virtual void mark_input(std::int64_t /*k*/, Eigen::Ref<Eigen::VectorXd> /*u*/) {}
  /// False until it has an estimate that may drive the plant.
  virtual bool ready() const { return true; }

  /// Null: its time goes in ticks.
  virtual ContinuousMethod* continuous() { return nullptr; }
  virtual const ContinuousMethod* continuous() const { return nullptr; }
  /// Null: it has no fusion centre.
  virtual const FusionMethod* fusion() const { return nullptr; }
  /// Of which states of the plant an output's mean consists; empty: of all, in their order.
  virtual std::vector<int> components(int /*output*/) const { return {}; }
  virtual UnknownInputs unknown_inputs(int /*output*/) const { return {}; }

  virtual Belief belief(int output) const = 0;
  /// Readings that its reconstructions span; 0: it makes none.
  virtual int window() const { return 0; }
  virtual Reconstruction reconstruction(int /*output*/) const { return {}; }
  /// The node whose estimate this output took in this tick, itself included; -1: it does not choose.
  virtual int choice(int /*output*/) const { return -1; }
  virtual bool detects() const { return false; }
  virtual Detection detection(int /*output*/) const { return {}; }
  /// Ticks after an attack whose statistic still holds readings of it.
  virtual int tail() const { return 0; }
  /// Writes its own signals of this tick (tick 0: the initial state) into the frame.
  virtual void publish(std::span<double> values) const { static_cast<void>(values); }

  virtual Json design() const { return Json::object(); }
  virtual std::vector<OwnMetric> metrics() const { return {}; }
  /// Sentences about the run so far that a reader must know, such as that its detector is blind.
  virtual std::vector<std::string> warnings() const { return {}; }
  /// True where its covariance is a bound whose campaign-wide ratio is worth taking.
  virtual bool has_bound() const { return true; }

  /// Live changes. Each throws InputError (pointer relative to the params, or "") and then has changed nothing.
  virtual void retune(const Params& params) = 0;
  virtual void rewire(const Graph& graph, const std::vector<LinkRates>& rates) = 0;
};

/// Throws InputError with pointers relative to the lane's params.
using MethodMake = std::unique_ptr<Method> (*)(const Params& params, const Knowledge& knowledge);

}  // namespace vigil
