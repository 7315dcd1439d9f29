/// The state of a run: a value. Setting it up, stepping it and changing it live in files of their own.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/adversary.hpp"
#include "engine/run/lane.hpp"
#include "engine/run/run.hpp"
#include "engine/run/trace.hpp"
#include "engine/world/graph.hpp"

namespace vigil {

/// Where a trace's columns stand, -1: not there.
struct CourseColumns {
  std::vector<int> truth, input;
  std::vector<int> drives;  ///< of continuous time, by the plant's ports; input has the known ones
  /// node, channel: as received, honest, added by the adversary, tick played back
  std::vector<std::vector<int>> sensor, sent, tampered, source;
  std::vector<int> sensor_state;  ///< node
  bool readings = false;          ///< it has some reading
};
struct TraceColumns {
  CourseColumns shared;
  std::vector<CourseColumns> lanes;        ///< by lane; of the recorded side only
  std::vector<int> link_state;             ///< base link
  std::vector<int> source, overheard;      ///< base link
  std::vector<std::vector<int>> injected;  ///< base link, component
};

/// Ids of the world's signals.
struct WorldSlots {
  int truth = 0, input = 0;
  int sensor = 0;           ///< of all nodes: see sensor_signals.hpp
  std::vector<int> link;    ///< state, then injected components, strength, source, overheard; one a base link
  std::vector<int> drives;  ///< by the plant's ports, -1 for known inputs; empty: not in continuous time
};

/// Live values of one command for one lane, the detector attached to it, or an attack.
struct ParamGroup {
  enum class Of { lane, detector, attack };
  Of of = Of::lane;
  std::string id;  ///< the lane's or the attack's
  Json values;     ///< by parameter; of an attack also "enabled"
  Json paths;      ///< of the values, as pointers into the command
};

struct Run::State {
  State(const Scenario& scenario, RunOptions options);

  void step(Sink& sink);
  void change(const Command& command, Sink* sink);

  Scenario scenario;
  std::uint64_t seed;
  std::shared_ptr<const Trace> trace;
  double dt = 1;
  std::optional<std::int64_t> last_tick;
  std::vector<Command> pending;  ///< by tick, then in the order they were given; applied before their tick
  Json designs;                  ///< records by lane

  World world;
  std::vector<std::string> nodes;
  Eigen::Matrix2Xd positions;
  bool placed = false;       ///< some sensor has a position
  Graph base;                ///< the graph the run started with: its links are the catalogue's
  Graph graph;               ///< as it is now
  std::vector<int> base_of;  ///< link of `graph` -> link of `base`
  Adversary adversary;
  std::vector<Lane> lanes;
  std::vector<std::string> warnings;

  Catalogue catalogue;
  WorldSlots slots;
  TraceColumns columns;

  std::int64_t k = -1;
  Course shared;  ///< truth.*: every lane's that does not control a plant of its own, and the reference
  SensorChannels channels;
  LinkEffects effects;
  SensorEffects sensor_effects;
  Frame frame;

 private:
  void set_world(const Json& document);
  void set_lanes(const Json& document);
  void set_recorded_lanes();
  void find_columns();
  void declare_signals();
  void declare_drives();
  void check_trace(const Json& document);
  Eigen::MatrixXd initial_estimates(const Json& initial, Knowledge& knowledge);

  void set_nodes(const Json& document);
  void set_noise(const Json& document);
  CourseColumns course_columns(const std::string& prefix) const;
  Contender::Side side_of(const std::string& lane, const Method& method, bool spared, bool judged) const;

  void begin(Sink& sink);
  void begin_flow();
  void simulate(Sink& sink);
  void replay(Sink& sink);
  void read_course(const CourseColumns& from, Course& course) const;
  void read_tampering(const CourseColumns& from, Course& course, SensorEffects& effects) const;
  void override_links();
  void publish_world();
  void publish_links();

  void set_params(const Json& params);
  void retune_lane(const ParamGroup& group);
  void retune_detector(const ParamGroup& group);
  void set_graph(const Json& value);
  void rewire_lanes();
};

/// The way in of those who look at a run's parts: campaigns at records of bounds, the table of compatibility at lanes.
struct TrialAccess {
  using State = Run::State;
  static Run::State& state(Run& run) { return *run.state_; }
};

/// The node positions' graph as the document's "network" says: {"graph":name} or {"graph":"edges","edges":[[1,2],…]}.
Graph read_network(const Json& network, const std::vector<std::string>& nodes, const Eigen::Matrix2Xd& positions);

}  // namespace vigil
