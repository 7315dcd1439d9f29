// Which signals go where: into the log, and into each topic of the stream.
#include <set>
#include <string_view>

#include "server/runs/glob.hpp"
#include "server/runs/order.hpp"

namespace vigil {
namespace {

const Json& log_member(const Json& document, const char* name) {
  static const Json none;
  const auto log = document.find("log");
  if (log == document.end() || !log->is_object()) return none;
  const auto member = log->find(name);
  return member == log->end() ? none : *member;
}

bool starts(std::string_view text, std::string_view head) { return text.substr(0, head.size()) == head; }
bool ends(std::string_view text, std::string_view tail) {
  return text.size() >= tail.size() && text.substr(text.size() - tail.size()) == tail;
}

/// How well a fusion centre's user and those who listen know the state: lanes are compared by it.
bool compares(const Signal& signal) {
  const bool who = signal.node == "fused" || starts(signal.node, "eve.");
  return who && (ends(signal.name, ".square") || ends(signal.name, ".trace"));
}

bool in_overview(const Signal& signal) {
  if (!signal.lane.empty()) {
    const std::string own = "lane." + signal.lane + ".";  // a plant of the lane's own is for those who look at the lane
    if (starts(signal.name, own + "truth.") || starts(signal.name, own + "input.")) return false;
    return (signal.node.empty() && signal.link.empty()) || ends(signal.name, ".error") || ends(signal.name, ".alarm") ||
           compares(signal);
  }
  for (const char* head : {"truth.", "input.", "actuator.", "fault."}) {
    if (starts(signal.name, head)) return true;
  }
  return (starts(signal.name, "link.") || starts(signal.name, "sensor.")) && ends(signal.name, ".state");
}

/// The lane's own signals, the truth, what was really added to the sensors where the lane reconstructs it, and which
/// links to its fusion centre are overheard.
std::vector<int> lane_topic(const std::string& lane, const Catalogue& catalogue) {
  bool reconstructs = false;
  bool centred = false;
  for (const Signal& signal : catalogue.all()) {
    reconstructs = reconstructs || (signal.lane == lane && signal.name.find(".attack.") != std::string::npos);
    centred = centred || signal.name == "lane." + lane + ".fused.square";
  }
  std::vector<int> ids;
  for (const Signal& signal : catalogue.all()) {
    const bool truth = starts(signal.name, "truth.");
    const bool added = reconstructs && starts(signal.name, "sensor.") && ends(signal.name, ".injected");
    const bool heard = centred && ends(signal.name, ".overheard");
    if (signal.lane == lane || (signal.lane.empty() && (truth || added || heard))) ids.push_back(signal.id);
  }
  return ids;
}

}  // namespace

LogPolicy log_policy(const Json& document, const Pace& pace) {
  const Json& policy = log_member(document, "policy");
  if (policy == "live") return LogPolicy::live;
  if (policy == "lossless") return LogPolicy::lossless;
  return pace.paced() ? LogPolicy::live : LogPolicy::lossless;
}

std::optional<double> log_keep(const Json& document) {
  const Json& keep = log_member(document, "keep");
  return keep.is_number() ? std::optional(keep.get<double>()) : std::nullopt;
}

LogSelection log_selection(const Json& document, const Catalogue& catalogue) {
  LogSelection selection;
  const Json& every = log_member(document, "every");
  if (every.is_number_integer()) selection.every = every.get<std::int64_t>();
  const Json& patterns = log_member(document, "signals");
  if (!patterns.is_array()) return selection;
  for (const Signal& signal : catalogue.all()) {
    for (const Json& pattern : patterns) {
      if (!pattern.is_string() || !glob_match(pattern.get_ref<const std::string&>(), signal.name)) continue;
      selection.signals.push_back(signal.id);
      break;
    }
  }
  if (static_cast<int>(selection.signals.size()) == catalogue.size()) selection.signals.clear();
  return selection;
}

std::vector<HubTopic> hub_topics(const Catalogue& catalogue, const Json& document) {
  std::vector<HubTopic> topics{{"overview", {}}};
  for (const Signal& signal : catalogue.all()) {
    if (in_overview(signal)) topics.front().signals.push_back(signal.id);
  }
  for (const auto& [lane, body] : document.at("lanes").items()) {
    topics.push_back({"lane:" + lane, lane_topic(lane, catalogue)});
  }
  HubTopic all{"all", {}};
  for (const Signal& signal : catalogue.all()) all.signals.push_back(signal.id);
  topics.push_back(std::move(all));
  return topics;
}

}  // namespace vigil
