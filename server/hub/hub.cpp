#include "server/hub/hub.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <shared_mutex>

#include "server/hub/viewer.hpp"

namespace vigil {
namespace {

constexpr std::int64_t kGlobal = -1;
constexpr std::size_t kEndedKept = 10'000;

/// Tells this life of a stream from all others, so that ids of an earlier one are not taken for its own.
std::string new_epoch() {
  static constexpr char kDigits[] = "0123456789abcdefghijklmnopqrstuvwxyz";
  std::random_device device;
  std::uint64_t bits = (std::uint64_t{device()} << 32) | device();
  std::string epoch = "e";
  for (int i = 0; i < 8; ++i, bits /= 36) epoch += kDigits[bits % 36];
  return epoch;
}

HubOptions with_defaults(HubOptions options) {
  if (!options.clock) {
    options.clock = [] {
      return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch());
    };
  }
  return options;
}

}  // namespace

struct Hub::State {
  explicit State(HubOptions given)
      : context{with_defaults(std::move(given)), std::make_shared<Alarm>()},
        global(std::make_shared<Feed>(context, kGlobal, new_epoch(), 0, std::vector<HubTopic>{{"global", {}}}, 0.0)) {}

  std::shared_ptr<Feed> find(std::int64_t run) const {
    const std::shared_lock lock(mutex);
    const auto found = open.find(run);
    return found == open.end() ? nullptr : found->second;
  }

  void remember_ended(std::int64_t run) {
    ended.insert(run);
    if (ended.size() > kEndedKept) ended.erase(ended.begin());
  }

  FeedContext context;
  std::shared_ptr<Feed> global;
  mutable std::shared_mutex mutex;
  std::map<std::int64_t, std::shared_ptr<Feed>> open;
  std::vector<std::shared_ptr<Feed>> closing;  ///< closed, with viewers that still read
  std::set<std::int64_t> ended;
  std::atomic<std::size_t> viewers{0};
  std::vector<std::shared_ptr<Feed>> scratch;  ///< of the reading thread
};

Hub::Hub(HubOptions options) : state_(std::make_unique<State>(std::move(options))) {}
Hub::~Hub() {
  // A viewer holds its feed and the feed its viewers: whoever was not detached is let go here.
  const auto release = [](Feed& feed) { feed.viewers.clear(); };
  release(*state_->global);
  for (const auto& [run, feed] : state_->open) release(*feed);
  for (const auto& feed : state_->closing) release(*feed);
  for (const auto& feed : state_->scratch) release(*feed);
}

void Hub::open(std::int64_t run, const Catalogue& catalogue, std::vector<HubTopic> topics, double dt) {
  close(run, "interrupted");
  auto feed = std::make_shared<Feed>(state_->context, run, new_epoch(), catalogue.size(), std::move(topics), dt);
  const std::unique_lock lock(state_->mutex);
  state_->ended.erase(run);
  state_->open[run] = std::move(feed);
}

void Hub::frame(std::int64_t run, const Frame& frame) {
  if (const auto feed = state_->find(run)) feed->frame(frame);
}

void Hub::mark(std::int64_t run, const Mark& mark) {
  if (const auto feed = state_->find(run)) feed->mark(mark);
}

void Hub::close(std::int64_t run, std::string_view state) {
  std::shared_ptr<Feed> feed;
  {
    const std::unique_lock lock(state_->mutex);
    const auto found = state_->open.find(run);
    if (found == state_->open.end()) return;
    feed = std::move(found->second);
    state_->open.erase(found);
    state_->closing.push_back(feed);
    state_->remember_ended(run);
  }
  feed->close(state);
}

void Hub::forget(std::int64_t run) {
  close(run, "deleted");
  const std::unique_lock lock(state_->mutex);
  state_->ended.erase(run);
}

std::size_t Hub::viewers(std::int64_t run) const {
  const auto feed = run < 0 ? state_->global : state_->find(run);
  return feed ? feed->viewer_count() : 0;
}

std::size_t Hub::viewers() const { return state_->viewers.load(std::memory_order_relaxed); }

