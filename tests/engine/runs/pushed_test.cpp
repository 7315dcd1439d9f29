// Rows pushed into a run one by one: the same as a trace of them.
#include "engine/run/pushed_columns.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::pushed_test {
namespace {

using test::Capture;
using test::expect_same;
using test::run_to_end;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

struct Rows {
  std::vector<std::string> names;
  std::vector<std::vector<double>> cells;
  double dt = 1;

  std::string csv() const {
    Catalogue header;
    for (const std::string& name : names) header.add({.name = name});
    std::string text = csv_header(header);
    for (std::size_t k = 0; k < cells.size(); ++k)
      append_csv_row(text, {static_cast<std::int64_t>(k), static_cast<double>(k) * dt, cells[k]});
    return text;
  }
};

/// What a simulated run shows of these columns.
Rows simulated(const Scenario& scenario, std::uint64_t seed, std::vector<std::string> names) {
  vigil::Run run(scenario, {seed, nullptr, {}});
  Capture capture;
  run_to_end(run, capture);
  Rows rows{std::move(names), {}, run.dt()};
  for (const Frame& frame : capture.frames) {
    rows.cells.emplace_back();
    for (const std::string& name : rows.names) {
      const int id = run.catalogue().find(name);
      rows.cells.back().push_back(id < 0 ? kMissing : frame.values[static_cast<std::size_t>(id)]);
    }
  }
  return rows;
}

void expect_pushed_like_trace(const Scenario& scenario, const Rows& rows) {
  vigil::Run traced(scenario, {5, std::make_shared<Trace>(Trace::from_csv(rows.csv())), {}});
  Capture first;
  run_to_end(traced, first);
  const auto growing = std::make_shared<Trace>(Trace::growing(rows.names));
  vigil::Run pushed(scenario, {5, growing, {}});
  Capture second;
  for (const auto& cells : rows.cells) {
    const std::int64_t before = pushed.tick();
    pushed.step(second);
    EXPECT_EQ(pushed.tick(), before) << "a tick without its row";
    growing->append(cells);
    pushed.step(second);
    EXPECT_EQ(pushed.tick(), before + 1);
  }
  expect_same(traced, first, pushed, second, "");
}

class PushedRows : public ::testing::TestWithParam<const char*> {};

TEST_P(PushedRows, GiveTheSameSamplesAsTheirTrace) {
  const Scenario scenario = Scenario::preset(GetParam());
  Rows rows = simulated(scenario, 21, pushed_columns(scenario).names);
  expect_pushed_like_trace(scenario, rows);
  for (std::size_t k = 3; k < rows.cells.size(); k += 4) rows.cells[k][k % rows.names.size()] = kMissing;
  expect_pushed_like_trace(scenario, rows);
}

INSTANTIATE_TEST_SUITE_P(Presets, PushedRows,
                         ::testing::Values("consensus", "sparse", "replay-ubb", "privacy-robot-linear"),
                         [](const auto& which) {
                           std::string name = which.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(PushedRows, MayTellOfAttacksAndOfALaneComputedElsewhere) {
  const Scenario scenario = Scenario::preset("consensus");
  std::vector<std::string> further = {"sensor.1.state", "link.1-2.state", "link.1-2.injected.x"};
  for (const char* c : {"x", "y", "theta"}) further.push_back(std::string("lane.isolated.1.estimate.") + c);
  Rows rows = simulated(scenario, 22, pushed_columns(scenario, further).names);
  for (std::string& name : rows.names) {
    if (name.starts_with("lane.isolated.")) name.replace(0, 14, "lane.elsewhere.");
  }
  expect_pushed_like_trace(scenario, rows);
}

TEST(PushedRows, WithoutTruthNeedAnInitialEstimate) {
  const Scenario scenario = Scenario::preset("consensus");
  const auto growing = std::make_shared<Trace>(Trace::growing(pushed_columns(scenario).names));
  vigil::Run run(scenario, {5, growing, {}});
  growing->append(std::vector<double>(growing->columns().size(), kMissing));
  Capture capture;
  if (scenario.document().value("initial", Json::object()).value("truth", Json()).is_null()) {
    EXPECT_THROW(run.step(capture), InputError);
  } else {
    run.step(capture);
    EXPECT_EQ(run.tick(), 0);
  }
}

TEST(PushedColumns, AreWhatTheScenarioMeasures) {
  const PushedColumns columns =
      pushed_columns(Scenario::preset("sparse"), {"sensor.2.range.injected", "link.1-2.state"});
  EXPECT_EQ(columns.nodes, (std::vector<std::string>{"1", "2", "3", "4", "5"}));
  EXPECT_EQ(columns.names.front(), "sensor.1.range");
  EXPECT_EQ(columns.reporter.front(), 0);
  EXPECT_EQ(columns.reporter[columns.reporter.size() - 2], 1);
  EXPECT_EQ(columns.reporter.back(), -1);
  EXPECT_THROW(pushed_columns(Scenario::preset("sparse"), {"truth.px"}), InputError);
  EXPECT_THROW(pushed_columns(Scenario::preset("sparse"), {"a b"}), InputError);
  EXPECT_THROW(check_pushed(columns, Catalogue()), InputError);
  EXPECT_EQ(largest_state("link.1-2.state"), 3);
  EXPECT_EQ(largest_state("lane.a.sensor.1.state"), 6);
  EXPECT_EQ(largest_state("truth.state"), std::nullopt);
}

TEST(GrowingTrace, RemembersItsNewestRows) {
  Trace trace = Trace::growing({"truth.x"});
  EXPECT_EQ(trace.rows(), 0);
  for (int k = 0; k < 100; ++k) trace.append(std::vector<double>{static_cast<double>(k)});
  EXPECT_EQ(trace.rows(), 100);
  EXPECT_EQ(trace.at(99, 0), 99);
  EXPECT_EQ(trace.at(90, 0), 90);
  EXPECT_TRUE(std::isnan(trace.at(0, 0)));
  EXPECT_TRUE(std::isnan(trace.at(100, 0)));
  EXPECT_THROW(trace.append(std::vector<double>{1, 2}), std::logic_error);
  Trace fixed = Trace::from_csv("k,t,a\n0,0,1\n");
  EXPECT_THROW(fixed.append(std::vector<double>{1}), std::logic_error);
  EXPECT_THROW(Trace::growing({"a", "a"}), std::logic_error);
}

}  // namespace
}  // namespace vigil::pushed_test
