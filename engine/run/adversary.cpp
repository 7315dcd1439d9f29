#include "engine/run/adversary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/params.hpp"
#include "engine/scenario/document.hpp"

namespace vigil {
namespace {

constexpr const char* kPlaces =
    "link:*, link:FROM-TO, sensor:NODE, sensor:NODE.CHANNEL, actuator:NODE or actuator:NODE.CHANNEL";

std::string quoted(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::optional<std::int64_t> read_tick(const Json& entry, const char* key, const std::string& pointer) {
  const auto it = entry.find(key);
  if (it == entry.end() || it->is_null()) return std::nullopt;
  if (!it->is_number_integer() || it->get<std::int64_t>() < 0) {
    throw InputError(pointer + "/" + key,
                     fmt::format("{} is {}; expected a tick, a whole number of at least 0, or null", key, quoted(*it)));
  }
  return it->get<std::int64_t>();
}

}  // namespace

Adversary::Adversary(const Json& document, const Graph& graph, const std::vector<std::string>& nodes,
                     const std::vector<std::vector<std::string>>& channels,
                     const std::vector<std::vector<std::string>>& actuators, std::uint64_t seed, int message,
                     bool continuous)
    : graph_(graph),
      nodes_(nodes),
      channels_(channels),
      actuators_(actuators),
      seed_(seed),
      message_(message),
      continuous_(continuous) {
  for (const auto& [id, entry] : document.items()) add(id, entry, false, "/adversary/" + id, 1);
}

Adversary::Adversary(const Adversary& other)
    : graph_(other.graph_),
      nodes_(other.nodes_),
      channels_(other.channels_),
      actuators_(other.actuators_),
      seed_(other.seed_),
      message_(other.message_),
      continuous_(other.continuous_) {
  for (const Entry& e : other.entries_) {
    entries_.push_back({e.id, e.type, e.attack->clone(), e.params, e.links, e.sensors, e.actuators, e.link_name,
                        e.node_name, e.from, e.start, e.to, e.every, e.length, e.budget, e.enabled, e.by_hand,
                        e.acting});
  }
}

int Adversary::find_link(const std::string& from, const std::string& to) const {
  return graph_.find(end_index(from, nodes_, graph_), end_index(to, nodes_, graph_));
}

SensorPlace Adversary::find_channel(const Place& at, const std::string& pointer) const {
  const auto found = std::find(nodes_.begin(), nodes_.end(), at.node);
  if (found == nodes_.end())
    throw InputError(pointer, fmt::format("there is no node \"{}\"", at.node),
                     fmt::format("{}", fmt::join(nodes_, ", ")));
  SensorPlace place{static_cast<int>(found - nodes_.begin()), -1};
  const bool actuator = at.kind == PlaceKind::actuator;
  const auto& names = (actuator ? actuators_ : channels_)[static_cast<std::size_t>(place.node)];
  if (actuator && names.empty())
    throw InputError(pointer, fmt::format("the plant has no actuator at node \"{}\" that could be attacked", at.node));
  if (at.channel.empty()) return place;
  const auto name = std::find(names.begin(), names.end(), at.channel);
  if (name == names.end()) {
    throw InputError(pointer,
                     fmt::format("{} {} has no channel \"{}\"", actuator ? "actuator" : "sensor", at.node, at.channel),
                     fmt::format("{}", fmt::join(names, ", ")));
  }
  place.channel = static_cast<int>(name - names.begin());
  return place;
}

void Adversary::find_places(const Json& on, const std::string& pointer, Entry& entry) const {
  if (!on.is_array() || on.empty())
    throw InputError(pointer, "expected a list of places, such as [\"link:*\"] or [\"sensor:3\"]");
  for (std::size_t p = 0; p < on.size(); ++p) {
    const std::string at = fmt::format("{}/{}", pointer, p);
    const std::string text = on[p].is_string() ? on[p].get<std::string>() : quoted(on[p]);
    const auto place = parse_place(text);
    if (!place) throw InputError(at, fmt::format("\"{}\" is no place that an attack acts on", text), kPlaces);
    if (place->kind == PlaceKind::every_link) {
      for (int l = 0; l < static_cast<int>(graph_.links().size()); ++l) entry.links.push_back(l);
    } else if (place->kind == PlaceKind::link) {
      entry.links.push_back(find_link(place->from, place->to));
      if (entry.links.back() < 0) throw InputError(at, fmt::format("the network has no \"{}\"", text), kPlaces);
    } else {
      (place->kind == PlaceKind::actuator ? entry.actuators : entry.sensors).push_back(find_channel(*place, at));
    }
  }
  std::sort(entry.links.begin(), entry.links.end());
  entry.links.erase(std::unique(entry.links.begin(), entry.links.end()), entry.links.end());
  if (entry.links.size() + entry.sensors.size() + entry.actuators.size() != 1) return;
  if (!entry.links.empty()) {
    entry.link_name = link_name(graph_.links()[static_cast<std::size_t>(entry.links.front())], nodes_);
  } else {
    const auto& places = entry.sensors.empty() ? entry.actuators : entry.sensors;
    entry.node_name = nodes_[static_cast<std::size_t>(places.front().node)];
  }
}

std::unique_ptr<Attack> Adversary::make(const Entry& entry, const Json& given, const std::string& pointer) const {
  const auto* kind = Registry<AttackMake>::find(entry.type);
  if (kind == nullptr) {
    const std::string near = nearest(entry.type, Registry<AttackMake>::ids());
    throw InputError(pointer + "/type", fmt::format("there is no attack \"{}\"{}", entry.type,
                                                    near.empty() ? "" : "; did you mean \"" + near + "\"?"));
  }
  std::vector<Problem> problems;
  const Json complete = kind->params.complete(given, pointer + "/params", problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  AttackContext context{.id = entry.id,
                        .seed = seed_,
                        .message = message_,
                        .on_links = !entry.links.empty(),
                        .single_channels = std::any_of(entry.sensors.begin(), entry.sensors.end(),
                                                       [](const SensorPlace& place) { return place.channel >= 0; }),
                        .continuous = continuous_,
                        .from = entry.from,
                        .to = entry.to,
                        .by_hand = entry.by_hand};
  const auto sizes = [](const std::vector<SensorPlace>& places, const std::vector<std::vector<std::string>>& names) {
    std::vector<int> all;
    for (const SensorPlace& place : places)
      all.push_back(place.channel >= 0 ? 1 : static_cast<int>(names[static_cast<std::size_t>(place.node)].size()));
    return all;
  };
  context.readings = sizes(entry.sensors, channels_);
  context.actuators = sizes(entry.actuators, actuators_);
  check_kinds(entry, kind->traits, pointer + "/on");
  return under(pointer + "/params", [&] { return kind->make(Params(complete), context); });
}

void Adversary::check_kinds(const Entry& entry, const Traits<AttackMake>& traits, const std::string& pointer) const {
  const auto acts = [&](ChannelKind kind) {
    return std::find(traits.acts_on.begin(), traits.acts_on.end(), kind) != traits.acts_on.end();
  };
  const auto need = [&](bool named, ChannelKind kind) {
    if (!named || acts(kind)) return;
    std::vector<std::string> others;
    if (acts(ChannelKind::link)) others.emplace_back("link:* or link:FROM-TO");
    if (acts(ChannelKind::sensor)) others.emplace_back("sensor:NODE or sensor:NODE.CHANNEL");
    if (acts(ChannelKind::actuator)) others.emplace_back("actuator:NODE or actuator:NODE.CHANNEL");
    throw InputError(pointer, fmt::format("\"{}\" does not act on {}s", entry.type, word(kind)),
                     fmt::format("{}", fmt::join(others, ", ")));
  };
  // link:* of a network without any link names links all the same
  need(!entry.links.empty() || (entry.sensors.empty() && entry.actuators.empty()), ChannelKind::link);
  need(!entry.sensors.empty(), ChannelKind::sensor);
  need(!entry.actuators.empty(), ChannelKind::actuator);
  if (!entry.actuators.empty() && continuous_ && traits.on_commands)
    throw InputError(pointer,
                     fmt::format("\"{}\" stops commands, which a plant in continuous time does not get tick by "
                                 "tick; its inputs are given signals",
                                 entry.type));
}

void Adversary::add(const std::string& id, const Json& document, bool by_hand, const std::string& pointer,
                    std::int64_t now) {
  Entry entry;
  entry.id = id;
  entry.type = document.value("type", "");
  entry.params = document.value("params", Json::object());
  entry.by_hand = by_hand;
  entry.enabled = document.value("enabled", true);
  find_places(document.value("on", Json::array({"link:*"})), pointer + "/on", entry);
  entry.from = read_tick(document, "from", pointer).value_or(now);
  entry.to = read_tick(document, "to", pointer);
  if (entry.to && *entry.to < entry.from) {
    throw InputError(pointer + "/to",
                     fmt::format("to is {}; the attack would end before it begins, at {}", *entry.to, entry.from),
                     fmt::format(">= {}", entry.from));
  }
  if (const Json schedule = document.value("schedule", Json(nullptr)); schedule.is_object()) {
    entry.every = schedule.value("every", Json(nullptr)).is_number() ? schedule["every"].get<std::int64_t>() : 0;
    entry.length = entry.every > 0 ? schedule["for"].get<std::int64_t>() : 0;
    entry.budget = schedule.value("budget", Json(nullptr)).is_number() ? schedule["budget"].get<std::int64_t>() : 0;
  }
  entry.attack = make(entry, entry.params, pointer);
  entry.start = std::max(entry.from, entry.attack->start());
  const auto later = [&](const Entry& other) {
    return other.start != entry.start ? other.start > entry.start : other.id > entry.id;
  };
  entries_.insert(std::find_if(entries_.begin(), entries_.end(), later), std::move(entry));
}

void Adversary::mark_edge(std::int64_t k, const Entry& entry, Sink& sink) const {
  Mark mark;
  mark.k = k;
  mark.type = MarkType::attack;
  mark.edge = entry.acting ? MarkEdge::begin : MarkEdge::end;
  mark.id = entry.id;
  mark.link = entry.link_name;
  mark.node = entry.node_name;
  mark.code = entry.type;
  if (entry.links.size() > 1) mark.detail = fmt::format("{} links", entry.links.size());
  if (entry.sensors.size() > 1)
    mark.detail += fmt::format("{}{} sensors", mark.detail.empty() ? "" : ", ", entry.sensors.size());
  if (entry.actuators.size() > 1)
    mark.detail += fmt::format("{}{} actuators", mark.detail.empty() ? "" : ", ", entry.actuators.size());
  const std::string remark = entry.acting ? entry.attack->remark() : "";
  if (!remark.empty()) mark.detail += (mark.detail.empty() ? "" : "; ") + remark;
  sink.mark(mark);
}

bool Adversary::scheduled(const Entry& entry, std::int64_t k) {
  const std::int64_t since = k - entry.from;
  const std::int64_t phase = entry.every > 0 ? since % entry.every : since;
  if (entry.every > 0 && phase >= entry.length) return false;
  const std::int64_t spent = entry.every > 0 ? since / entry.every * entry.length + phase : since;
  return entry.budget == 0 || spent < entry.budget;
}

void Adversary::act(std::int64_t k, LinkEffects& links, SensorEffects& sensors, ActuatorEffects& actuators,
                    Sink& sink) {
  for (Entry& entry : entries_) {
    const bool acts = entry.enabled && k >= entry.from && (!entry.to || k <= *entry.to) && scheduled(entry, k) &&
                      entry.attack->active(k);
    if (acts != entry.acting) {
      entry.acting = acts;
      mark_edge(k, entry, sink);
    }
    if (!acts) continue;
    if (!entry.links.empty()) entry.attack->act(k, entry.links, links);
    if (!entry.sensors.empty()) entry.attack->tamper(k, entry.sensors, sensors);
    if (!entry.actuators.empty()) entry.attack->reach(k, entry.actuators, actuators);
  }
}

std::vector<LinkRates> Adversary::rates(const Graph& graph) const {
  std::vector<LinkRates> base(graph_.links().size());
  for (const Entry& entry : entries_) {
    if (entry.by_hand || !entry.enabled || entry.links.empty()) continue;
    const LinkRates mine = entry.attack->rates();
    for (const int link : entry.links) {
      LinkRates& rate = base[static_cast<std::size_t>(link)];
      rate.dos = rate.dos == 0 ? mine.dos : 1 - (1 - rate.dos) * (1 - mine.dos);
      rate.fdi = rate.fdi == 0 ? mine.fdi : 1 - (1 - rate.fdi) * (1 - mine.fdi);
      rate.delta += mine.delta;  // two injections on one channel add up
    }
  }
  std::vector<LinkRates> rates;
  for (const Link& link : graph.links())
    rates.push_back(base[static_cast<std::size_t>(graph_.find(link.from, link.to))]);
  return rates;
}

Adversary::Entry* Adversary::find(const std::string& id) {
  for (Entry& entry : entries_) {
    if (entry.id == id) return &entry;
  }
  return nullptr;
}

bool Adversary::has(const std::string& id) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.id == id; });
}

