/// A method with the plant it sees: the shared one, one of its own that it controls, or one that was recorded.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/methods/detectors/detector.hpp"
#include "engine/methods/privacy/protection.hpp"
#include "engine/run/course.hpp"
#include "engine/run/fault_table.hpp"
#include "engine/run/lane_flow.hpp"
#include "engine/run/message_memory.hpp"
#include "engine/run/sensor_channels.hpp"

namespace vigil {

/// What a tick gives to every lane.
struct Tick {
  std::int64_t k = 0;
  bool traced = false;  ///< the course comes from a trace
  const World& world;
  const Course& shared;
  const Graph& graph;
  std::span<const int> base;  ///< link of `graph` -> its place in `links`
  const LinkEffects& links;
  const SensorEffects& sensors;
};

class Contender {
 public:
  enum class Side {
    shared,    ///< hears the shared readings
    marked,    ///< sees the shared plant, but something of its own leaves its sensors
    closed,    ///< has a plant of its own: it drives it, or no attack reaches its actuators
    recorded,  ///< its plant, inputs and readings come from a trace, through course()
  };

  /// monitor: the estimator hears what was sent, only the detector what arrived. protection: of its links; null: none,
  /// or the method's own. last: the run's last tick, if it has one.
  Contender(std::unique_ptr<Method> method, std::unique_ptr<privacy::Protection> protection, const World& world,
            const Graph& graph, Side side, bool monitor, std::optional<std::int64_t> last);
  Contender(const Contender& other);
  Contender(Contender&&) noexcept = default;

  /// Tick 0: where it starts from, its first input, and what is said to a fusion centre.
  void begin(const Tick& tick, bool attacked, FaultTable& faults);
  /// Steps 1 to 6 of a tick; `attacked` false: the adversary does not touch it.
  /// `none`: effects that do nothing. Ends early where the method stops.
  void tick(const Tick& tick, bool attacked, const SensorEffects& none, FaultTable& faults);
  void rewire(const Graph& graph, const std::vector<LinkRates>& rates);

  Method& method() { return *method_; }
  const Method& method() const { return *method_; }
  Side side() const { return side_; }
  /// Puts a detector on every output, in place of the method's own. Before begin().
  void attach(const Detector& detector);
  /// Live values for the attached detectors; `params` is complete.
  void retune_detector(const Params& params);
  bool attached() const { return !detectors_.empty(); }
  bool detects() const { return attached() || method_->detects(); }
  Detection detection(int output) const {
    return attached() ? detections_[static_cast<std::size_t>(output)] : method_->detection(output);
  }
  int tail() const { return attached() ? detectors_.front()->tail() : method_->tail(); }
  /// Of an attached detector: it has had some innovation to judge.
  bool has_judged() const { return has_judged_; }
  /// What the nodes sent in the newest tick, message size x nodes.
  const Eigen::MatrixXd& sent_messages() const { return outbox_; }
  Course& course() { return course_; }
  /// The course it sees.
  const Course& course(const Course& shared) const { return side_ == Side::shared ? shared : course_; }

 private:
  void sense(const Tick& tick, bool attacked, const SensorEffects& effects);
  void exchange(const Tick& tick, bool attacked);
  void act(std::int64_t k, const World& world);
  void detect(std::int64_t k);
  void make_inbox(const Graph& graph);
  void flow(const Tick& tick, bool attacked, const Course& seen, const Readings& heard, FaultReport& faults);

  std::unique_ptr<Method> method_;
  std::unique_ptr<privacy::Protection> protection_;
  Side side_;
  bool monitor_;
  std::int64_t reach_;  ///< ticks that the memory of messages goes back
  Course course_;
  LaneFlow flow_;  ///< of a method in continuous time
  SensorChannels channels_;
  std::vector<Delivery> inbox_;
  Eigen::MatrixXd outbox_;  ///< message size x nodes
  MessageMemory memory_;
  std::vector<std::unique_ptr<Detector>> detectors_;  ///< attached: one an output
  std::vector<Detection> detections_;
  bool has_judged_ = false;
};

}  // namespace vigil
