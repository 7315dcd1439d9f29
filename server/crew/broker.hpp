/// A message broker outside, behind an interface: the rest of the server knows neither its library nor its protocol.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "server/crew/crew.hpp"
#include "server/crew/fingerprint.hpp"

namespace vigil {

struct NatsOptions {
  std::string url;  ///< nats://HOST:PORT or tls://HOST:PORT, or several with commas between them
  /// None; a file of NATS credentials (user and key chained, or the two apart); or a JSON file with some of "user",
  /// "password", "token", "ca", "certificate", "key" (the last three: files).
  std::vector<std::string> credentials;
  std::string name = "vigil";  ///< what the broker calls the connection
  /// One sentence for people: the broker is gone, is there again, a worker refuses. From any thread.
  std::function<void(const std::string&)> say;
};

/// The broker will not have us, however often it is asked: one sentence.
class BrokerRefusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Broker {
 public:
  virtual ~Broker() = default;
  /// Safe from any thread, all of them; nothing waits for a broker that is gone.
  virtual bool connected() const = 0;
  /// Not kept for those who do not listen; false where it could not be sent.
  virtual bool publish(const std::string& subject, std::string_view data) = 0;
  /// The workers of a campaign. owner: tells campaigns of the same plan apart, the same again where one goes on; empty:
  /// like no other. Lives no longer than the broker.
  virtual std::unique_ptr<Crew> crew(const std::string& owner) = 0;
};

/// Connects and keeps connecting for ever; returns at once. Throws std::runtime_error with one sentence where the
/// options cannot be used, or this executable was built without NATS.
std::unique_ptr<Broker> connect_nats(const NatsOptions& options);

struct WorkerOptions {
  NatsOptions nats;
  int threads = 1;
  std::string name;
  Fingerprint fingerprint;                   ///< own_fingerprint(), but in tests
  std::chrono::milliseconds sleep{0};        ///< before each trial: what a slow one would take
  std::optional<std::int64_t> deadly_trial;  ///< that kills the process
};

/// Takes trials until `stop` becomes true. Throws as connect_nats(), and where the broker refuses it for good.
void run_nats_worker(const WorkerOptions& options, const std::atomic<bool>& stop);

}  // namespace vigil
