/// A front with a hub and a few routes to knock at.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>

#include "server/front/front.hpp"
#include "server/hub/hub.hpp"

namespace vigil::test {

/// A gate that handlers wait at until the test opens it.
class Gate {
 public:
  void open();
  void pass();  ///< waits
  int waiting() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool open_ = false;
  int waiting_ = 0;
};

struct ServerOptions {
  FrontOptions front;
  HubOptions hub;
  StaticFiles files;
};

class Server {
 public:
  explicit Server(ServerOptions options = {});
  ~Server();
  int port() const { return front->port(); }

  Gate gate;
  Hub hub;
  std::unique_ptr<Front> front;
};

/// A catalogue of `count` signals called s0, s1, …
Catalogue catalogue_of(int count);
/// A frame with values k + 0.5 · i.
Frame frame_of(std::int64_t k, int count);
/// One topic "overview" of all signals.
std::vector<HubTopic> overview_of(int count);

}  // namespace vigil::test
