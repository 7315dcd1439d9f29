/// The adversary's side of the channels. One file an attack.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/params.hpp"
#include "engine/core/registry.hpp"

namespace vigil {

enum class LinkState : std::uint8_t { clean = 0, dos = 1, fdi = 2, replay = 3 };

/// A record played back in place of what a sensor or a node sends.
struct Playback {
  std::int64_t from = -1, to = -1;  ///< ticks of the record, both ends included
  std::int64_t source = -1;         ///< the tick of it that is played now; -1: nothing is
};

/// What happens on every directed channel in one tick: the same for every lane that is not spared.
struct LinkEffects {
  std::vector<LinkState> state;  ///< one a link
  Eigen::MatrixXd injected;      ///< message size x links; zero where nothing is injected
  Eigen::VectorXd
      strength;  ///< one a link: the attack signal drawn (a DoS has one too), NaN where the attack draws none
  std::vector<Playback> playback;  ///< one a link; what is injected is added to it
  std::vector<char> overheard;     ///< one a link: somebody hears what is sent, whether it arrives or not

  void resize(int message, int links);
  void clear();
  /// A jammed channel carries nothing, whatever else was injected on it.
  void jam(int link);
  /// Adds scale * added to what the channel carries, unless it is jammed.
  void inject(int link, const Eigen::Ref<const Eigen::VectorXd>& added, double scale = 1);
  /// Plays earlier messages back on it and takes off what was injected, unless it is jammed.
  void play(int link, const Playback& record);
};

/// Where an attack acts on sensors: a node, and one of its channels or (-1) the whole reading.
struct SensorPlace {
  int node = 0;
  int channel = -1;
};

/// The same of actuators.
using ActuatorPlace = SensorPlace;

/// What happens to a sensor's readings. The first four are those of a link; the others are types of false data that
/// the metrics keep apart (seed 001, Table 1).
enum class SensorState : std::uint8_t { clean = 0, dos = 1, fdi = 2, replay = 3, type_i = 4, type_ii = 5, type_r = 6 };

/// The word of a state: "clean", "DoS", "FDI", "replay", "I", "II", "R".
const char* word(SensorState state);

/// What happens to every reading in one tick, on its way to the receivers.
struct SensorEffects {
  std::vector<Eigen::VectorXd> injected;        ///< one a node, zero where nothing is injected
  std::vector<SensorState> state;               ///< one a node
  std::vector<std::vector<Playback>> playback;  ///< node, channel; what is injected is added to it

  void resize(const std::vector<int>& channels);
  void clear();
  void add(const SensorPlace& place, const Eigen::Ref<const Eigen::VectorXd>& added, SensorState as);
  /// Replaces what earlier attacks injected at this node: for attacks of which the later start wins.
  void set(int node, const Eigen::Ref<const Eigen::VectorXd>& value, SensorState as);
  /// Plays a record back at this place, and takes off what earlier attacks injected there.
  void play(const SensorPlace& place, const Playback& record);
  /// Some channel of the node is played back.
  bool plays(int node) const;
};

class Attack;

/// Who pushes on which actuators in one tick. A push is a function of time within the tick: a plant in continuous time
/// is attacked at every stage of its integration. The attacks are the adversary's own; valid until its next tick.
struct ActuatorEffects {
  struct Push {
    const Attack* attack = nullptr;
    ActuatorPlace place;
  };
  std::vector<Push> pushes;
  void clear() { pushes.clear(); }
};

/// What a receiver may know of a channel's statistics: the published probabilities and the bound, never a realisation.
struct LinkRates {
  double dos = 0;    ///< phi-bar
  double fdi = 0;    ///< gamma-bar
  double delta = 0;  ///< bound on the norm of an injected vector
};

struct AttackContext {
  std::string id;  ///< names its draws
  std::uint64_t seed = 0;
  int message = 0;                 ///< size of what a link carries: the plant's states
  bool on_links = true;            ///< it acts on some link
  std::vector<int> readings;       ///< sizes of what it acts on at sensors: a whole reading's channels, or 1
  std::vector<int> actuators;      ///< the same of actuators
  std::int64_t from = 1;           ///< the first tick it may act
  std::optional<std::int64_t> to;  ///< the last
  bool by_hand = false;            ///< started in a live run
};

enum class ChannelKind { link, sensor, actuator };

/// A value with no memory of its own but its parameters: what it does at a tick depends on tick and draws alone.
class Attack {
 public:
  virtual ~Attack() = default;
  virtual std::unique_ptr<Attack> clone() const = 0;
  virtual bool acts_on(ChannelKind kind) const { return kind == ChannelKind::link; }
  /// Acts at tick k on the given links (indices); `effects` holds what earlier attacks of the document did. No
  /// allocation.
  virtual void act(std::int64_t /*k*/, std::span<const int> /*links*/, LinkEffects& /*effects*/) const {}
  /// The same on sensors.
  virtual void tamper(std::int64_t /*k*/, std::span<const SensorPlace> /*places*/, SensorEffects& /*effects*/) const {}
  /// Adds what it does to one place's actuators at time t, s, of a tick whose middle is at `branch` (which piece of a
  /// signal holds: see world/interconnected/signals.hpp).
  virtual void push(double /*t*/, double /*branch*/, Eigen::Ref<Eigen::VectorXd> /*w*/) const {}
  /// The first tick at which it does something, where a parameter says so: attacks act in the order of their starts.
  virtual std::int64_t start() const { return 0; }
  /// False at ticks between its first and last at which it does nothing: where it begins and ends is what people see.
  virtual bool active(std::int64_t /*k*/) const { return true; }
  /// A sentence for the mark of its begin; empty: nothing to say.
  virtual std::string remark() const { return {}; }
  virtual LinkRates rates() const { return {}; }
};

/// Throws InputError (pointers relative to the params) for what the table cannot check: sums of probabilities, norms,
/// sizes.
using AttackMake = std::unique_ptr<Attack> (*)(const Params& params, const AttackContext& context);

}  // namespace vigil
