// Who finds gains: in order, one at a time, each problem once, also by the next server.
#include "server/synthesis/designer.hpp"

#include "db/reader.hpp"
#include "db/writer.hpp"
#include "engine/core/input_error.hpp"
#include "server/runs/refusal.hpp"
#include "tests/server/synthesis/scripts.hpp"

namespace vigil::api_test::designer_test {
namespace {

using State = DesignItem::State;

/// y >= 1: what the tasks of this file have solved.
SdpProblem at_least_one() {
  SdpProblem problem{.cost = {1}, .blocks = {1}, .entries = {{0, 0, 0, 0, 1}, {1, 0, 0, 0, 1}}};
  canonicalise(problem);
  return problem;
}

class DesignerTest : public ::testing::Test {
 protected:
  DesignerTest() { open(VIGIL_EXECUTABLE); }
  void open(const std::string& executable, std::size_t max_waiting = 64) {
    designer_.reset();
    reader_.reset();
    log_.reset();
    log_ = std::make_unique<LogWriter>(folder_.file("log.db"));
    reader_ = std::make_unique<LogReader>(folder_.file("log.db"));
    options_.executable = executable;
    options_.max_waiting = max_waiting;
    designer_ = std::make_unique<Designer>(*log_, *reader_, options_, [this] { ++told_; });
  }
  /// Holds where the solver answers, but for those whose verdict is given.
  DesignTask task(const std::string& key, const std::string& verdict = "") {
    DesignTask made;
    made.lane = "lane-" + key;
    made.key = key;
    made.problem = at_least_one;
    made.solve = [this, key, verdict](SdpSolver& solver, double limit) {
      const SdpSolution solution = solver.solve(at_least_one(), limit);
      ++solved_;
      order_ += key;
      if (verdict == "throw") throw std::runtime_error("out of memory");
      const bool holds = verdict.empty() && solution.y.size() == 1;
      return Json{{"key", key},
                  {"holds", holds},
                  {"reason", holds ? "" : "no gains for " + key},
                  {"verdict", verdict.empty() ? std::string(to_string(solution.verdict)) : verdict},
                  {"seconds", solution.seconds},
                  {"L", holds ? Json(solution.y[0]) : Json()}};
    };
    made.check = [key](const Json& record) {
      if (record.at("key") != key || record.at("holds") != true || record.at("L").get<double>() < 0.99) {
        throw InputError("", "this does not hold");
      }
    };
    return made;
  }
  State ask(const DesignTask& task, std::optional<Designer::Holder> holder = {}) {
    return designer_->ask({task}, holder).front().state;
  }
  bool reaches(const std::string& key, State state) {
    return eventually([&] {
      const auto item = designer_->find(key);
      return item && item->state == state;
    });
  }

