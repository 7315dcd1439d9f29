// BATADAL: a water network of seven tanks that nobody here modelled, where the data are at hand.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/identify/calibrate.hpp"
#include "engine/identify/identify.hpp"
#include "tests/engine/runs/capture.hpp"

namespace vigil::identify::batadal_test {
namespace {

std::filesystem::path folder() {
  const char* shared = std::getenv("VIGIL_SHARED");
  return std::filesystem::path(shared != nullptr ? shared : VIGIL_SOURCE_DIR "/../shared") / "data/batadal";
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::vector<MetricValue> scored(const Scenario& scenario, const std::shared_ptr<const Trace>& trace) {
  vigil::Run run(scenario, {1, trace, {}});
  test::Capture capture;
  test::run_to_end(run, capture);
  EXPECT_TRUE(run.faults().empty());
  return run.metrics();
}

TEST(Batadal, FromTheCleanYearToTheAttackedHalfYear) {
  if (!std::filesystem::exists(folder())) GTEST_SKIP() << "the recording is not at hand: " << folder();
  const std::string clean = text_of(folder() / "dataset03.csv"), attacked = text_of(folder() / "dataset04.csv");
  Task task;
  task.outputs = {"L_T*"};
  task.inputs = {"F_*"};
  task.label = "ATT_FLAG";
  task.dt = 3600;
  const Identified found = identify(clean, task);
  EXPECT_EQ(found.flat, (std::vector<std::string>{"F_PU3", "F_PU5", "F_PU9"}));
  EXPECT_EQ(found.choice.model.order(), 1) << "two lags of seven tanks are more than twelve states";
  EXPECT_EQ(found.choice.model.lag, 1) << "the flow of an hour fills the tank by the next";
  EXPECT_LT(found.choice.model.fitted_radius, kLargestRadius) << "tanks that are controlled come back";
  for (const OutputFigures& figures : found.choice.outputs) {
    EXPECT_GT(figures.r2_held, 0.5) << "at least half of what \"as an hour ago\" leaves is explained";
    EXPECT_LT(figures.whiteness.p, 0.01) << "demand has a daily course that no input says: the report must tell";
  }
  const auto year = std::make_shared<Trace>(Trace::from_csv(table_to_trace(clean, found.mapping)));
  const Scenario scenario = calibrated(Scenario::from_json(scenario_of(found, task)), year, 0.01);
  const auto before = scored(scenario, year);
  EXPECT_NEAR(test::metric(before, "all_chi_square", "nis_mean"), 7, 0.1) << "the residuals' own covariance";
  EXPECT_NEAR(test::metric(before, "all_fixed", "fpr"), 0.01, 0.001) << "the quantile of the same hours";

  const auto half = std::make_shared<Trace>(Trace::from_csv(table_to_trace(attacked, found.mapping)));
  int labelled = 0;
  for (std::int64_t k = 0; k < half->rows(); ++k) labelled += half->at(k, half->find("sensor.L_T1.state")) > 0 ? 1 : 0;
  EXPECT_EQ(labelled, 492);
  const auto after = scored(scenario, half);
  // Never alarming would be right in 1 - 492/4177 of the hours; a detector has to beat that, to find half of the
  // labelled hours, and to keep its false alarms within three times what it learned, the half-year being another.
  EXPECT_GT(test::metric(after, "all_fixed", "accuracy"), 1 - 492.0 / 4177);
  EXPECT_GT(test::metric(after, "all_fixed", "tpr"), 0.5);
  EXPECT_LT(test::metric(after, "all_fixed", "fpr"), 0.03);
  EXPECT_GT(test::metric(after, "all_chi_square", "fpr"), 0.02) << "its law is of white noise, and this is not";
}

}  // namespace
}  // namespace vigil::identify::batadal_test
