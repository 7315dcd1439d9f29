// The thread that steps a run: what is asked of it first, then rest or a tick.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <set>

#include "server/runs/live_run.hpp"

namespace vigil {
namespace {

using namespace std::chrono_literals;

constexpr auto kPublish = 250ms;  // between two statuses
constexpr auto kAnnounce = 1s;    // between two notes of progress in the global feed
constexpr auto kCatchUp = 250ms;  // time lost beyond this is not made up for
constexpr auto kUnwatched = 5s;   // of no viewer: the demo falls asleep
constexpr auto kLook = 100ms;     // a sleeping demo looks for viewers this often

WallTime wall_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

void LiveRun::main() {
  std::string state, error;
  try {
    begin();
    loop();
    const std::lock_guard lock(mutex_);
    if (stop_) state = stop_state_;
  } catch (const std::exception& failure) {
    state = "failed";
    error = failure.what();
    spdlog::error("run {} failed: {}", id_, failure.what());
  }
  if (state.empty() && run_.done() && every_lane_stopped()) {
    state = "failed";
    error = "Every lane was stopped by a numerical fault.";
  }
  finish(state.empty() ? order_.end_state : state, error);
  ended_.set_value();
  ended_call_(id_);
}

void LiveRun::begin() {
  if (stop_) return;
  started_at_ = wall_now();
  due_ = watched_ = rate_since_ = Clock::now();
  if (order_.fast_until >= 0) log_.set_policy(id_, LogPolicy::lossless);
  RunUpdate update;
  update.started = started_at_;
  log_.post(id_, update);
  enter(paused_ ? "paused" : "running");
}

void LiveRun::loop() {
  while (!over()) {
    if (pending_) serve();
    if (stop_) return;
    if (over() || rest()) continue;
    tick_once();
  }
}

bool LiveRun::over() const { return run_.done() || (order_.last && run_.tick() >= *order_.last); }

void LiveRun::serve() {
  for (;;) {
    std::packaged_task<void()> request;
    {
      const std::lock_guard lock(mutex_);
      if (requests_.empty()) {
        pending_ = false;
        break;
      }
      request = std::move(requests_.front());
      requests_.pop_front();
    }
    request();
  }
}

void LiveRun::settle() {
  const std::string state = paused_ ? "paused" : "running";
  if (state == state_) {
    publish(true);
  } else {
    enter(state);
  }
}

/// True when this round makes no tick.
bool LiveRun::rest() {
  if (paused_ && owed_ == 0) {
    sleep_until(Clock::now() + 1h);
    return true;
  }
  if (unwatched()) {
    sleep_until(Clock::now() + kLook);
    return true;
  }
  if (starving()) return true;
  if (!pace_.paced() || owed_ > 0 || run_.tick() < order_.fast_until) return false;
  const auto now = Clock::now();
  if (now < due_) {
    sleep_until(due_);
    return true;
  }
  if (now - due_ > kCatchUp) due_ = now;
  due_ += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / *pace_.ticks_per_second));
  return false;
}

bool LiveRun::unwatched() {
  if (!order_.sleeps_unwatched) return false;
  const auto now = Clock::now();
  if (hub_.viewers(id_) > 0) watched_ = now;
  const bool idle = now - watched_ > kUnwatched;
  if (idle != idle_) {
    idle_ = idle;
    due_ = now;
    publish(true);
  }
  return idle;
}

/// True where the next tick's row was not pushed yet; sleeps until it may be there.
bool LiveRun::starving() {
  if (!order_.feed) return false;
  if (order_.feed->trace()->rows() > run_.tick() + 1 || order_.feed->next()) return false;
  auto until = order_.feed->due().value_or(Clock::now() + 1h);
  if (shown_tick_ != run_.tick()) {
    if (Clock::now() - published_ >= kPublish) publish(true);
    until = std::min(until, published_ + kPublish);
  }
  due_ = Clock::now();
  sleep_until(until);
  return true;
}

void LiveRun::sleep_until(Clock::time_point time) {
  std::unique_lock lock(mutex_);
  wake_.wait_until(lock, time, [this] { return !requests_.empty() || stop_ || fed_; });
  fed_ = false;
}

