/// The adversary of a run: its attacks with places and schedules, started by the document or by hand.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/adversary/attack.hpp"
#include "engine/core/json.hpp"
#include "engine/run/frame.hpp"
#include "engine/scenario/document.hpp"
#include "engine/world/graph.hpp"

namespace vigil {

class Adversary {
 public:
  Adversary() = default;
  /// `document`: the scenario's "adversary". Links are those of `graph`, the graph the run starts with: a draw's index
  /// is the link's place there, so that a later change of the graph moves no draw. `channels`: the names of each node's
  /// sensor channels; `actuators`: of each node's actuators, none where it has none. `continuous`: the plant's time.
  Adversary(const Json& document, const Graph& graph, const std::vector<std::string>& nodes,
            const std::vector<std::vector<std::string>>& channels,
            const std::vector<std::vector<std::string>>& actuators, std::uint64_t seed, int message, bool continuous);
  Adversary(const Adversary& other);
  Adversary(Adversary&&) noexcept = default;
  Adversary& operator=(Adversary&&) noexcept = default;

  /// Decides tick k for every link, sensor and actuator and marks attacks that begin or end with it. Attacks act in the
  /// order of their starts, then ids, so that where one replaces another the later start wins.
  void act(std::int64_t k, LinkEffects& links, SensorEffects& sensors, ActuatorEffects& actuators, Sink& sink);
  /// What the document's attacks publish of their statistics, one a link. Attacks started by hand publish nothing.
  std::vector<LinkRates> rates(const Graph& graph) const;

  /// Changes a live parameter, or "enabled". Throws InputError with pointers under /adversary/<id>.
  void retune(const std::string& id, const Json& values);
  /// A hand's attack {"id","type","on","from","to","params"}. Throws InputError with pointers under /attack.
  void start(const Json& attack, std::int64_t k);
  /// Throws InputError at /end_attack where no attack of that name goes on.
  void end(const std::string& id, std::int64_t k);
  bool has(const std::string& id) const;
  std::string free_id() const;  ///< "a1", "a2", …: the next that is not taken

 private:
  struct Entry {
    std::string id, type;
    std::unique_ptr<Attack> attack;
    Json params;
    std::vector<int> links;
    std::vector<SensorPlace> sensors;
    std::vector<ActuatorPlace> actuators;
    std::string link_name, node_name;  ///< for marks: "2-5" or "3"; empty where it acts on several
    std::int64_t from = 1;
    std::int64_t start = 1;          ///< the later of `from` and what the attack itself says
    std::optional<std::int64_t> to;  ///< last tick it acts
    /// Acts in the first `length` of every `every` ticks, in `budget` ticks altogether; 0: without such a limit.
    std::int64_t every = 0, length = 0, budget = 0;
    bool enabled = true;
    bool by_hand = false;
    bool acting = false;
  };
  void add(const std::string& id, const Json& entry, bool by_hand, const std::string& pointer, std::int64_t now);
  void find_places(const Json& on, const std::string& pointer, Entry& entry) const;
  int find_link(const std::string& from, const std::string& to) const;
  /// A sensor's or an actuator's channel, by the names that every node has of its kind.
  SensorPlace find_channel(const Place& place, const std::string& pointer) const;
  /// Throws InputError at `pointer` where the attack does not act on channels of the entry's kinds.
  void check_kinds(const Entry& entry, const Traits<AttackMake>& traits, const std::string& pointer) const;
  static bool scheduled(const Entry& entry, std::int64_t k);
  void mark_edge(std::int64_t k, const Entry& entry, Sink& sink) const;
  /// The attack itself, with the parameters of `entry`. Throws InputError under `pointer`.
  std::unique_ptr<Attack> make(const Entry& entry, const Json& params, const std::string& pointer) const;
  Entry* find(const std::string& id);

  std::vector<Entry> entries_;
  Graph graph_;
  std::vector<std::string> nodes_;
  std::vector<std::vector<std::string>> channels_, actuators_;
  std::uint64_t seed_ = 0;
  int message_ = 0;
  bool continuous_ = false;
};

/// Runs `make` and puts `prefix` before the pointers of an InputError it throws.
template <class Make>
auto under(const std::string& prefix, Make&& make) {
  try {
    return make();
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) problem.pointer = prefix + (problem.pointer == "/" ? "" : problem.pointer);
    throw InputError(std::move(problems));
  }
}

}  // namespace vigil
