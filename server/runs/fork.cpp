#include "server/runs/fork.hpp"

#include <algorithm>
#include <utility>

#include "engine/core/describe.hpp"
#include "engine/scenario/document.hpp"

namespace vigil {
namespace {

/// Sorts the members of a patch into what becomes a command at k+1 and what changes the document.
class PatchSorter {
 public:
  PatchSorter(const Json& document, std::int64_t k) : document_(document), k_(k), live_(live_paths(document)) {}

  void sort(const Json& patch) {
    for (const auto& [key, value] : patch.items()) {
      const std::string pointer = child("/patch", key);
      if (key == "log" || key == "title" || key == "source" || key == "view") {
        document_patch[key] = value;
      } else if (key == "time") {
        time(value, pointer);
      } else if (key == "network") {
        descend("network", value, pointer);
      } else if (key == "adversary") {
        adversary(value, pointer);
      } else {
        descend(key, value, pointer);
      }
    }
    if (!problems.empty()) throw InputError(problems);
  }

  Json document_patch = Json::object();
  Json params = Json::object();
  std::vector<std::pair<std::string, Json>> attacks;  ///< pointer and command body
  std::vector<Problem> problems;

 private:
  void refuse(const std::string& pointer, const std::string& why) {
    problems.push_back({pointer, "This would alter the run's past: " + why,
                        "what may change live, or acts after tick " + std::to_string(k_)});
  }

  bool live(const std::string& path) const { return std::find(live_.begin(), live_.end(), path) != live_.end(); }

  void time(const Json& value, const std::string& pointer) {
    if (!value.is_object()) return refuse(pointer, "only time.steps can be changed.");
    for (const auto& [key, steps] : value.items()) {
      if (key != "steps") {
        refuse(child(pointer, key), "only time.steps can be changed.");
      } else if (steps.is_number_integer() && steps.get<std::int64_t>() < k_) {
        refuse(child(pointer, key), "it would end before tick " + std::to_string(k_) + ".");
      } else {
        document_patch["time"]["steps"] = steps;
      }
    }
  }

  void adversary(const Json& value, const std::string& pointer) {
    if (!value.is_object()) return refuse(pointer, "name the attacks one by one.");
    for (const auto& [id, member] : value.items()) {
      const std::string here = child(pointer, id);
      const bool known = document_.contains("adversary") && document_.at("adversary").contains(id);
      if (known && member.is_null()) {
        params["adversary." + id + ".enabled"] = false;
      } else if (known) {
        known_attack(id, member, here);
      } else {
        new_attack(id, member, here);
      }
    }
  }

  /// When an attack of the document acts may change where neither the old time nor the new one reaches back to tick k.
  void known_attack(const std::string& id, const Json& member, const std::string& pointer) {
    if (!member.is_object()) return descend("adversary." + id, member, pointer);
    Json rest = member, times = Json::object();
    for (const char* key : {"from", "to", "schedule"}) {
      if (!rest.contains(key)) continue;
      times[key] = rest[key];
      rest.erase(key);
    }
    if (!rest.empty() || times.empty()) descend("adversary." + id, rest, pointer);
    if (times.empty()) return;
    const Json& old = document_.at("adversary").at(id).at("from");
    for (const Json& from : {old, times.value("from", old)}) {
      if (!from.is_number() || from.get<double>() <= static_cast<double>(k_))
        return refuse(child(pointer, times.begin().key()),
                      "the attack begins at tick " + shown(from) + ", not after tick " + std::to_string(k_) + ".");
    }
    document_patch["adversary"][id] = times;
  }

  void new_attack(const std::string& id, const Json& member, const std::string& pointer) {
    if (!member.is_object()) return refuse(pointer, "a new attack is an object with type, on and params.");
    const auto from = member.find("from");
    const bool after =
        from == member.end() || from->is_null() || (from->is_number() && from->get<double>() > static_cast<double>(k_));
    if (!after)
      return refuse(child(pointer, "from"), "the attack would begin at or before tick " + std::to_string(k_) + ".");
    Json attack = member;
    attack["id"] = id;
    attacks.emplace_back(pointer, Json{{"attack", attack}});
  }

  void descend(const std::string& path, const Json& value, const std::string& pointer) {
    if (live(path)) {
      params[path] = value;
    } else if (value.is_object() && !value.empty()) {
      for (const auto& [key, below] : value.items()) descend(path + "." + key, below, child(pointer, key));
    } else {
      refuse(pointer, in_quotes(path) + " cannot be changed while a run goes on.");
    }
  }

  const Json& document_;
  std::int64_t k_;
  std::vector<std::string> live_;
};

/// The commands' own pointers lead into the body of a command; the asker wrote a patch.
void add_command(Run& scratch, RunOrder& order, std::int64_t k, const Json& body, const std::string& pointer) {
  try {
    Command command = scratch.prepare(body, k + 1);
    scratch.apply(command);
    order.commands.push_back(std::move(command));
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) problem.pointer = pointer;
    throw InputError(std::move(problems));
  }
}

}  // namespace

RunOrder fork_order(const RunRow& parent, std::int64_t k, const Json& patch, std::shared_ptr<const Trace> trace) {
  PatchSorter sorter(parent.document, k);
  if (!patch.is_object()) throw InputError("/patch", "patch is " + shown(patch) + "; expected an object", "object");
  sorter.sort(patch);
  RunOrder order;
  order.scenario = Scenario::from_json(parent.document);
  if (!sorter.document_patch.empty()) order.scenario = order.scenario.patched(sorter.document_patch);
  order.seed = parent.seed;
  order.trace_id = parent.trace;
  order.trace = std::move(trace);
  if (parent.designs.is_object()) order.designs = parent.designs;
  order.parent = RunParent{parent.id, k};
  order.fast_until = k;
  order.tags = parent.tags;
  std::erase(order.tags, "demo");

  // A run that has had every earlier command is what the patch is checked against.
  Run scratch = make_run(order);
  for (const Command& command : parent.commands) {
    if (command.k > k) continue;
    scratch.apply(command);
    order.commands.push_back(command);
  }
  if (!sorter.params.empty()) add_command(scratch, order, k, Json{{"params", sorter.params}}, "/patch");
  for (const auto& [pointer, body] : sorter.attacks) add_command(scratch, order, k, body, pointer);
  return order;
}

}  // namespace vigil