void LiveRun::tick_once() {
  run_.step(sink_);
  tick_.store(run_.tick(), std::memory_order_relaxed);
  if (run_.tick() == order_.fast_until) log_.set_policy(id_, log_policy(order_.scenario.document(), pace_));
  if (owed_ > 0 && --owed_ == 0) {
    publish(true);
    if (stepped_) stepped_->set_value();
    stepped_.reset();
  }
  if (Clock::now() - published_ >= kPublish) publish(true);
}

void LiveRun::enter(const std::string& state) {
  state_ = state;
  RunUpdate update;
  update.state = state;
  log_.post(id_, update);
  Mark mark;
  mark.k = std::max<std::int64_t>(run_.tick(), 0);
  mark.type = MarkType::state;
  mark.code = state;
  sink_.mark(mark);
  announced_ = {};
  rate_since_ = Clock::now();
  rate_tick_ = run_.tick();
  publish(true);
}

std::shared_ptr<const RunStatus> LiveRun::snapshot(bool whole) const {
  auto status = std::make_shared<RunStatus>();
  if (!whole && status_) *status = *status_;
  status->state = state_;
  status->k = run_.tick();
  status->t = sink_.time();
  status->ticks_per_second = rate_;
  status->idle = idle_;
  status->pace = pace_;
  status->started = started_at_;
  if (whole) {
    status->metrics = run_.metrics();
    status->faults = run_.faults();
    status->warnings = run_.warnings();
    status->design = design_;
    status->world = world_;
  }
  return status;
}

void LiveRun::publish(bool whole) {
  measure_rate();
  const auto status = snapshot(whole);
  published_ = Clock::now();
  shown_tick_ = run_.tick();
  {
    const std::lock_guard lock(mutex_);
    status_ = status;
  }
  if (published_ - announced_ >= kAnnounce) announce(*status);
}

void LiveRun::measure_rate() {
  const auto now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - rate_since_).count();
  if (paused_ || idle_) rate_ = 0;
  if (seconds < 0.2 || paused_ || idle_) return;
  rate_ = static_cast<double>(run_.tick() - rate_tick_) / seconds;
  if (seconds < 1) return;
  rate_since_ = now;
  rate_tick_ = run_.tick();
}

void LiveRun::announce(const RunStatus& status) {
  announced_ = published_;
  Json note;
  note["id"] = std::to_string(id_);
  note["scenario"] = order_.scenario.id();
  note["state"] = status.state;
  note["k"] = status.k;
  note["t"] = status.t;
  note["steps"] = run_.steps() ? Json(*run_.steps()) : Json();
  note["ticks_per_second"] = status.ticks_per_second ? Json(*status.ticks_per_second) : Json();
  hub_.publish("run", note);
  if (announcer_ != nullptr) announcer_->state(id_, note, lanes_);
}

bool LiveRun::every_lane_stopped() const {
  std::set<std::string> stopped;
  for (const FaultCount& fault : run_.faults()) {
    if (fault.stopped) stopped.insert(fault.lane);
  }
  const Json& lanes = order_.scenario.document().at("lanes");
  return !lanes.empty() && stopped.size() == lanes.size();
}

void LiveRun::finish(std::string state, std::string error) {
  Mark mark;
  mark.k = std::max<std::int64_t>(run_.tick(), 0);
  mark.type = MarkType::state;
  mark.code = state;
  mark.detail = error;
  sink_.mark(mark);
  design_ = run_.design();  // a design may say where the run stands: the traces of covariances at its last tick
  auto last = std::make_shared<RunStatus>(*snapshot(true));
  last->state = state;
  last->error = error;
  last->ended = wall_now();
  RunUpdate update;
  update.state = state;
  update.ended = last->ended;
  update.error = error;
  update.metrics = last->metrics;
  update.faults = last->faults;
  update.warnings = last->warnings;
  update.design = last->design;
  update.world = last->world;
  try {
    log_.finish(id_, update);
  } catch (const LogError& failure) {
    spdlog::warn("run {}: {}", id_, failure.what());
  }
  std::deque<std::packaged_task<void()>> refused;
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    refused.swap(requests_);
    status_ = last;
  }
  hub_.close(id_, state);
  webhooks_.close(id_);
  published_ = Clock::now();
  announce(*last);
}

}  // namespace vigil
