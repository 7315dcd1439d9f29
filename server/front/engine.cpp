#include "server/front/engine.hpp"

#include <spdlog/spdlog.h>

#include "server/front/gzip.hpp"
#include "server/front/reply.hpp"
#include "server/front/reply_stream.hpp"

namespace vigil {
namespace {

constexpr std::size_t kWorthPacking = 1400;  // one network packet: smaller bodies gain nothing

/// cpp-httplib's handlers get no context of ours; the request being run on this thread is it.
struct Current {
  const Job* job = nullptr;
  ReplyStream* stream = nullptr;
};
thread_local Current current;

/// The library gets only what it needs to write the answer: the rest was read, checked and parsed by the front.
std::string head_for_library(const Job& job) {
  const std::string method = job.head_only ? "HEAD" : job.request.method;
  return method + " / HTTP/1.1\r\nHost: vigil\r\n" + (job.keep_alive ? "" : "Connection: close\r\n") + "\r\n";
}

void set_problem(HttpResponse& response, int status, const std::string& detail,
                 const std::vector<Problem>& errors = {}) {
  response = HttpResponse();
  response.json(problem_json(status, detail, errors), status);
  response.content_type = "application/problem+json";
}

bool has_header(const HttpResponse& response, std::string_view name) {
  for (const auto& each : response.headers) {
    if (each.first == name) return true;
  }
  return false;
}

bool is_text(std::string_view type) {
  return type.starts_with("application/json") || type.starts_with("application/problem+json") ||
         type.starts_with("text/");
}

void pack(const HttpRequest& request, HttpResponse& response) {
  if (response.body.size() < kWorthPacking || !is_text(response.content_type)) return;
  if (has_header(response, "Content-Encoding") || has_header(response, "ETag")) return;
  response.set_header("Vary", "Accept-Encoding");
  if (!accepts_gzip(request.header("accept-encoding"))) return;
  std::string packed = gzip(response.body, 1);
  if (packed.empty()) return;
  response.body = std::move(packed);
  response.set_header("Content-Encoding", "gzip");
}

/// The library writes "Content-Length: 0" under a 204, where the standard forbids it.
void mend_empty(std::string& bytes) {
  static constexpr std::string_view kField = "Content-Length: 0\r\n";
  if (!bytes.starts_with("HTTP/1.1 204")) return;
  const auto at = bytes.find(kField);
  if (at != std::string::npos) bytes.erase(at, kField.size());
}

}  // namespace

Engine::Engine(const Routes& routes, const StaticFiles& files, BulkLimits limits)
    : routes_(routes), files_(files), limits_(limits), slots_(limits.slots) {
  svr_sock_ = 0;  // never used; the library takes "no listening socket" for shutting down and writes no streamed body
  set_keep_alive_max_count(1000);
  set_keep_alive_timeout(30);
  set_pre_routing_handler([this](const httplib::Request&, httplib::Response& response) {
    answer(*current.job, response);
    return HandlerResponse::Handled;
  });
}

Done Engine::run(Job& job) {
  Done done{job.connection, {}, job.keep_alive, false};
  ReplyStream stream(head_for_library(job), job.request.remote,
                     {job.socket, limits_.buffer, limits_.stalled, &slots_, &aborted_});
  current = {&job, &stream};
  bool closed = false;
  bool good = false;
  try {
    good = process_request(stream, !job.keep_alive, closed, nullptr);
  } catch (const std::exception& error) {
    spdlog::error("request {}: {}", job.request.id, error.what());
  }
  current = {};
  if (stream.no_slot()) {
    done.bytes = raw_problem(503, "Too many long answers are being read at once: try again in a moment.",
                             {{"Retry-After", "2"}, {"X-Request-Id", job.request.id}}, job.keep_alive);
    return done;
  }
  done.failed = !good && stream.spilled();
  done.bytes = stream.take();
  mend_empty(done.bytes);
  if (!good) done.keep_alive = false;
  return done;
}

void Engine::fill(const Job& job, HttpResponse& response) {
  try {
    if (job.route) {
      job.route->handler(job.request, response);
    } else {
      files_.serve(job.request, response);
    }
  } catch (const HttpError& error) {
    set_problem(response, error.status(), error.what(), error.errors());
    for (const auto& [name, value] : error.headers()) response.set_header(name, value);
  } catch (const InputError& error) {
    set_problem(response, 422, error.what(), error.problems());
  } catch (const std::exception& error) {
    spdlog::error("request {} {} {}: {}", job.request.id, job.request.method, job.request.path, error.what());
    set_problem(response, 500,
                "Something went wrong in the server; its log tells more under request " + job.request.id + ".");
  } catch (...) {
    spdlog::error("request {} {} {}: an unknown exception", job.request.id, job.request.method, job.request.path);
    set_problem(response, 500,
                "Something went wrong in the server; its log tells more under request " + job.request.id + ".");
  }
}

void Engine::answer(const Job& job, httplib::Response& out) {
  HttpResponse response;
  fill(job, response);
  pack(job.request, response);
  out.status = response.status;
  for (const auto& [name, value] : security_headers()) out.set_header(name, value);
  if (!has_header(response, "Cache-Control")) out.set_header("Cache-Control", "no-store");
  out.set_header("X-Request-Id", job.request.id);
  for (const auto& [name, value] : response.headers) out.set_header(name, value);
  if (!response.stream) {
    if (!response.content_type.empty()) out.set_header("Content-Type", response.content_type);
    out.body = std::move(response.body);
    return;
  }
  ReplyStream* const stream = current.stream;
  out.set_chunked_content_provider(response.content_type, [write = std::move(response.stream), stream,
                                                           id = job.request.id](std::size_t, httplib::DataSink& sink) {
    stream->allow_spill();
    try {
      if (!write([&](std::string_view part) { return part.empty() || sink.write(part.data(), part.size()); }))
        return false;
    } catch (const std::exception& error) {
      spdlog::error("request {}: the body was cut: {}", id, error.what());
      return false;
    }
    sink.done();
    return true;
  });
}

}  // namespace vigil
