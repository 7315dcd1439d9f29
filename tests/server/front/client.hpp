/// A small blocking client: says exactly the bytes it is told to, and reads with a generous deadline instead of a
/// sleep.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace vigil::test {

struct Reply {
  int status = 0;                                   ///< 0: the connection ended before an answer
  std::multimap<std::string, std::string> headers;  ///< names in lower case
  std::string body;                                 ///< chunks joined
  bool whole = false;                               ///< the body ended as announced
  std::string header(const std::string& name) const;
};

struct Event {
  std::string name, data, id;
};

class Client {
 public:
  /// receive_buffer: bytes, 0: the system's.
  explicit Client(int port, int receive_buffer = 0);
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  Client(Client&& other) noexcept;

  /// False when the other side does not take it any more.
  bool send(std::string_view bytes);
  /// Reads one answer. head_only: to a HEAD request.
  Reply reply(bool head_only = false);
  Reply ask(std::string_view bytes) { return send(bytes) ? reply() : reply(); }
  /// The next event of a stream; its head is read first if it was not yet. Empty name: the stream ended.
  Event event();
  /// Events until one of that name (which is the last one returned).
  std::vector<Event> events_until(std::string_view name);
  /// Status of the stream's head.
  int stream_status();
  /// True if the other side closes within the deadline; what came before it is thrown away.
  bool closed();
  int socket() const { return socket_; }
  bool stream_whole() const { return stream_whole_; }

 private:
  bool more();  ///< reads once; false at the end or after 30 s
  bool read_head(Reply& reply);
  bool read_chunk(std::string& out);

  int socket_ = -1;
  std::string in_;
  std::string events_;
  int stream_status_ = -1;
  bool stream_whole_ = false;
};

/// "GET <path> HTTP/1.1", Host, the lines given (each with CR LF), a blank line.
std::string get(std::string_view path, std::string_view lines = "");
std::string post(std::string_view path, std::string_view body, std::string_view type = "application/json",
                 std::string_view lines = "");
/// Waits (30 s at most) until it is true.
bool eventually(const std::function<bool()>& condition);

}  // namespace vigil::test