std::string Hub::epoch(std::int64_t run) const {
  const auto feed = run < 0 ? state_->global : state_->find(run);
  return feed ? feed->epoch() : std::string();
}

void Hub::publish(std::string_view event, const Json& data) { state_->global->event(event, data); }

std::shared_ptr<Feed> Hub::feed(std::int64_t run) const { return state_->find(run); }

Hub::Attached Hub::attach(std::int64_t run, std::string_view topic, std::string_view last_event_id) {
  std::shared_ptr<Feed> feed = run < 0 ? state_->global : state_->find(run);
  if (!feed) {
    const std::shared_lock lock(state_->mutex);
    return {state_->ended.contains(run) ? Attach::ended : Attach::unknown_run, nullptr, {}};
  }
  const auto& topics = feed->topics();
  const auto named =
      std::find_if(topics.begin(), topics.end(), [&](const HubTopic& each) { return each.name == topic; });
  const bool known = run < 0 || (topic.empty() ? !topics.empty() : named != topics.end());
  if (!known) return {Attach::unknown_topic, nullptr, {}};
  if (viewers() >= state_->context.options.viewers) {
    const std::string data = dump(Json{{"limit", state_->context.options.viewers}});
    const std::string text = as_chunk("retry: 5000\nevent: busy\ndata: " + data + "\n\n");
    return {Attach::busy, nullptr, text + std::string(kLastChunk)};
  }
  const std::size_t index = named == topics.end() ? 0 : static_cast<std::size_t>(named - topics.begin());
  // Everybody starts at the newest tick there is, not at the newest one this thread happened to have taken in.
  feed->drain(state_->context.options.clock());
  auto viewer = std::make_shared<Viewer>(feed, index);
  viewer->begin(last_event_id);
  viewer->index = feed->viewers.size();
  feed->viewers.push_back(viewer);
  feed->viewers_changed();
  ++state_->viewers;
  return {Attach::ok, std::move(viewer), {}};
}

void Hub::detach(const std::shared_ptr<Viewer>& viewer) {
  auto& list = viewer->feed()->viewers;
  if (viewer->index >= list.size() || list[viewer->index] != viewer) return;
  list.back()->index = viewer->index;
  std::swap(list[viewer->index], list.back());
  list.pop_back();
  viewer->feed()->viewers_changed();
  --state_->viewers;
}

void Hub::set_waker(std::function<void()> waker) { state_->context.alarm->set(std::move(waker)); }

std::chrono::nanoseconds Hub::collect(const std::function<void(Viewer&)>& ready) {
  const HubOptions& options = state_->context.options;
  state_->context.alarm->reset();
  auto& feeds = state_->scratch;
  {
    const std::shared_lock lock(state_->mutex);
    feeds.assign(1, state_->global);
    for (const auto& [run, feed] : state_->open) feeds.push_back(feed);
    feeds.insert(feeds.end(), state_->closing.begin(), state_->closing.end());
  }
  const auto now = options.clock();
  auto sleep = std::chrono::nanoseconds(options.ping) / 4 + std::chrono::milliseconds(1);
  for (const auto& feed : feeds) {
    feed->drain(now);
    bool news = feed->take_news();
    // A thinned tick may be waiting: look again when it is due.
    if (news)
      sleep = std::min(sleep, std::chrono::nanoseconds(static_cast<std::int64_t>(1.1e9 / options.frames_per_second)));
    if (now >= feed->next_ping) {
      feed->next_ping = now + options.ping;
      const Packet packet = encode_event("ping", "{\"head\":" + std::to_string(feed->head_tick()) + "}");
      for (const auto& viewer : feed->viewers) viewer->ping(packet);
      news = true;
    }
    if (!news) continue;
    for (const auto& viewer : feed->viewers) ready(*viewer);
  }
  feeds.clear();
  const std::unique_lock lock(state_->mutex);
  std::erase_if(state_->closing, [](const auto& feed) { return feed->viewers.empty(); });
  return sleep;
}

}  // namespace vigil
