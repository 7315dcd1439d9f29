#include "server/campaigns/manager.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "server/campaigns/work.hpp"
#include "server/crew/threads.hpp"
#include "server/runs/designs.hpp"
#include "server/runs/manager.hpp"
#include "server/runs/refusal.hpp"
#include "server/synthesis/designer.hpp"

namespace vigil {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMostWaiting = 256;
constexpr int kNice = 5;                     // live runs and the page come first
constexpr auto kAnnounce = 1s;               // between two notes of progress in the global feed
constexpr std::size_t kMostRemembered = 64;  // campaigns whose workers are still told
constexpr auto kSolverLook = 50ms;
constexpr auto kTellAgain = 1s;  // to a log whose disk was full

/// Thrown where somebody wants the campaign to end before its first trial.
struct Ended {};

/// It wants workers and the server has no broker.
class NoWorkers : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace

CampaignManager::CampaignManager(LogWriter& log, const LogReader& reader, Hub& hub, RunManager& runs,
                                 WorkerSource workers)
    : log_(log), reader_(reader), hub_(hub), runs_(runs), source_(std::move(workers)), worker_([this] { work(); }) {}

CampaignManager::~CampaignManager() { stop(); }

void CampaignManager::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    current_.stop = true;
  }
  changed_.notify_all();
  if (worker_.joinable()) worker_.join();
}

void CampaignManager::take_up() {
  auto rows = reader_.campaigns();
  std::reverse(rows.begin(), rows.end());
  for (const CampaignRow& row : rows) {
    if (row.state != "interrupted") continue;
    log_.update_campaign(row.id, "queued");
    const std::lock_guard lock(mutex_);
    queue_.push_back(row.id);
  }
  changed_.notify_all();
}

CreatedCampaign CampaignManager::create(const CampaignRequest& request, const std::string& key,
                                        const std::string& hash) {
  {
    const std::lock_guard lock(mutex_);
    if (stopping_) throw RunRefusal(RunRefusal::Kind::full, "The server is stopping.");
    if (queue_.size() >= kMostWaiting)
      throw RunRefusal(RunRefusal::Kind::full, "Too many campaigns wait already; try again when some have ended.");
  }
  CampaignPlan plan = make_plan(request);
  RunOrder first;
  first.scenario = plan.points.front().scenario;
  first.seed = request.first_seed;
  if (request.trace) first.trace = runs_.trace(*request.trace);
  if (open_tasks(first).empty()) {
    Run run = make_run(first);
    prepare_trial(run);
  }
  NewCampaign campaign = new_campaign(request, plan);
  campaign.idempotency_key = key;
  campaign.idempotency_hash = hash;
  const CreatedCampaign created = log_.create_campaign(campaign);
  if (!created.fresh) return created;
  {
    const std::lock_guard lock(mutex_);
    queue_.push_back(created.id);
  }
  changed_.notify_all();
  announce(created.id, "queued");
  return created;
}

void CampaignManager::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    const auto asked = [this] { return stopping_ || !queue_.empty(); };
    if (unlogged_.empty()) {
      changed_.wait(lock, asked);
    } else if (!changed_.wait_for(lock, kTellAgain, asked)) {
      lock.unlock();
      tell_log();
      lock.lock();
      continue;
    }
    if (stopping_) break;
    current_.id = queue_.front();
    queue_.pop_front();
    current_.stop = false;
    current_.wanted.clear();
    current_.ended = false;
    current_.first = current_.done = current_.trials = current_.failed = 0;
    current_.begin = current_.told = Clock::now();
    const std::int64_t id = current_.id;
    lock.unlock();
    carry_out(id);
    lock.lock();
    current_.id = 0;
    changed_.notify_all();
  }
  for (const std::int64_t id : queue_) {
    lock.unlock();
    try {
      log_.update_campaign(id, "interrupted");
    } catch (const LogError& failure) {
      spdlog::warn("campaign {}: {}", id, failure.what());
    }
    lock.lock();
  }
}

void CampaignManager::carry_out(std::int64_t id) {
  std::string state, error;
  try {
    log_.update_campaign(id, "running");
    announce(id, "running");
    state = run(id);
  } catch (const Ended&) {
    state.clear();
  } catch (const NoWorkers& failure) {
    state = "paused";
    error = failure.what();
  } catch (const LogError& failure) {
    state = failure.kind() == LogError::Kind::disk ? "paused" : "failed";
    error = failure.what();
  } catch (const std::exception& failure) {
    state = "failed";
    error = failure.what();
  }
  if (!error.empty()) spdlog::error("campaign {}: {}", id, error);
  {
    const std::lock_guard lock(mutex_);
    if (state.empty()) state = current_.wanted.empty() ? "interrupted" : current_.wanted;
    unlogged_[id] = {state, error};
    current_.ended = true;
  }
  tell_log();
  announce(id, state);
}

