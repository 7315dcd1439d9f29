/// What is handed out and what comes back, without a broker: jobs, pieces, the ledger, a plan that was shipped.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "engine/run/trace.hpp"
#include "server/crew/fingerprint.hpp"
#include "server/crew/ledger.hpp"
#include "server/crew/pack.hpp"
#include "server/crew/shipped_plan.hpp"
#include "server/crew/threads.hpp"

namespace vigil::crew_test {
namespace {

std::string bytes_of(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::string bytes(size, '\0');
  for (char& c : bytes) c = static_cast<char>(random());
  return bytes;
}

JobResult made(const TrialJob& job, double seconds = 0.001) {
  JobResult result;
  result.job = job;
  result.seconds = seconds;
  for (std::int64_t i = 0; i < job.count; ++i) result.trials.push_back("trial " + std::to_string(job.first + i));
  return result;
}

TEST(Pack, ComesBackAndRefusesDamage) {
  for (const std::size_t size : {0U, 1U, 100'000U}) {
    const std::string bytes = bytes_of(size, 1);
    EXPECT_EQ(unpack(pack(bytes), size), bytes);
  }
  const std::string packed = pack(std::string(50'000, 'a') + bytes_of(1000, 2));
  EXPECT_THROW(unpack(packed, 50'999), std::runtime_error) << "more than allowed";
  EXPECT_THROW(unpack(packed.substr(0, packed.size() - 1), 1 << 20), std::runtime_error);
  EXPECT_THROW(unpack("", 1 << 20), std::runtime_error);
  EXPECT_THROW(unpack(bytes_of(500, 3), 1 << 20), std::runtime_error);
  std::string damaged = packed;
  damaged[packed.size() / 2] = static_cast<char>(damaged[packed.size() / 2] ^ 1);
  EXPECT_THROW(unpack(damaged, 1 << 20), std::runtime_error) << "the checksum";
}

TEST(Jobs, ComeBackAsTheyWere) {
  const TrialJob job{17, 4, 2};
  EXPECT_EQ(job_from_bytes(to_bytes(job)), job);
  EXPECT_THROW(job_from_bytes(to_bytes(job) + "x"), std::runtime_error);
  EXPECT_THROW(job_from_bytes(to_bytes(job).substr(1)), std::runtime_error);
  EXPECT_THROW(job_from_bytes(to_bytes({-1, 4, 1})), std::runtime_error);
  EXPECT_THROW(job_from_bytes(to_bytes({0, 0, 1})), std::runtime_error);
}

TEST(Pieces, ComeTogetherInAnyOrder) {
  JobResult result = made({5, 3, 1});
  for (std::string& trial : result.trials) trial = bytes_of(5000, 7);
  result.trials[1] = bytes_of(3000, 8);
  auto first = pieces_of(result, 1, 1200), second = pieces_of(result, 2, 2000);
  EXPECT_GT(first.size(), 5U);
  for (const std::string& piece : first) EXPECT_LE(piece.size(), 1200U);
  std::reverse(first.begin(), first.end());
  first.insert(first.end() - 1, first.front());  // twice, as a broker may
  first.insert(first.begin() + 2, second.begin(), second.end() - 1);
  JobAssembler assembler;
  JobResult back;
  for (std::size_t i = 0; i + 1 < first.size(); ++i) EXPECT_FALSE(assembler.put(first[i], back)) << i;
  ASSERT_TRUE(assembler.put(first.back(), back));
  EXPECT_EQ(back.job, result.job);
  EXPECT_EQ(back.seconds, result.seconds);
  EXPECT_EQ(back.trials, result.trials);
}

TEST(Pieces, DamageIsRefused) {
  const std::string piece = pieces_of(made({0, 2, 1}), 1, 100'000).front();
  JobAssembler assembler;
  JobResult back;
  for (std::size_t size = 0; size < piece.size(); ++size)
    EXPECT_THROW(assembler.put(piece.substr(0, size), back), std::runtime_error) << size;
  for (std::size_t place = 0; place < piece.size(); ++place) {
    std::string bad = piece;
    bad[place] = static_cast<char>(bad[place] ^ 0x41);
    try {
      if (!assembler.put(bad, back)) continue;
      EXPECT_EQ(static_cast<std::int64_t>(back.trials.size()), back.job.count);
    } catch (const std::runtime_error&) {
    }
  }
  JobResult short_of_one = made({0, 2, 1});
  short_of_one.trials.pop_back();
  EXPECT_THROW(assembler.put(pieces_of(short_of_one, 1, 100'000).front(), back), std::runtime_error);
}

TEST(Ledger, CountsEveryTrialOnceWhateverComes) {
  TrialLedger ledger(3, 400, 400);
  std::mt19937 random(5);
  std::vector<TrialJob> handed_out;
  std::vector<std::int64_t> taken;
  for (int round = 0; !ledger.done(); ++round) {
    ASSERT_LT(round, 100'000);
    while (const auto job = ledger.next(2)) handed_out.push_back(*job);
    if (round % 7 == 3) ledger.again();
    for (int i = 0; i < 3 && !handed_out.empty(); ++i) {  // lost, twice, late and out of order
      const std::size_t pick = random() % handed_out.size();
      if (random() % 3 != 0) ledger.put(made(handed_out[pick], 0.01));
      if (random() % 4 == 0) handed_out.erase(handed_out.begin() + static_cast<std::ptrdiff_t>(pick));
    }
    while (const auto next = ledger.take()) {
      EXPECT_EQ(next->second, "trial " + std::to_string(next->first));
      taken.push_back(next->first);
    }
  }
  ASSERT_EQ(taken.size(), 397U);
  for (std::size_t i = 0; i < taken.size(); ++i) EXPECT_EQ(taken[i], static_cast<std::int64_t>(i) + 3);
  EXPECT_EQ(ledger.under_way(), 0U);
  EXPECT_FALSE(ledger.next(2));
}

TEST(Ledger, RunsAheadOnlySoFarAndMakesRangesOfSmallTrials) {
  TrialLedger ledger(0, 1'000'000, 1'000'000);
  std::vector<TrialJob> jobs;
  while (const auto job = ledger.next(2)) jobs.push_back(*job);
  EXPECT_EQ(jobs.size(), static_cast<std::size_t>(2 * TrialLedger::kJobsAhead)) << "one by one, at first";
  for (const TrialJob& job : jobs) ledger.put(made(job, 0.001));
  while (ledger.take()) {
  }
  const auto job = ledger.next(2);
  ASSERT_TRUE(job);
  EXPECT_LE(job->count, static_cast<std::int64_t>(TrialLedger::kJobSeconds / 0.001));
  EXPECT_GT(job->count, static_cast<std::int64_t>(TrialLedger::kJobSeconds / 0.001) - kTrialBlock);
  EXPECT_EQ((job->first + job->count) % kTrialBlock, 0) << "it ends with a block";
  std::int64_t most = job->first + job->count;
  while (const auto more = ledger.next(2)) most = more->first + more->count;
  EXPECT_LE(most - ledger.merged(), (2 * TrialLedger::kJobsAhead + 1) * job->count);
}

TEST(Ledger, RangesShrinkTowardsTheEnd) {
  TrialLedger ledger(0, 200, 200);
  ledger.put(made(*ledger.next(4), 0.0001));
  std::int64_t last = 0, first = 0;
  while (const auto job = ledger.next(4)) {
    if (first == 0) first = job->count;
    last = job->count;
    ledger.put(made(*job, 0.0001 * static_cast<double>(job->count)));
    while (ledger.take()) {
    }
  }
  EXPECT_GT(first, 10);
  EXPECT_EQ(last, 1);
  EXPECT_TRUE(ledger.done());
}

TEST(Ledger, AJobThatNobodySurvivesIsTakenApart) {
  TrialLedger ledger(0, 1000, 1000);
  ledger.put(made(*ledger.next(1), 0.05));
  TrialJob job;
  while (job.count < 2) job = *ledger.next(1);
  EXPECT_FALSE(ledger.exhausted(job)) << "each is tried alone first";
  EXPECT_FALSE(ledger.exhausted(job)) << "it is known already";
  std::set<std::int64_t> alone;
  for (std::int64_t i = 0; i < job.count; ++i) {
    const auto one = ledger.next(1);
    ASSERT_TRUE(one);
    EXPECT_EQ(one->count, 1);
    alone.insert(one->first);
    if (one->first == job.first) {
      EXPECT_TRUE(ledger.exhausted(*one)) << "given up";
    }
  }
  EXPECT_EQ(*alone.begin(), job.first);
  EXPECT_EQ(static_cast<std::int64_t>(alone.size()), job.count);
}

// A worker brings what the campaign's last process, killed since, had asked of it.
TEST(Ledger, AJobOfAnotherLedgerLeavesNoHole) {
  TrialLedger ledger(0, 1000, 1000);
  ledger.put(made(*ledger.next(1), 0.05));
  TrialJob job;
  while (job.count < 2) job = *ledger.next(1);
  while (ledger.next(1)) {
  }
  ledger.put(made({job.first + 1, job.count, 1}, 0.05));
  ledger.put(made(job, 0.05));
  std::int64_t last = -1;
  for (std::int64_t index = 1; index < job.first; ++index) ledger.put(made({index, 1, 1}, 0.05));
  while (const auto next = ledger.take()) last = next->first;
  EXPECT_EQ(last, job.first + job.count - 1);
}

TEST(Ledger, WhatATrialThrewEndsTheCampaign) {
  TrialLedger ledger(0, 10, 10);
  JobResult result{*ledger.next(1), 0, "out of memory", {}};
  EXPECT_THROW(ledger.put(result), std::runtime_error);
}

CampaignPlan small_plan() {
  CampaignPlan plan;
  plan.points =
      make_grid(Scenario::preset("consensus").with("time.steps", 4), {{"lanes.consensus.params.tau", {0.01, 0.02}}});
  plan.runs = 3;
  plan.first_seed = 11;
  plan.threads = 2;
  return plan;
}

TEST(ShippedPlan, MakesTheSameTrials) {
  const CampaignPlan plan = small_plan();
  const std::string bytes = ship(plan);
  EXPECT_EQ(bytes, ship(plan)) << "it names the campaign";
  ShippedPlan shipped(bytes);
  const std::atomic<bool> never{false};
  ThreadCrew().run(plan, never, [&](std::int64_t index, const TrialResult& trial) {
    EXPECT_EQ(save_trial(trial), save_trial(shipped.trial(index, never))) << index;
  });
  EXPECT_THROW(shipped.trial(6, never), std::out_of_range);
  EXPECT_THROW(shipped.trial(-1, never), std::out_of_range);
  EXPECT_THROW(ShippedPlan("nothing"), std::runtime_error);
  EXPECT_THROW(ShippedPlan(pack("nothing")), std::runtime_error);
  const std::atomic<bool> now{true};
  EXPECT_THROW(shipped.trial(0, now), TrialGivenUp);
}

// Ranges that begin and end anywhere, across points, with whole blocks and without.
TEST(ShippedPlan, RangesGiveTheSameTable) {
  CampaignPlan plan = small_plan();
  plan.runs = 2 * kTrialBlock + 5;
  ShippedPlan shipped(ship(plan));
  const std::atomic<bool> never{false};
  std::vector<CampaignCell> here(2), there(2);
  ThreadCrew().run(plan, never, [&](std::int64_t index, const TrialResult& trial) {
    here[static_cast<std::size_t>(index / plan.runs)].add(trial);
  });
  std::int64_t index = 0;
  bool pooled = false;
  for (const std::int64_t count : std::vector<std::int64_t>{3, kTrialBlock - 3, kTrialBlock, 40, 2 * plan.runs}) {
    const std::int64_t left = std::min<std::int64_t>(count, 2 * plan.runs - index);
    bool more = false;
    for (const TrialResult& made : shipped.range(index, left, never, [](std::int64_t) {})) {
      const TrialResult trial = load_trial(save_trial(made));
      more = trial.more;
      pooled = pooled || more;
      there[static_cast<std::size_t>(index++ / plan.runs)].add(trial);
    }
    EXPECT_FALSE(more) << "a range ends with what is whole";
  }
  EXPECT_EQ(index, 2 * plan.runs);
  EXPECT_TRUE(pooled);
  for (std::size_t cell = 0; cell < 2; ++cell) {
    EXPECT_EQ(here[cell].result().dump(), there[cell].result().dump());
    EXPECT_EQ(here[cell].save(), there[cell].save());
  }
}

TEST(ShippedPlan, ATrialThatCannotBeRunFailsAsItDoesHere) {
  CampaignPlan plan = small_plan();
  plan.trace = std::make_shared<const Trace>(Trace::from_csv("k,t,sensor.nobody.range\n0,0,1\n1,1,1\n"));
  ShippedPlan shipped(ship(plan));
  const std::atomic<bool> never{false};
  EXPECT_EQ(save_trial(shipped.trial(4, never)), save_trial(plain_trial(plan, 4, never)));
}

TEST(Fingerprint, SaysWhatDiffers) {
  const Fingerprint& own = own_fingerprint();
  EXPECT_EQ(difference(own, own), std::nullopt);
  for (const char* part : {"version", "build", "processor", "libraries", "computation"}) {
    ASSERT_TRUE(own.at(part).is_string()) << part;
    EXPECT_FALSE(own.at(part).get<std::string>().empty()) << part;
    Fingerprint other = own;
    other[part] = "another";
    const auto sentence = difference(own, other);
    ASSERT_TRUE(sentence) << part;
    for (const std::string& word : {std::string(part), std::string("another"), own.at(part).get<std::string>()})
      EXPECT_NE(sentence->find(word), std::string::npos) << *sentence;
  }
  EXPECT_TRUE(difference(Json(), own));
}

}  // namespace
}  // namespace vigil::crew_test
