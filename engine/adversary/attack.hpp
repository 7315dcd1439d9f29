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

/// What an adversary who knows plant, sensor and truth makes of a node's reading: run/insider.hpp works it out for
/// every course of the plant. The vectors are the attack's own, valid until the adversary's next tick.
struct Shaping {
  const Eigen::VectorXd* moved = nullptr;  ///< states: it reads as if the state were off by that; null: it does not
  double share = 1;                        ///< of `moved`
  /// channels, of norm 1: where the normalised innovation of a Kalman filter at this node is to point; null: nowhere
  const Eigen::VectorXd* direction = nullptr;
  double budget = 0;  ///< its square
};

/// What happens to every reading in one tick, on its way to the receivers.
struct SensorEffects {
  std::vector<Eigen::VectorXd> injected;        ///< one a node, zero where nothing is injected
  std::vector<SensorState> state;               ///< one a node
  std::vector<std::vector<Playback>> playback;  ///< node, channel; what is injected is added to it
  std::vector<Shaping> shaping;                 ///< one a node; after that
  std::vector<std::vector<char>> lost;          ///< node, channel: nothing arrives, whatever else was done

  void resize(const std::vector<int>& channels);
  void clear();
  void add(const SensorPlace& place, const Eigen::Ref<const Eigen::VectorXd>& added, SensorState as);
  /// Replaces what earlier attacks injected at this node: for attacks of which the later start wins.
  void set(int node, const Eigen::Ref<const Eigen::VectorXd>& value, SensorState as);
  /// Plays a record back at this place, and takes off what earlier attacks injected there.
  void play(const SensorPlace& place, const Playback& record);
  /// Nothing arrives from this place.
  void jam(const SensorPlace& place);
  void move(int node, const Eigen::VectorXd& by, double share);
  void aim(int node, const Eigen::VectorXd& direction, double budget);
  /// Some channel of the node is played back.
  bool plays(int node) const;
};

class Attack;

/// Who pushes on which actuators in one tick, and which commands do not get there. A push is a function of time within
/// the tick: a plant in continuous time is attacked at every stage of its integration. The attacks are the adversary's
/// own; valid until its next tick.
struct ActuatorEffects {
  struct Push {
    const Attack* attack = nullptr;
    ActuatorPlace place;
    std::int64_t k = 0;
  };
  /// A command that is lost leaves the actuator without input, one that is held leaves it at what it did a tick ago.
  struct Stop {
    ActuatorPlace place;
    bool held = false;
  };
  std::vector<Push> pushes;
  std::vector<Stop> stops;  ///< of plants in discrete time alone; where one stops a command, nothing is pushed
  bool idle() const { return pushes.empty() && stops.empty(); }
  void clear();
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
  bool single_channels = false;    ///< some of the sensors' places are a channel
  bool continuous = false;         ///< the plant's time does not go in ticks
  std::int64_t from = 1;           ///< the first tick it may act
  std::optional<std::int64_t> to;  ///< the last
  bool by_hand = false;            ///< started in a live run
};

/// A value with no memory of its own but its parameters: what it does at a tick depends on tick and draws alone.
class Attack {
 public:
  virtual ~Attack() = default;
  virtual std::unique_ptr<Attack> clone() const = 0;
  /// Acts at tick k on the given links (indices); `effects` holds what earlier attacks of the document did. No
  /// allocation.
  virtual void act(std::int64_t /*k*/, std::span<const int> /*links*/, LinkEffects& /*effects*/) const {}
  /// The same on sensors.
  virtual void tamper(std::int64_t /*k*/, std::span<const SensorPlace> /*places*/, SensorEffects& /*effects*/) const {}
  /// The same on actuators: most push.
  virtual void reach(std::int64_t k, std::span<const ActuatorPlace> places, ActuatorEffects& effects) const;
  /// Adds what it does to one place's actuators in tick k at time t, s, of a step whose middle is at `branch` (which
  /// piece of a signal holds: see world/interconnected/signals.hpp). No allocation.
  virtual void push(const ActuatorEffects::Push& /*at*/, double /*t*/, double /*branch*/,
                    Eigen::Ref<Eigen::VectorXd> /*w*/) const {}
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

enum class ChannelKind { link, sensor, actuator };

/// The word of a kind, as places have it: "link", "sensor", "actuator".
const char* word(ChannelKind kind);

/// What the registration of an attack says of it.
template <>
struct Traits<AttackMake> {
  std::vector<ChannelKind> acts_on = {ChannelKind::link};
  bool on_commands = false;  ///< at actuators it stops commands: there are none in continuous time
};

}  // namespace vigil