/// "finished", or empty where it was ended from outside.
std::string CampaignManager::run(std::int64_t id) {
  const auto row = reader_.campaign(id);
  if (!row) throw Ended();
  const CampaignRequest request = CampaignRequest::from_json(row->request);
  CampaignWork work(log_, reader_, id, prepare(id, request), request.samples);
  {
    const std::lock_guard lock(mutex_);
    current_.first = current_.done = work.done();
    current_.trials = row->trials;
    current_.failed = row->failed;
    current_.begin = Clock::now();
  }
  const auto crew = hire(id, request);
  const auto show = [this](const Crew* now) {
    const std::lock_guard lock(mutex_);
    crew_ = now;
  };
  show(crew.get());
  bool whole = false;
  try {
    whole = work.run(*crew, current_.stop, [this](std::int64_t done, const TrialResult& trial) {
      progress(done, std::string_view(trial_state(trial)) != "finished");
    });
  } catch (...) {
    show(nullptr);
    throw;
  }
  show(nullptr);
  if (request.workers) {
    const std::lock_guard lock(mutex_);
    workers_[id] = crew->members();
    if (workers_.size() > kMostRemembered) workers_.erase(workers_.begin());
  }
  return whole ? "finished" : "";
}

std::unique_ptr<Crew> CampaignManager::hire(std::int64_t id, const CampaignRequest& request) const {
  if (!request.workers) return std::make_unique<ThreadCrew>();
  if (source_.broker == nullptr)
    throw NoWorkers("It wants workers, and this server has no broker: start it with --nats URL.");
  return source_.broker->crew(source_.owner + "#" + std::to_string(id));
}

std::vector<CrewMember> CampaignManager::workers(std::int64_t id) const {
  const std::lock_guard lock(mutex_);
  if (current_.id == id && crew_ != nullptr) return crew_->members();
  const auto known = workers_.find(id);
  return known == workers_.end() ? std::vector<CrewMember>() : known->second;
}

CampaignPlan CampaignManager::prepare(std::int64_t id, const CampaignRequest& request) {
  CampaignPlan plan = make_plan(request);
  plan.nice = kNice;
  plan.trace_id = request.trace;
  if (request.trace) {
    plan.trace = runs_.trace(*request.trace);
    if (!plan.trace) throw std::runtime_error("The trace " + std::to_string(*request.trace) + " was deleted.");
  }
  const auto cells = reader_.campaign_cells(id);
  if (cells.size() != plan.points.size()) throw std::runtime_error("Points of the campaign are missing in the log.");
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    CampaignPoint& point = plan.points[cell];
    point.designs = designs_of(point.scenario, cells[cell].designs);
    if (cells[cell].designs.is_null() && !point.designs.empty())
      log_.set_cell_designs(id, static_cast<std::int64_t>(cell), point.designs);
  }
  return plan;
}

Json CampaignManager::designs_of(const Scenario& scenario, Json known) {
  RunOrder order;
  order.scenario = scenario;
  if (known.is_object()) order.designs = std::move(known);
  Designer& designer = runs_.designer();
  for (const DesignTask& task : open_tasks(order)) {
    Json record = designer.known(task);
    if (record.is_null()) {
      designer.ask({task});
      std::optional<DesignItem> item;
      while (!(item = designer.find(task.key)) || !item->settled()) {
        std::unique_lock lock(mutex_);
        if (changed_.wait_for(lock, kSolverLook, [this] { return current_.stop.load(); })) throw Ended();
      }
      require_gains(task, *item);
      record = item->record;
    }
    order.designs[task.lane] = std::move(record);
  }
  return order.designs;
}

void CampaignManager::progress(std::int64_t done, bool failed) {
  {
    const std::lock_guard lock(mutex_);
    current_.done = done;
    current_.failed += failed ? 1 : 0;
    if (Clock::now() - current_.told < kAnnounce) return;
    current_.told = Clock::now();
  }
  announce(current_.id, "running");
}

CampaignSpeed CampaignManager::speed_of(const Current& current) const {
  CampaignSpeed speed;
  const double seconds = std::chrono::duration<double>(Clock::now() - current.begin).count();
  const auto made = static_cast<double>(current.done - current.first);
  if (made == 0 || seconds <= 0) return speed;
  speed.trials_per_second = made / seconds;
  speed.seconds_left = static_cast<double>(current.trials - current.done) / speed.trials_per_second;
  return speed;
}

std::optional<CampaignSpeed> CampaignManager::speed(std::int64_t id) const {
  const std::lock_guard lock(mutex_);
  return current_.id == id ? std::optional(speed_of(current_)) : std::nullopt;
}

void CampaignManager::announce(std::int64_t id, const std::string& state) {
  Json note{{"id", std::to_string(id)}, {"state", state}};
  {
    const std::lock_guard lock(mutex_);
    if (current_.id == id && current_.trials > 0) {
      const CampaignSpeed speed = speed_of(current_);
      note["done"] = current_.done;
      note["trials"] = current_.trials;
      note["failed"] = current_.failed;
      note["trials_per_second"] = speed.trials_per_second;
      note["seconds_left"] = speed.seconds_left ? Json(*speed.seconds_left) : Json();
    }
  }
  hub_.publish("campaign", note);
}

}  // namespace vigil
