// A worker: takes jobs of whatever campaign offers some, makes their trials, brings the results back.
#include <csignal>
#include <deque>
#include <map>
#include <random>
#include <thread>

#include "server/crew/job.hpp"
#include "server/nats/campaign_streams.hpp"
#include "server/nats/work_board.hpp"

namespace vigil {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::int64_t kFetch = 500;       // ms to wait for a job
constexpr std::int64_t kFetchOther = 50;   // the same where another campaign may have one
constexpr auto kTryAgain = 200ms;          // where the broker did not answer
constexpr auto kRenew = 1s;                // well below kAckWait
constexpr std::int64_t kStored = 5000;     // ms to wait until the broker has stored a result
constexpr std::size_t kMostStreams = 32;   // that a thread listens to
constexpr std::size_t kHeaders = 1 << 10;  // bytes of a message that are not ours

/// Jobs that are being worked on: the broker is told so again and again, else it gives them to somebody else.
class InHand {
 public:
  void hold(natsMsg* message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(message);
  }
  void release(natsMsg* message) {
    const std::lock_guard lock(mutex_);
    std::erase(messages_, message);
  }
  void renew() {
    const std::lock_guard lock(mutex_);
    for (natsMsg* message : messages_) natsMsg_InProgress(message, nullptr);
  }

 private:
  std::mutex mutex_;
  std::deque<natsMsg*> messages_;
};

/// One thread of a worker.
class Hand {
 public:
  Hand(const WorkerOptions& options, const NatsConnection& connection, WorkBoard& board, InHand& in_hand,
       const std::atomic<bool>& stop)
      : options_(options), connection_(connection), board_(board), in_hand_(in_hand), stop_(stop) {}

  void work() {
    std::string last;
    while (!stop_) {
      const WorkBoard::Offer offer = board_.pick(last);
      if (!offer.campaign) continue;
      last = offer.campaign->id;
      const auto plan = plan_of(*offer.campaign);  // first: a job in hand is not to wait for it
      if (!plan) continue;
      const NatsOwned<natsMsg> message = fetch(offer);
      if (message) carry_out(*offer.campaign, *plan, message.get());
    }
  }

 private:
  NatsOwned<natsMsg> fetch(const WorkBoard::Offer& offer);
  std::shared_ptr<ShippedPlan> plan_of(OfferedCampaign& campaign) const;
  void carry_out(OfferedCampaign& campaign, ShippedPlan& plan, natsMsg* message);
  JobResult make(OfferedCampaign& campaign, ShippedPlan& plan, const TrialJob& job);
  void pause_and_die(const OfferedCampaign& campaign, std::int64_t index) const;
  bool deliver(const OfferedCampaign& campaign, const JobResult& result);
  bool store(const OfferedCampaign& campaign, const std::string& piece, const std::string& name);

