/// Seed 000, figures 1 to 3: where the cameras stand and what attacks their channels.
#include "engine/papers/consensus.hpp"

#include <cmath>

#include "engine/papers/curves.hpp"
#include "engine/papers/item.hpp"
#include "engine/run/run.hpp"

namespace vigil::papers {
namespace {

/// As the source lists them, in its own numbers.
constexpr double kPrinted[8][2] = {{0.6, 0.6}, {0.6, 1.8}, {1.2, 1.8}, {1.8, 1.8},
                                   {2.4, 1.8}, {2.4, 1.6}, {1.8, 1.2}, {1.2, 1.2}};

struct Picture {
  std::vector<std::array<double, 2>> places;
  std::vector<std::pair<std::string, std::string>> links;
};

Picture picture_of(const Scenario& scenario, std::uint64_t seed) {
  RunOptions options;
  options.seed = seed;
  const Json world = Run(scenario, std::move(options)).world();
  Picture picture;
  for (const Json& node : world.at("nodes")) {
    const Json& at = node.at("position");
    if (at.is_array()) picture.places.push_back({at[0].get<double>(), at[1].get<double>()});
  }
  for (const Json& link : world.at("links"))
    picture.links.emplace_back(link.at("from").get<std::string>(), link.at("to").get<std::string>());
  return picture;
}

/// How many of the two named nodes send to `node`, less those that are not named.
double neighbours(const Picture& picture, const std::string& node, const std::string& a, const std::string& b) {
  double count = 0;
  for (const auto& [from, to] : picture.links) {
    if (to == node) count += from == a || from == b ? 1 : -1;
  }
  return count;
}

Findings topology(Laboratory& laboratory) {
  const Picture picture = picture_of(preset("consensus-literal", {"consensus"}), laboratory.first_seed());
  double off = 0;
  for (std::size_t i = 0; i < picture.places.size() && i < 8; ++i)
    off = std::max(off, std::hypot(picture.places[i][0] - kPrinted[i][0], picture.places[i][1] - kPrinted[i][1]));
  Findings found;
  found.runs = 1;
  found.claim(Reading::printed, "cameras", 8, {static_cast<double>(picture.places.size())}, 8, 8);
  found.claim(Reading::printed, "largest distance of a camera from its printed place", 0, {off}, 0, 1e-12);
  found.claim(Reading::printed, "channels into node 2, from 1 and 3", 2, {neighbours(picture, "2", "1", "3")}, 2, 2);
  found.claim(Reading::printed, "channels into node 5, from 4 and 6", 2, {neighbours(picture, "5", "4", "6")}, 2, 2);
  Panel panel{"cameras and channels", {"x"}, {"y"}, {}};
  Series cameras{"cameras", {}, {}, "points"};
  for (const auto& [x, y] : picture.places) {
    cameras.x.push_back(x);
    cameras.y.push_back(y);
  }
  for (const auto& [from, to] : picture.links) {
    const auto a = static_cast<std::size_t>(std::stoi(from) - 1), b = static_cast<std::size_t>(std::stoi(to) - 1);
    if (a > b) continue;
    panel.series.push_back({from + "-" + to,
                            {picture.places[a][0], picture.places[b][0]},
                            {picture.places[a][1], picture.places[b][1]},
                            "edge"});
  }
  panel.series.push_back(std::move(cameras));
  found.panels.push_back(std::move(panel));
  return found;
}

struct Channel {
  std::string from, to;
  std::string signal(const char* what) const { return "link." + from + "-" + to + "." + what; }
};

/// Ticks of a run in which the channel is in this state (1 DoS, 2 FDI).
double count_of(const Record& record, const Channel& channel, double state) {
  double count = 0;
  for (const double value : record.of(channel.signal("state"))) count += value == state ? 1 : 0;
  return count;
}

/// Squares of the strengths in a run's attacked ticks, their mean; NaN where nothing was attacked.
double power_of(const Record& record, const Channel& channel) {
  std::vector<double> squares;
  const auto &states = record.of(channel.signal("state")), &strengths = record.of(channel.signal("strength"));
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (states[k] > 0) squares.push_back(strengths[k] * strengths[k]);
  }
  return mean_of(squares).value;
}

Series stems(const Record& record, const Channel& channel, double state, const char* name) {
  Series result{name, {}, {}, "stems"};
  const auto &states = record.of(channel.signal("state")), &strengths = record.of(channel.signal("strength"));
  for (std::size_t k = 1; k < states.size(); ++k) {
    if (states[k] != state) continue;
    result.x.push_back(static_cast<double>(k));
    result.y.push_back(strengths[k]);
  }
  return result;
}

Findings attacks(Laboratory& laboratory, const std::vector<Channel>& channels) {
  const Json wide = {{"adversary", {{"links", {{"params", {{"s_std", 3}}}}}}}};
  std::vector<std::string> signals;
  for (const Channel& channel : channels) {
    signals.push_back(channel.signal("state"));
    signals.push_back(channel.signal("strength"));
  }
  const auto records = laboratory.samples(preset("consensus", {"consensus"}, wide), signals);
  Findings found;
  found.runs = static_cast<std::int64_t>(records->size());
  std::vector<double> powers;
  for (const Channel& channel : channels) {
    const std::string name = channel.from + " to " + channel.to;
    for (const auto& [state, word] : {std::pair{1.0, "blocked"}, std::pair{2.0, "falsified"}}) {
      const auto counts = of_runs(*records, [&](const Record& r) { return count_of(r, channel, state); });
      found.claim(Reading::printed, "ticks of 30 in which channel " + name + " is " + word, "some, by eye",
                  mean_of(counts), 4, 8);
    }
    for (const double power : of_runs(*records, [&](const Record& r) { return power_of(r, channel); }))
      powers.push_back(power);
    found.panels.push_back({"channel " + name,
                            {"k"},
                            {"s"},
                            {stems(records->front(), channel, 1, "DoS"), stems(records->front(), channel, 2, "FDI")}});
  }
  found.claims.insert(found.claims.begin(),
                      {Reading::printed, "variance of the attack's strength", 9, mean_of(powers), 6.5, 11.5});
  return found;
}

Findings attacks_on_2(Laboratory& laboratory) { return attacks(laboratory, {{"1", "2"}, {"3", "2"}}); }
Findings attacks_on_5(Laboratory& laboratory) { return attacks(laboratory, {{"4", "5"}, {"6", "5"}}); }

Item attack_item(const char* number, const char* node, Findings (*measure)(Laboratory&)) {
  return {
      std::string("000/fig") + number,
      {std::string("Attacks on the channels into node ") + node, std::string("进入节点") + node + "的信道所受的攻击"},
      "consensus, sections 4 and 12",
      "consensus",
      "Reproduced where the strengths have the printed variance of 9 and each channel is blocked, and falsified, in "
      "about 6 (4 to 8) of 30 ticks.",
      "The probabilities are not given: 0.2 each. The pictures' variance of 9 is used here; the example's text says "
      "N(0,1), which the filter runs have. One strength per directed channel and tick; it is drawn for a blocked "
      "tick too, and a channel is never both.",
      measure};
}

}  // namespace

std::vector<Item> consensus_items() {
  std::vector<Item> list{
      {"000/fig1",
       {"The network of eight cameras", "八个摄像机的网络"},
       "consensus, sections 3 and 12",
       "consensus-literal",
       "Reproduced where every camera stands at its printed place and nodes 2 and 5 hear the two neighbours that the "
       "source illustrates.",
       "The picture of the topology is missing from the source: the ring 1-8 with the chords 3-8 and 4-7 is our "
       "choice. Camera 6 at (2.4, 1.6) breaks the pattern and is kept as printed.",
       topology},
      attack_item("2", "2", attacks_on_2),
      attack_item("3", "5", attacks_on_5)};
  for (Item& item : consensus_tracking_items()) list.push_back(std::move(item));
  return list;
}

}  // namespace vigil::papers
