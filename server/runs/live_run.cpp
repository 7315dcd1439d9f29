// What other threads ask of a run. The thread itself is in run_thread.cpp.
#include "server/runs/live_run.hpp"

#include <utility>

namespace vigil {
namespace {

constexpr auto kPatience =
    std::chrono::seconds(10);  // more than the log's own, so that its reason is the one that is told

RunRefusal is_over() { return {RunRefusal::Kind::state, "The run is over: it can no longer be changed."}; }

}  // namespace

LiveRun::LiveRun(RunId id, RunOrder order, Run run, LogWriter& log, Hub& hub, Webhooks& webhooks, Announcer* announcer,
                 std::function<void(RunId)> ended)
    : id_(id),
      order_(std::move(order)),
      log_(log),
      hub_(hub),
      webhooks_(webhooks),
      announcer_(announcer),
      ended_call_(std::move(ended)),
      run_(std::move(run)),
      sink_(id, log, hub, webhooks, announcer),
      pace_(order_.pace),
      over_(ended_.get_future().share()) {
  const Json& document = order_.scenario.document();
  for (const auto& [lane, value] : document.at("lanes").items()) lanes_.push_back(lane);
  design_ = run_.design();
  world_ = run_.world();
  log_.set_signals(id_, run_.catalogue(), log_selection(document, run_.catalogue()), log_policy(document, pace_),
                   run_.dt());
  hub_.open(id_, run_.catalogue(), hub_topics(run_.catalogue(), document), run_.dt());
  if (order_.webhook) webhooks_.open(id_, *order_.webhook);
  status_ = snapshot(true);
}

LiveRun::~LiveRun() {
  stop("stopped");
  join();
}

void LiveRun::start() {
  const std::lock_guard lock(mutex_);
  if (started_ || closed_) return;
  started_ = true;
  thread_ = std::thread([this] { main(); });
}

std::shared_ptr<const RunStatus> LiveRun::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void LiveRun::inside(std::function<void()> work) {
  // A request that was given up on must not be carried out later, behind the asker's back.
  const auto claimed = std::make_shared<std::atomic<bool>>(false);
  std::packaged_task<void()> task([this, work = std::move(work), claimed] {
    if (claimed->exchange(true)) return;
    work();
    // Published before the asker goes on, so that what he reads next is what he asked for.
    if (started_) settle();
  });
  std::future<void> done = task.get_future();
  {
    std::unique_lock lock(mutex_);
    if (closed_) throw is_over();
    requests_.push_back(std::move(task));
    pending_ = true;
    if (!started_) {
      // Nobody steps a queued run: the asker does the work itself, and start() waits for the lock.
      std::packaged_task<void()> own = std::move(requests_.back());
      requests_.pop_back();
      own();
      status_ = snapshot(true);
    }
  }
  wake_.notify_all();
  if (done.wait_for(kPatience) != std::future_status::ready && !claimed->exchange(true)) {
    throw RunRefusal(RunRefusal::Kind::busy, "The run did not answer in time; try again.");
  }
  try {
    done.get();
  } catch (const std::future_error&) {
    throw is_over();
  }
}

Command LiveRun::command(const Json& body) {
  Command command;
  inside([this, &body, &command] {
    command = run_.prepare(body);
    log_.command(id_, command);
    run_.apply(command);
    world_ = run_.world();
  });
  return command;
}

void LiveRun::set_pace(Pace pace) {
  inside([this, pace] {
    pace_ = pace;
    due_ = Clock::now();
    log_.set_policy(id_, log_policy(order_.scenario.document(), pace_));
    RunUpdate update;
    update.pace = pace_.to_json();
    log_.post(id_, update);
  });
}

void LiveRun::pause() {
  inside([this] { paused_ = true; });
}

void LiveRun::resume() {
  inside([this] {
    paused_ = false;
    due_ = Clock::now();
  });
}

void LiveRun::step(std::int64_t ticks) {
  std::shared_future<void> made;
  inside([this, ticks, &made] {
    if (!paused_ || !started_)
      throw RunRefusal(RunRefusal::Kind::state, "Only a paused run can be stepped; pause it first.");
    owed_ += ticks;
    stepped_ = std::make_shared<std::promise<void>>();
    made = stepped_->get_future().share();
  });
  made.wait_for(std::chrono::seconds(2));
}

void LiveRun::stop(const std::string& state) {
  {
    const std::lock_guard lock(mutex_);
    if (!stop_) stop_state_ = state;
    stop_ = true;
  }
  start();  // a queued run ends by the same road
  wake_.notify_all();
}

bool LiveRun::wait_ended(std::chrono::milliseconds patience) const {
  return over_.wait_for(patience) == std::future_status::ready;
}

void LiveRun::wake() {
  {
    const std::lock_guard lock(mutex_);
    fed_ = true;
  }
  wake_.notify_all();
}

void LiveRun::join() {
  if (thread_.joinable()) thread_.join();
}

}  // namespace vigil