std::string Adversary::free_id() const {
  for (int i = 1;; ++i) {
    const std::string id = fmt::format("a{}", i);
    if (!has(id)) return id;
  }
}

void Adversary::retune(const std::string& id, const Json& values) {
  const std::string pointer = "/adversary/" + id;
  Entry* entry = find(id);
  if (entry == nullptr) throw InputError(pointer, fmt::format("there is no attack \"{}\" in this run", id));
  bool enabled = entry->enabled;
  Json params = entry->params;
  for (const auto& [name, value] : values.items()) {
    if (name == "enabled") {
      if (!value.is_boolean())
        throw InputError(pointer + "/enabled", fmt::format("enabled is {}; expected true or false", quoted(value)));
      enabled = value.get<bool>();
      continue;
    }
    const Param* declared = Registry<AttackMake>::find(entry->type)->params.find(name);
    if (declared == nullptr || !declared->live) {
      throw InputError(pointer + "/params/" + name,
                       fmt::format("\"{}\" cannot be changed while the run goes on", name));
    }
    params[name] = value;
  }
  entry->attack = make(*entry, params, pointer);
  entry->params = std::move(params);
  entry->enabled = enabled;
}

void Adversary::start(const Json& attack, std::int64_t k) {
  const std::string id = attack.value("id", "");
  if (has(id)) throw InputError("/attack/id", fmt::format("there is already an attack \"{}\" in this run", id));
  add(id, attack, true, "/attack", k);
}

void Adversary::end(const std::string& id, std::int64_t k) {
  Entry* entry = find(id);
  if (entry == nullptr) throw InputError("/end_attack", fmt::format("there is no attack \"{}\" in this run", id));
  if (!entry->by_hand) {  // a document's attack is switched off, so that it can be switched on again
    entry->enabled = false;
    return;
  }
  if (entry->to && *entry->to < k) throw InputError("/end_attack", fmt::format("attack \"{}\" has already ended", id));
  entry->to = k - 1;
}

}  // namespace vigil
