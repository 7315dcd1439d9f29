/// The hub: what runs publish, kept in bounded rings, read by any number of viewers. No HTTP and no socket in it.
///
/// A run's thread pays for one copy of the frame, whether nobody or a thousand watch; encoding and sending happen on
/// the thread that reads (the front's loop).
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/json.hpp"
#include "engine/run/frame.hpp"

namespace vigil {

struct HubOptions {
  std::size_t ring_bytes = 4u << 20;  ///< of encoded frames, each topic
  std::size_t ring_frames = 1024;     ///< raw frames kept for a run (bounded by ring_bytes too)
  std::size_t marks = 10'000;         ///< newest marks kept for a run
  std::size_t viewers = 2000;         ///< over this: busy
  double frames_per_second = 60;      ///< a faster run is thinned
  std::chrono::milliseconds ping{10'000};
  /// Monotonic time; tests pass their own.
  std::function<std::chrono::nanoseconds()> clock;
};

/// Topic name and the signal ids it carries, in order. The first is the default where a viewer names none.
struct HubTopic {
  std::string name;
  std::vector<int> signals;
};

class Feed;    // one run's items; see server/hub/feed.hpp
class Viewer;  // one reader's position; see server/hub/viewer.hpp

class Hub {
 public:
  explicit Hub(HubOptions options = {});
  ~Hub();
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;

  // Publishing: from any thread; the calls for one run from one thread at a time.

  /// Starts a run's stream. A run that is open already is closed first (state "interrupted").
  void open(std::int64_t run, const Catalogue& catalogue, std::vector<HubTopic> topics, double dt);
  /// Cost: a lock, a clock and one copy. Unknown runs are ignored, here and below.
  void frame(std::int64_t run, const Frame& frame);
  void mark(std::int64_t run, const Mark& mark);
  /// Viewers get what is left, `event: end` with that state, and the end of the stream; later ones 204.
  void close(std::int64_t run, std::string_view state);
  /// Forgets that the run was here (it was deleted): later viewers are the route's matter.
  void forget(std::int64_t run);
  /// Viewers of that run now (0 for unknown ones). Cheap: fit to be asked before every tick.
  std::size_t viewers(std::int64_t run) const;
  std::size_t viewers() const;                ///< of everything, the global feed included
  std::string epoch(std::int64_t run) const;  ///< "" for unknown ones
  /// The global feed: any event name (letters, digits, '_', '-') with JSON data.
  void publish(std::string_view event, const Json& data);

  /// For a run's thread that does not want the map's lock at every tick: valid until close(run).
  std::shared_ptr<Feed> feed(std::int64_t run) const;

  // Reading: all on one thread, the front's loop.

  enum class Attach { ok, ended, unknown_run, unknown_topic, busy };
  struct Attached {
    Attach result = Attach::unknown_run;
    std::shared_ptr<Viewer> viewer;  ///< only when ok
    std::string text;                ///< when busy: the bytes to send instead (chunked, with the final chunk)
  };
  /// last_event_id: of the header or the query, "" for none. `run` < 0: the global feed. Topic "": the first.
  Attached attach(std::int64_t run, std::string_view topic, std::string_view last_event_id);
  void detach(const std::shared_ptr<Viewer>& viewer);
  /// Called by any publisher when there is something to collect, once until the next collect(). Must be quick.
  void set_waker(std::function<void()> waker);
  /// Takes in what was published, and flushes thinned ticks that are due. Calls `ready` for every viewer that has
  /// something to send. Returns how long to sleep at most until it must be called again.
  std::chrono::nanoseconds collect(const std::function<void(Viewer&)>& ready);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vigil
