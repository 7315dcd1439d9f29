/// What the items stand on and what they say in Chinese, held against what they really ask for and measure.
#include <gtest/gtest.h>

#include <set>

#include "engine/papers/chinese.hpp"
#include "engine/papers/curves.hpp"
#include "engine/papers/item.hpp"
#include "engine/scenario/method_page.hpp"
#include "server/papers/threads.hpp"
#include "server/synthesis/dsdp_solver.hpp"

namespace vigil::papers::basis_test {
namespace {

/// A laboratory that remembers which runs it was asked for, one lane at a time.
class Spy final : public Laboratory {
 public:
  std::int64_t runs() const override { return laboratory_.runs(); }
  std::uint64_t first_seed() const override { return laboratory_.first_seed(); }
  std::shared_ptr<const Study> campaign(const Scenario& scenario, std::int64_t runs) override {
    remember(scenario);
    return laboratory_.campaign(scenario, runs);
  }
  std::shared_ptr<const Records> samples(const Scenario& scenario, const std::vector<std::string>& signals,
                                         std::int64_t runs) override {
    remember(scenario);
    return laboratory_.samples(scenario, signals, runs);
  }
  using Laboratory::campaign;
  using Laboratory::samples;

  std::set<std::string> asked;  ///< documents with one lane

 private:
  static LaboratoryOptions options() {
    LaboratoryOptions options;
    options.runs = 2;
    options.threads = 2;
    options.gains = [](const DesignTask& task) {
      DsdpSolver solver;
      return task.solve(solver, 120);
    };
    return options;
  }
  void remember(const Scenario& scenario) {
    for (const auto& [id, lane] : scenario.document().at("lanes").items())
      asked.insert(only(scenario, {id}).document().dump());
  }

  ThreadedLaboratory laboratory_{options()};
};

void expect_asked_for(const Item& item, const std::set<std::string>& asked) {
  for (const Scene& scene : item.basis().scenes) {
    for (const std::string& lane : scene.lanes)
      EXPECT_TRUE(asked.contains(only(scene.scenario(), {lane}).document().dump())) << scene.name.en << ", " << lane;
  }
}

void expect_chinese(const std::string& english) {
  EXPECT_FALSE(chinese(english).empty() && !english.empty()) << "the catalogue lacks \"" << english << '"';
}

void expect_chinese(const Findings& found) {
  for (const Claim& claim : found.claims) {
    expect_chinese(claim.what);
    if (claim.paper.is_string()) expect_chinese(claim.paper.get<std::string>());
  }
  for (const Panel& panel : found.panels) {
    for (const std::string& text : {panel.title, panel.x.label, panel.y.label}) expect_chinese(text);
    for (const Series& series : panel.series) expect_chinese(series.name);
  }
}

TEST(PapersBasis, RunsOfAnItemAreThoseItMeasures) {
  Spy spy;
  for (const Item& item : items()) {
    SCOPED_TRACE(item.key);
    spy.asked.clear();
    const Findings found = item.measure(spy);
    expect_chinese(found);
    if (!spy.asked.empty()) expect_asked_for(item, spy.asked);
  }
}

TEST(PapersBasis, EveryItemHasRunsMethodsEquationsAndChinese) {
  for (const Item& item : items()) {
    SCOPED_TRACE(item.key);
    const Json basis = basis_json(item);
    EXPECT_EQ(basis["equations"].size(), item.basis().equations.size()) << "an equation is not registered";
    for (const char* part : {"scenes", "methods", "equations"}) EXPECT_FALSE(basis[part].empty()) << part;
    for (const Json& method : basis["methods"])
      EXPECT_FALSE(method_page(method["id"].get_ref<const std::string&>()).is_null()) << method;
    for (const Json& scene : basis["scenes"]) {
      const Json patched = Scenario::preset(scene["scenario"].get<std::string>()).patched(scene["patch"]).document();
      EXPECT_FALSE(patched.at("lanes").empty());
      EXPECT_FALSE(scene["name"]["zh"].get<std::string>().empty());
    }
    const Json words = words_json(item, nullptr);
    ASSERT_TRUE(words.is_object());
    for (const char* part : {"reason", "rule"}) {
      const auto text = words[part].get<std::string>();
      EXPECT_TRUE(text.ends_with("。")) << text;
    }
  }
}

TEST(PapersChinese, KeepsNumbersNamesAndOrder) {
  EXPECT_EQ(chinese("mean squared error of px, A1, station 3"), "px 的均方误差，A1，站点 3");
  EXPECT_EQ(chinese("ticks of 30 in which channel 1 to 2 is blocked"), "30 个时刻中信道 1→2 被阻断的个数");
  EXPECT_EQ(chinese("W (1,1)"), "W 的第 (1, 1) 个元素");
  EXPECT_EQ(chinese("lane_of_7"), "lane_of_7");
  EXPECT_EQ(chinese("nobody has written this"), "");
  EXPECT_EQ(chinese("nobody, station 3"), "");
}

TEST(PapersEstimates, OfEqualValuesHaveNoErrorFromRounding) {
  const Estimate same = mean_of(std::vector<double>(7, 0.1 + 0.2));
  EXPECT_EQ(same.value, 0.1 + 0.2);
  EXPECT_EQ(same.se, 0);
  EXPECT_GT(mean_of({1, 2, 4}).se, 0);
}

}  // namespace
}  // namespace vigil::papers::basis_test
