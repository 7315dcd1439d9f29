/// Seed 003: a controlled two-tank plant whose output is recorded and played back, under three kinds of noise.
#include "engine/scenario/presets/presets.hpp"

namespace vigil::presets {
namespace {

/// One row of the table in section 3 of the specification.
struct Noise {
  std::string id;
  Json title;
  double random = 0;   ///< P = R = random I
  double bounded = 0;  ///< Mw = Mv = bounded I
  double mu = 0, iota = 0;
  int tau = 0;
};

/// A profile of section 7: what it changes against the method as written.
Json profile(const Noise& noise, const char* path, const Json& changes) {
  Json params = {{"mu", noise.mu}, {"tau", noise.tau}, {"eta", 2}, {"iota", noise.iota}};
  params.update(changes);
  return {{"method", "mixed_filter"}, {"path", path}, {"params", std::move(params)}};
}

Json lanes(const Noise& noise) {
  const Json marked = {{"watermark", "sensor"}, {"amplitude", 2}};
  const auto with = [](Json base, const Json& more) {
    base.update(more);
    return base;
  };
  const Json zeta1 = {{"zeta_max", 1}};
  const Json frozen = {{"threshold", "frozen"}};
  Json result = Json::object();
  result["as_written"] = profile(noise, "loop", Json::object());
  result["innov"] = profile(noise, "loop", {{"residual", "innovation"}});
  result["zeta1"] = profile(noise, "loop", zeta1);
  result["zeta1_freeze"] = profile(noise, "loop", with(zeta1, frozen));
  result["eq29"] = profile(noise, "monitor", Json::object());
  result["eq29_freeze"] = profile(noise, "monitor", frozen);
  result["zeta1_wm"] = profile(noise, "loop", with(zeta1, marked));
  result["zeta1_wm_freeze"] = profile(noise, "loop", with(with(zeta1, marked), frozen));
  const Json patient = {{"tau", 40}, {"eta", 3}};
  result["repaired"] = profile(noise, "loop", with(with(with(zeta1, marked), frozen), patient));
  result["repaired_ctrl"] = profile(noise, "loop",
                                    with(with(with(zeta1, frozen), patient),
                                         {{"residual", "innovation"}, {"watermark", "control"}, {"amplitude", 4}}));
  result["fixed_norm"] = profile(noise, "monitor", with(zeta1, {{"threshold", "fixed_norm"}}));
  result["fixed_square"] = profile(noise, "monitor", with(zeta1, {{"threshold", "fixed_square"}}));
  result["ufir"] = {{"method", "ufir_filter"}};
  if (noise.bounded == 0) result["gmeekf"] = {{"method", "gmeekf"}};
  if (noise.random == 0) result["zonotope"] = {{"method", "zonotope_watermark"}};
  return result;
}

Json document(const Noise& noise) {
  const Json sensor = {{"type", "linear"},
                       {"params",
                        {{"C", {{1.0, 0.2}, {-0.3, 0.789}}},
                         {"R", {noise.random, noise.random}},
                         {"Mv", {noise.bounded, noise.bounded}}}}};
  return {
      {"vigil", 1},
      {"id", noise.id},
      {"title", noise.title},
      {"source", "seed 003"},
      {"family", "replay"},
      {"time", {{"dt", 0.15}, {"steps", 300}}},
      {"plant",
       {{"type", "linear"},
        {"params", {{"A", {{1.0, -0.1}, {0.1, 0.9}}}, {"B", Json::array({Json::array({0.7}), Json::array({0.3})})}}}}},
      {"controller", {{"type", "lqg"}, {"params", {{"Qc", 1}, {"Rc", 1}, {"reference", "zero"}}}}},
      {"nodes", {{"1", {{"sensor", sensor}}}}},
      {"network", {{"graph", "none"}}},
      {"noise",
       {{"Q", {noise.random, noise.random}},
        {"P0", 0},
        {"Mw", {noise.bounded, noise.bounded}},
        {"law", "gmix"},
        {"bounded", "uniform"}}},
      {"initial", {{"truth", {1, 1}}, {"estimates", "truth"}}},
      {"adversary", {{"replay", {{"type", "replay"}, {"on", Json::array({"sensor:1"})}, {"params", {{"case", 1}}}}}}},
      {"lanes", lanes(noise)},
      {"metrics", {{"detection", {{"from", 50}}}, {"state", {{"from", 20}}}}},
      {"view", {{"lane", "repaired"}, {"detector", true}}}};
}

}  // namespace

Json replay_nongaussian() {
  return document(
      {"replay-nongaussian",
       {{"en", "A replayed record: two tanks, noise with outliers"}, {"zh", "重放攻击：双容水箱，含异常值的噪声"}},
       0.2,
       0,
       1,
       0.3,
       20});
}

Json replay_ubb() {
  return document({"replay-ubb",
                   {{"en", "A replayed record: two tanks, noise that is only bounded"},
                    {"zh", "重放攻击：双容水箱，未知但有界噪声"}},
                   0,
                   0.5,
                   0,
                   0.1,
                   15});
}

Json replay_mixed() {
  return document(
      {"replay-mixed",
       {{"en", "A replayed record: two tanks, both kinds of noise"}, {"zh", "重放攻击：双容水箱，混合噪声"}},
       0.2,
       0.5,
       0.5,
       0.3,
       25});
}

}  // namespace vigil::presets