  TemporaryFolder folder_;
  DesignerOptions options_;
  std::atomic<int> solved_{0}, told_{0};
  std::string order_;  ///< of solving; written by the designer's thread
  std::unique_ptr<LogWriter> log_;
  std::unique_ptr<LogReader> reader_;
  std::unique_ptr<Designer> designer_;
};

TEST_F(DesignerTest, SolvesInOrderAndKnowsTheAnswerAfterwards) {
  open(gated(folder_));
  const auto items = designer_->ask({task("a"), task("b"), task("a")});
  ASSERT_EQ(items.size(), 3u);
  ASSERT_TRUE(reaches("a", State::solving));
  EXPECT_EQ(designer_->find("b")->state, State::queued);
  EXPECT_EQ(designer_->find("b")->seconds, 0);
  EXPECT_TRUE(designer_->find("b")->record.is_null());
  EXPECT_TRUE(eventually([&] { return designer_->find("a")->seconds > 0; }));
  EXPECT_EQ(designer_->find("a")->limit, options_.limit);
  open_gate(folder_);
  ASSERT_TRUE(reaches("b", State::done));
  EXPECT_EQ(order_, "ab");
  const auto done = designer_->ask({task("a")}).front();
  EXPECT_EQ(done.state, State::done);
  EXPECT_NEAR(done.record.at("L").get<double>(), 1, 1e-4);
  EXPECT_EQ(read_sdpa(*designer_->sdpa("a")), at_least_one());
  EXPECT_FALSE(designer_->find("c"));
  EXPECT_FALSE(designer_->sdpa("c"));
  EXPECT_TRUE(eventually([&] { return told_ == 2; }));
}

TEST_F(DesignerTest, TheNextServerKnowsThemToo) {
  ask(task("a"));
  ask(task("b", "infeasible"));
  ASSERT_TRUE(reaches("a", State::done));
  ASSERT_TRUE(reaches("b", State::refused));
  const Json record = designer_->find("a")->record;
  open("/bin/false");
  EXPECT_EQ(designer_->find("a")->record, record);
  EXPECT_EQ(designer_->find("a")->lane, "lane-a");
  EXPECT_EQ(ask(task("a")), State::done);
  EXPECT_EQ(ask(task("b", "infeasible")), State::refused);
  EXPECT_EQ(designer_->find("b")->reason, "no gains for b: the solver finds that the inequalities have no solution");
  EXPECT_EQ(designer_->known(task("a")), record);
  EXPECT_TRUE(designer_->known(task("b")).is_null());
  EXPECT_EQ(read_sdpa(*designer_->sdpa("a")), at_least_one());
  EXPECT_EQ(solved_, 2);
}

TEST_F(DesignerTest, ARecordIsCheckedAnewWheneverItIsTaken) {
  ask(task("a"));
  ASSERT_TRUE(reaches("a", State::done));
  Json record = designer_->find("a")->record;
  open(VIGIL_EXECUTABLE);
  record["L"] = 0.5;
  log_->put_design("a", "lane-a", record, "");
  EXPECT_TRUE(designer_->known(task("a")).is_null());
  EXPECT_EQ(ask(task("a")), State::queued);
  ASSERT_TRUE(reaches("a", State::done));
  EXPECT_EQ(solved_, 2);
  EXPECT_NEAR(designer_->find("a")->record.at("L").get<double>(), 1, 1e-4);
}

TEST_F(DesignerTest, WhatTimedOutOrCrashedIsTriedAgain) {
  open("/bin/false");
  ask(task("a"));
  ASSERT_TRUE(reaches("a", State::refused));
  EXPECT_TRUE(designer_->known(task("a")).is_null());
  EXPECT_NE(ask(task("a")), State::refused);
  ASSERT_TRUE(reaches("a", State::refused));
  EXPECT_EQ(solved_, 2);
  open(VIGIL_EXECUTABLE);
  EXPECT_FALSE(designer_->find("a"));
  ask(task("a"));
  EXPECT_TRUE(reaches("a", State::done));
  ask(task("x", "throw"));
  ASSERT_TRUE(reaches("x", State::refused));
  EXPECT_EQ(designer_->find("x")->reason, "out of memory");
  EXPECT_TRUE(designer_->find("x")->record.is_null());
}

TEST_F(DesignerTest, WhatNobodyWantsAnyMoreIsGivenUp) {
  options_.limit = 1000;
  open(silent(folder_));
  designer_->ask({task("a"), task("b")}, 1);
  ask(task("c"));
  designer_->ask({task("b"), task("c")}, 2);
  ask(task("b"));  // to look at it is not to hold it
  const pid_t pid = child_of(folder_);
  std::filesystem::remove(folder_.file("pid"));
  designer_->release(1);
  EXPECT_FALSE(designer_->find("a"));
  EXPECT_TRUE(reaches("b", State::solving));
  EXPECT_TRUE(eventually([&] { return gone(pid); }));
  child_of(folder_);
  designer_->release(2);
  EXPECT_FALSE(designer_->find("b"));
  EXPECT_TRUE(reaches("c", State::solving));  // wanted for its own sake
  designer_->release(2);
  EXPECT_TRUE(designer_->find("c"));
}

TEST_F(DesignerTest, ManyWaitButNotAnyNumber) {
  open(silent(folder_), 3);
  ask(task("a"));
  ASSERT_TRUE(reaches("a", State::solving));
  designer_->ask({task("b"), task("c"), task("d")});
  EXPECT_THROW(ask(task("e")), RunRefusal);
  EXPECT_FALSE(designer_->find("e"));
}

TEST_F(DesignerTest, StopsInTheMiddleOfASolve) {
  options_.limit = 1000;
  open(silent(folder_));
  designer_->ask({task("a"), task("b")});
  const pid_t pid = child_of(folder_);
  designer_->stop();
  EXPECT_TRUE(gone(pid));
  EXPECT_EQ(told_, 0);
  EXPECT_THROW(ask(task("c")), RunRefusal);
}

TEST_F(DesignerTest, OldAnswersLeaveTheMemoryButNotTheLog) {
  options_.max_settled = 2;
  open(VIGIL_EXECUTABLE);
  for (const char* key : {"a", "b", "c", "d"}) ask(task(key));
  ask(task("x", "timed_out"));
  ASSERT_TRUE(reaches("x", State::refused));
  for (const char* key : {"a", "b", "c", "d"}) {
    ASSERT_TRUE(designer_->find(key));
    EXPECT_EQ(designer_->find(key)->state, State::done);
    EXPECT_EQ(ask(task(key)), State::done);
  }
  EXPECT_EQ(solved_, 5);
}

}  // namespace
}  // namespace vigil::api_test::designer_test
