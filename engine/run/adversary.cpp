#include "engine/run/adversary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/core/params.hpp"

namespace vigil {
namespace {

std::string quoted(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::optional<std::int64_t> read_tick(const Json& entry, const char* key, const std::string& pointer) {
  const auto it = entry.find(key);
  if (it == entry.end() || it->is_null()) return std::nullopt;
  if (!it->is_number_integer() || it->get<std::int64_t>() < 0) {
    throw InputError(pointer + "/" + key, fmt::format("{} is {}; expected a tick, a whole number of at least 0, or null", key, quoted(*it)));
  }
  return it->get<std::int64_t>();
}

}  // namespace

Adversary::Adversary(const Json& document, const Graph& graph, const std::vector<std::string>& nodes, std::uint64_t seed, int message)
    : graph_(graph), nodes_(nodes), seed_(seed), message_(message) {
  for (const auto& [id, entry] : document.items()) add(id, entry, false, "/adversary/" + id, 1);
}

Adversary::Adversary(const Adversary& other) : graph_(other.graph_), nodes_(other.nodes_), seed_(other.seed_), message_(other.message_) {
  for (const Entry& e : other.entries_) {
    entries_.push_back({e.id, e.type, e.attack->clone(), e.params, e.links, e.place, e.from, e.to, e.enabled, e.by_hand, e.acting});
  }
}

std::vector<int> Adversary::places(const Json& on, const std::string& pointer) const {
  std::vector<int> links;
  if (!on.is_array() || on.empty()) throw InputError(pointer, "expected a list of places, such as [\"link:*\"] or [\"link:2-5\"]");
  for (std::size_t p = 0; p < on.size(); ++p) {
    const std::string at = fmt::format("{}/{}", pointer, p);
    const std::string place = on[p].is_string() ? on[p].get<std::string>() : quoted(on[p]);
    if (place == "link:*") {
      for (int l = 0; l < static_cast<int>(graph_.links().size()); ++l) links.push_back(l);
      continue;
    }
    if (!place.starts_with("link:")) {
      throw InputError(at, fmt::format("\"{}\" is not a link; attacks of this version act on links", place), "link:* or link:FROM-TO");
    }
    int found = -1;
    for (int l = 0; l < static_cast<int>(graph_.links().size()); ++l) {
      const Link& link = graph_.links()[static_cast<std::size_t>(l)];
      const auto name = fmt::format("link:{}-{}", nodes_[static_cast<std::size_t>(link.from)], nodes_[static_cast<std::size_t>(link.to)]);
      if (name == place) found = l;
    }
    if (found < 0) throw InputError(at, fmt::format("the network has no \"{}\"", place), "link:* or link:FROM-TO");
    links.push_back(found);
  }
  std::sort(links.begin(), links.end());
  links.erase(std::unique(links.begin(), links.end()), links.end());
  return links;
}

std::unique_ptr<Attack> Adversary::make(const std::string& type, const std::string& id, const Json& params, const std::string& pointer) const {
  const auto* entry = Registry<AttackMake>::find(type);
  if (entry == nullptr) {
    const std::string near = nearest(type, Registry<AttackMake>::ids());
    throw InputError(pointer + "/type", fmt::format("there is no attack \"{}\"{}", type, near.empty() ? "" : "; did you mean \"" + near + "\"?"));
  }
  std::vector<Problem> problems;
  const Json complete = entry->params.complete(params, pointer + "/params", problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  return under(pointer + "/params", [&] { return entry->make(Params(complete), {id, seed_, message_}); });
}

void Adversary::add(const std::string& id, const Json& document, bool by_hand, const std::string& pointer, std::int64_t now) {
  Entry entry;
  entry.id = id;
  entry.type = document.value("type", "");
  entry.params = document.value("params", Json::object());
  entry.by_hand = by_hand;
  entry.enabled = document.value("enabled", true);
  entry.links = places(document.value("on", Json::array({"link:*"})), pointer + "/on");
  if (entry.links.size() == 1) {
    const Link& link = graph_.links()[static_cast<std::size_t>(entry.links.front())];
    entry.place = nodes_[static_cast<std::size_t>(link.from)] + "-" + nodes_[static_cast<std::size_t>(link.to)];
  }
  entry.from = read_tick(document, "from", pointer).value_or(now);
  entry.to = read_tick(document, "to", pointer);
  if (entry.to && *entry.to < entry.from) {
    throw InputError(pointer + "/to", fmt::format("to is {}; the attack would end before it begins, at {}", *entry.to, entry.from),
                     fmt::format(">= {}", entry.from));
  }
  entry.attack = make(entry.type, id, entry.params, pointer);
  entries_.push_back(std::move(entry));
}

void Adversary::act(std::int64_t k, LinkEffects& effects, Sink& sink) {
  for (Entry& entry : entries_) {
    const bool acts = entry.enabled && k >= entry.from && (!entry.to || k <= *entry.to);
    if (acts != entry.acting) {
      entry.acting = acts;
      Mark mark;
      mark.k = k;
      mark.type = MarkType::attack;
      mark.edge = acts ? MarkEdge::begin : MarkEdge::end;
      mark.id = entry.id;
      mark.link = entry.place;
      mark.code = entry.type;
      if (entry.place.empty()) mark.detail = fmt::format("{} links", entry.links.size());
      sink.mark(mark);
    }
    if (acts) entry.attack->act(k, entry.links, effects);
  }
}

std::vector<LinkRates> Adversary::rates(const Graph& graph) const {
  std::vector<LinkRates> base(graph_.links().size());
  for (const Entry& entry : entries_) {
    if (entry.by_hand || !entry.enabled) continue;
    const LinkRates mine = entry.attack->rates();
    for (const int link : entry.links) {
      LinkRates& rate = base[static_cast<std::size_t>(link)];
      rate.dos = rate.dos == 0 ? mine.dos : 1 - (1 - rate.dos) * (1 - mine.dos);
      rate.fdi = rate.fdi == 0 ? mine.fdi : 1 - (1 - rate.fdi) * (1 - mine.fdi);
      rate.delta += mine.delta;  // two injections on one channel add up
    }
  }
  std::vector<LinkRates> rates;
  for (const Link& link : graph.links()) rates.push_back(base[static_cast<std::size_t>(graph_.find(link.from, link.to))]);
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

void Adversary::retune(const std::string& id, const std::string& param, const Json& value) {
  const std::string pointer = "/adversary/" + id;
  Entry* entry = find(id);
  if (entry == nullptr) throw InputError(pointer, fmt::format("there is no attack \"{}\" in this run", id));
  if (param == "enabled") {
    if (!value.is_boolean()) throw InputError(pointer + "/enabled", fmt::format("enabled is {}; expected true or false", quoted(value)));
    entry->enabled = value.get<bool>();
    return;
  }
  const Param* declared = Registry<AttackMake>::find(entry->type)->params.find(param);
  if (declared == nullptr || !declared->live) {
    throw InputError(pointer + "/params/" + param, fmt::format("\"{}\" cannot be changed while the run goes on", param));
  }
  Json params = entry->params;
  params[param] = value;
  entry->attack = make(entry->type, id, params, pointer);
  entry->params = std::move(params);
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