  const WorkerOptions& options_;
  const NatsConnection& connection_;
  WorkBoard& board_;
  InHand& in_hand_;
  const std::atomic<bool>& stop_;
  std::map<std::string, NatsOwned<natsSubscription>> jobs_;  ///< by key
  std::random_device device_;
};

NatsOwned<natsMsg> Hand::fetch(const WorkBoard::Offer& offer) {
  const std::string& id = offer.campaign->id;
  std::erase_if(jobs_, [&](const auto& one) { return one.first.starts_with(id) && one.first != offer.key; });
  if (jobs_.size() > kMostStreams) jobs_.clear();
  auto& jobs = jobs_[offer.key];
  natsStatus status = NATS_OK;
  if (!jobs && connection_.connected()) {
    const std::string stream = job_stream(offer.key), subject = job_subject(offer.key);
    jsSubOptions how;
    jsSubOptions_Init(&how);
    how.Stream = stream.c_str();
    how.Consumer = kWorkers;
    natsSubscription* raw = nullptr;
    status = js_PullSubscribe(&raw, connection_.streams(), subject.c_str(), kWorkers, nullptr, &how, nullptr);
    jobs.reset(raw);
  }
  natsMsgList list{};
  if (jobs) status = natsSubscription_Fetch(&list, jobs.get(), 1, offer.alone ? kFetch : kFetchOther, nullptr);
  if (jobs && status == NATS_OK && list.Count == 1) {
    NatsOwned<natsMsg> message(std::exchange(list.Msgs[0], nullptr));
    natsMsgList_Destroy(&list);
    return message;
  }
  if (status != NATS_TIMEOUT || !jobs) {
    std::erase_if(jobs_, [&](const auto& one) { return one.first == offer.key || !one.second; });
    std::this_thread::sleep_for(kTryAgain);
  }
  return nullptr;
}

std::shared_ptr<ShippedPlan> Hand::plan_of(OfferedCampaign& campaign) const {
  std::shared_ptr<ShippedPlan> plan;
  try {
    plan = campaign.plan(connection_);
  } catch (const std::exception& failure) {
    connection_.say("the plan of campaign " + campaign.id + " is not to be used: " + failure.what());
  }
  if (!plan) std::this_thread::sleep_for(kTryAgain);
  return plan;
}

void Hand::carry_out(OfferedCampaign& campaign, ShippedPlan& plan, natsMsg* message) {
  in_hand_.hold(message);
  bool stored = false;
  try {
    const TrialJob job = job_from_bytes(text_of(message));
    stored = deliver(campaign, make(campaign, plan, job));
  } catch (const TrialGivenUp&) {
  } catch (const std::exception& failure) {
    connection_.say(std::string("a job cannot be understood: ") + failure.what());
  }
  in_hand_.release(message);
  if (stored) {
    natsMsg_Ack(message, nullptr);
  } else {
    natsMsg_NakWithDelay(message, std::chrono::milliseconds(kTryAgain).count(), nullptr);
  }
}

void Hand::pause_and_die(const OfferedCampaign& campaign, std::int64_t index) const {
  const auto until = Clock::now() + options_.sleep;
  while (Clock::now() < until && !campaign.over) std::this_thread::sleep_for(std::min(10ms, options_.sleep));
  if (options_.deadly_trial == index) std::raise(SIGKILL);
}

JobResult Hand::make(OfferedCampaign& campaign, ShippedPlan& plan, const TrialJob& job) {
  JobResult result;
  result.job = job;
  const auto begin = Clock::now();
  try {
    const auto before = [&](std::int64_t index) { pause_and_die(campaign, index); };
    for (const TrialResult& trial : plan.range(job.first, job.count, campaign.over, before))
      result.trials.push_back(save_trial(trial));
  } catch (const std::exception& failure) {
    result.trials.clear();
    result.error = failure.what();
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return result;
}

bool Hand::deliver(const OfferedCampaign& campaign, const JobResult& result) {
  const std::uint64_t nonce = std::uint64_t{device_()} << 32U | device_();
  const std::size_t room = std::max(connection_.room(), 2 * kHeaders) - kHeaders;
  int part = 0;
  for (const std::string& piece : pieces_of(result, nonce, room)) {
    const std::string name = std::to_string(nonce) + "-" + std::to_string(part++);
    if (!store(campaign, piece, name)) return false;
  }
  return true;
}

/// Until the broker has it: what was worked for is not thrown away because a broker restarts.
bool Hand::store(const OfferedCampaign& campaign, const std::string& piece, const std::string& name) {
  while (!campaign.over) {
    const std::string key = board_.key_of(campaign.id);
    if (key.empty()) return false;
    const std::string subject = result_subject(key);
    jsPubOptions how;
    jsPubOptions_Init(&how);
    how.MsgId = name.c_str();
    how.MaxWait = kStored;
    const auto size = static_cast<int>(piece.size());
    if (connection_.connected() &&
        js_Publish(nullptr, connection_.streams(), subject.c_str(), piece.data(), size, &how, nullptr) == NATS_OK)
      return true;
    std::this_thread::sleep_for(kTryAgain);
  }
  return false;
}

}  // namespace

void run_nats_worker(const WorkerOptions& options, const std::atomic<bool>& stop) {
  const NatsConnection connection(options.nats);
  WorkBoard board(connection, {options.name, options.threads, std::nullopt}, options.fingerprint);
  InHand in_hand;
  std::atomic<bool> ending{false};
  std::vector<std::thread> threads;
  for (int i = 0; i < options.threads; ++i)
    threads.emplace_back([&] { Hand(options, connection, board, in_hand, ending).work(); });
  auto renewed = Clock::now();
  while (!stop && connection.refusal().empty()) {
    board.tick();
    if (Clock::now() - renewed >= kRenew) {
      renewed = Clock::now();
      in_hand.renew();
    }
    std::this_thread::sleep_for(kNoticeEvery / 2);
  }
  ending = true;
  board.close();
  for (std::thread& thread : threads) thread.join();
  if (const std::string why = connection.refusal(); !why.empty() && !stop) throw BrokerRefusal(why);
}

}  // namespace vigil
