#include "server/nats/nats_crew.hpp"

#include <random>
#include <stdexcept>
#include <thread>

#include "db/records.hpp"
#include "server/crew/ledger.hpp"
#include "server/crew/shipped_plan.hpp"
#include "server/nats/campaign_streams.hpp"
#include "server/nats/campaign_voice.hpp"

namespace vigil {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kFetch = 50ms;
constexpr auto kStalled = 2s;   // without a result: time to look what has become of the jobs
constexpr auto kNobody = 5s;    // without a worker: time to say so
constexpr auto kTryAgain = 1s;  // where the broker did not answer

std::string random_words() {
  std::random_device device;
  return std::to_string(device()) + "-" + std::to_string(device());
}

/// One campaign from its first job to its last result.
class Course {
 public:
  Course(const NatsConnection& connection, Muster& muster, const CampaignPlan& plan, const std::string& owner)
      : Course(connection, muster, plan, owner, ship(plan)) {}

  void run(const std::atomic<bool>& stop, const Crew::Take& take) {
    while (!ledger_.done() && !stop) {
      if (const std::string why = connection_.refusal(); !why.empty()) throw BrokerRefusal(why);
      look_after();
      publish();
      collect();
      merge(stop, take);
    }
  }

 private:
  Course(const NatsConnection& connection, Muster& muster, const CampaignPlan& plan, const std::string& owner,
         std::string shipped)
      : connection_(connection),
        muster_(muster),
        plan_(plan),
        id_(sha256_hex(shipped + owner).substr(0, 16)),
        ledger_(plan.first, plan.trials(), plan.runs),
        streams_(connection, id_),
        plan_bytes_(shipped.size()),
        voice_(connection, muster, notice(), std::move(shipped)) {}

  CampaignNotice notice() const {
    CampaignNotice one;
    one.id = id_;
    one.what = plan_.points.front().scenario.id() + ", " + std::to_string(plan_.trials()) + " trials";
    one.fingerprint = own_fingerprint();
    one.plan_bytes = plan_bytes_;
    return one;
  }

  void merge(const std::atomic<bool>& stop, const Crew::Take& take);
  void look_after();
  void make_streams();
  void give_up(const TrialJob& job);
  void publish();
  void collect();

  const NatsConnection& connection_;
  Muster& muster_;
  const CampaignPlan& plan_;
  const std::string id_;
  TrialLedger ledger_;
  JobAssembler assembler_;
  CampaignStreams streams_;
  const std::size_t plan_bytes_;
  CampaignVoice voice_;
  std::uint64_t times_ = 0;  ///< of the connection at the last look
  Clock::time_point begun_ = Clock::now(), heard_ = Clock::now(), looked_{};
  bool made_ = false, idle_ = false, said_ = false;
};

/// What is there; a block to its end.
void Course::merge(const std::atomic<bool>& stop, const Crew::Take& take) {
  bool more = false;
  while (!stop || more) {
    const auto next = ledger_.take();
    if (!next) return;
    const TrialResult trial = load_trial(next->second);
    more = trial.more;
    take(next->first, trial);
  }
}

void Course::make_streams() {
  made_ = streams_.make();
  if (!made_) return;
  voice_.set_key(streams_.key());
  ledger_.again();
  idle_ = false;
  heard_ = Clock::now();
}

/// The broker may have come back, with or without what it had stored; jobs and results may be lost, or handed out as
/// often as may be.
void Course::look_after() {
  const auto now = Clock::now();
  if (!connection_.connected()) return;
  const bool anew = connection_.times() != times_;
  const bool stalled = now - heard_ > kStalled;
  if (!said_ && now - begun_ > kNobody && muster_.empty()) {
    said_ = true;
    connection_.say("no worker takes part yet; start some with: vigil worker --nats URL");
  }
  if (now - looked_ < kTryAgain || !(anew || stalled || !made_)) return;
  looked_ = now;
  if (!made_) return make_streams();
  const CampaignStreams::Health health = streams_.health();
  if (health != CampaignStreams::Health::unknown) times_ = connection_.times();
  const bool idle = health == CampaignStreams::Health::idle && ledger_.under_way() > 0;
  if (health == CampaignStreams::Health::lost) make_streams();
  if (health == CampaignStreams::Health::exhausted) {
    for (const TrialJob& job : streams_.take_exhausted()) give_up(job);
  }
  if (idle && idle_) ledger_.again();  // twice in a row: nothing is on its way between two looks
  idle_ = idle && !idle_;
}

void Course::give_up(const TrialJob& job) {
  if (!ledger_.exhausted(job)) return;
  const std::string why = "It was handed to workers " + std::to_string(kMostDeliveries) +
                          " times, alone, and none of them lived to bring it back.";
  ledger_.put({{job.first, 1, job.attempt}, 0, "", {save_trial(failed_trial(plan_, job.first, why))}});
}

void Course::publish() {
  if (!made_ || !connection_.connected()) return;
  std::vector<TrialJob> jobs;
  const int threads = muster_.threads();
  while (const auto job = ledger_.next(threads)) jobs.push_back(*job);
  if (!streams_.publish(jobs)) looked_ = {};
}

void Course::collect() {
  if (!made_ || !connection_.connected()) return std::this_thread::sleep_for(kFetch);
  JobResult result;
  for (const std::string& piece : streams_.collect(kFetch)) {
    bool whole = false;
    try {
      whole = assembler_.put(piece, result);
    } catch (const std::runtime_error&) {
      continue;  // its job comes back as one that is lost
    }
    heard_ = Clock::now();
    idle_ = false;
    if (whole) ledger_.put(std::move(result));
  }
  assembler_.forget_before(ledger_.merged());
}

}  // namespace

NatsCrew::NatsCrew(std::shared_ptr<const NatsConnection> connection, std::string owner)
    : connection_(std::move(connection)), owner_(owner.empty() ? random_words() : std::move(owner)) {}

void NatsCrew::run(const CampaignPlan& plan, const std::atomic<bool>& stop, const Take& take) {
  if (plan.first >= plan.trials()) return;
  Course(*connection_, muster_, plan, owner_).run(stop, take);
}

std::vector<CrewMember> NatsCrew::members() const { return muster_.members(); }

}  // namespace vigil
