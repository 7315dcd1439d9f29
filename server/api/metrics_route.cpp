// GET /metrics: the text format of Prometheus, version 0.0.4.
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

#include "engine/core/describe.hpp"
#include "engine/scenario/scenario.hpp"
#include "server/api/doc.hpp"
#include "server/api/guard.hpp"
#include "server/api/services.hpp"

namespace vigil {
namespace {

class MetricsText {
 public:
  void family(const char* name, const char* type, const char* help) {
    text_ += std::string("# HELP ") + name + " " + help + "\n# TYPE " + name + " " + type + "\n";
  }
  void sample(const std::string& name, double value) { text_ += name + " " + number_text(value) + "\n"; }
  void one(const char* name, const char* type, const char* help, double value) {
    family(name, type, help);
    sample(name, value);
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double whole = 0, resident = 0;
  file >> whole >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

void runs(MetricsText& text, const Services& services) {
  const RunManager::Counts counts = services.runs.counts();
  text.family("vigil_runs", "gauge", "Runs that are not over.");
  text.sample("vigil_runs{state=\"running\"}", counts.running);
  text.sample("vigil_runs{state=\"queued\"}", counts.queued);
  text.sample("vigil_runs{state=\"designing\"}", counts.designing);
  const LogCounts log = services.reader.counts();
  text.family("vigil_logged_runs", "gauge", "Runs in the log by state.");
  for (const auto& [state, count] : log.by_state) {
    text.sample("vigil_logged_runs{state=\"" + state + "\"}", static_cast<double>(count));
  }
  text.one("vigil_log_blocks", "gauge", "Sealed blocks in the log.", static_cast<double>(log.blocks));
}

void log(MetricsText& text, const Services& services) {
  const LogHealth health = services.log.health();
  text.one("vigil_log_bytes", "gauge", "Size of the log's file and its write-ahead log.",
           static_cast<double>(health.bytes));
  text.one("vigil_log_queue_bytes", "gauge", "Samples waiting for the disk.", static_cast<double>(health.queue_bytes));
  text.one("vigil_log_dropped_frames_total", "counter", "Frames dropped by a full queue.",
           static_cast<double>(health.dropped));
  text.one("vigil_log_healthy", "gauge", "1 while the log can be written.",
           health.state == LogHealth::State::ok ? 1 : 0);
}

void front(MetricsText& text, const Services& services) {
  const FrontStats stats = services.stats();
  text.one("vigil_http_requests_total", "counter", "Requests that reached a handler.",
           static_cast<double>(stats.requests));
  text.one("vigil_http_refused_total", "counter", "Requests refused at the door.", static_cast<double>(stats.refused));
  text.one("vigil_http_connections", "gauge", "Open connections.", static_cast<double>(stats.connections));
  text.one("vigil_http_queued", "gauge", "Requests waiting for a worker.", static_cast<double>(stats.queued));
  text.one("vigil_stream_viewers", "gauge", "Viewers of streams.", static_cast<double>(stats.viewers));
  text.one("vigil_stream_bytes_total", "counter", "Bytes sent to viewers.", static_cast<double>(stats.bytes_streamed));
}

void process(MetricsText& text, const Services& services) {
  text.one("process_cpu_seconds_total", "counter", "CPU time of the process.", cpu_seconds());
  text.one("process_resident_memory_bytes", "gauge", "Memory of the process.", resident_bytes());
  text.one("vigil_uptime_seconds", "gauge", "Since the server began.",
           std::chrono::duration<double>(std::chrono::steady_clock::now() - services.started).count());
  text.family("vigil_build_info", "gauge", "Always 1; the version is the label.");
  text.sample("vigil_build_info{version=\"" + std::string(version()) + "\"}", 1);
}

}  // namespace

void add_metrics_route(Routes& routes, Services& services) {
  routes.add(make_route(
      "GET", "/metrics",
      [&services](const auto&, auto& response) {
        MetricsText text;
        runs(text, services);
        log(text, services);
        front(text, services);
        process(text, services);
        response.text(text.take(), "text/plain; version=0.0.4; charset=utf-8");
      },
      "Figures for Prometheus",
      doc::Operation().answer(200, "Prometheus text.", doc::text_schema(), "text/plain").what()));
}

}  // namespace vigil
