#include "server/ingest/recorded_rows.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "engine/run/frame_csv.hpp"
#include "server/ingest/ingest_feed.hpp"
#include "server/runs/refusal.hpp"

namespace vigil {
namespace {

constexpr std::int64_t kMostCells = 20'000'000;

[[noreturn]] void refuse(const std::string& why) {
  throw RunRefusal(RunRefusal::Kind::state,
                   "The rows that were pushed into this run cannot be taken from its log: " + why);
}

/// A column and where the log has it: what came in is `sent` where an attack changed it on its way, unless the pushed
/// rows themselves say what an attack did.
struct Source {
  int signal = -1;
  int sent = -1;
};

/// Sensors of which the pushed rows tell the attack: their readings came in as received.
std::unordered_set<std::string> described(const PushedColumns& columns) {
  std::unordered_set<std::string> sensors;
  for (std::size_t c = 0; c < columns.names.size(); ++c) {
    const std::string& name = columns.names[c];
    const bool tells = name.ends_with(".state") || name.ends_with(".injected") || name.ends_with(".source");
    if (columns.reporter[c] >= 0 && tells) sensors.insert(columns.nodes[static_cast<std::size_t>(columns.reporter[c])]);
  }
  return sensors;
}

class Picker {
 public:
  Picker(const LogReader& reader, const RunRow& run, const PushedColumns& columns) : columns_(columns) {
    const std::vector<int> logged = reader.logged_signals(run.id);
    const std::unordered_set<int> kept(logged.begin(), logged.end());
    for (const Signal& signal : reader.signals(run.id)) {
      if (kept.contains(signal.id)) ids_.emplace(signal.name, signal.id);
    }
    const auto sensors = described(columns);
    for (std::size_t c = 0; c < columns.names.size(); ++c) {
      const int node = columns.reporter[c];
      Source source{place(columns.names[c]), -1};
      if (node >= 0 && !sensors.contains(columns.nodes[static_cast<std::size_t>(node)]))
        source.sent = place(columns.names[c] + ".sent");
      sources_.push_back(source);
    }
  }

  const std::vector<int>& signals() const { return signals_; }

  void pick(std::span<const double> values, std::vector<double>& cells) const {
    for (std::size_t c = 0; c < sources_.size(); ++c) {
      cells[c] = values[static_cast<std::size_t>(sources_[c].signal)];
      if (sources_[c].sent < 0) continue;
      const double sent = values[static_cast<std::size_t>(sources_[c].sent)];
      if (std::isfinite(sent)) cells[c] = sent;
    }
  }

 private:
  int place(const std::string& name) {
    const auto id = ids_.find(name);
    if (id == ids_.end()) refuse("it does not keep " + name + " (log.signals of the document).");
    signals_.push_back(id->second);
    return static_cast<int>(signals_.size()) - 1;
  }

  const PushedColumns& columns_;
  std::unordered_map<std::string, int> ids_;
  std::vector<int> signals_;
  std::vector<Source> sources_;
};

}  // namespace

bool was_pushed(const RunRow& run) { return is_ingest(run.input); }

std::string recorded_rows(const LogReader& reader, const RunRow& run) {
  const PushedColumns columns = pushed_columns(Scenario::from_json(run.document), read_ingest(run.input).further);
  if (run.k < 0) refuse("there is no tick yet.");
  if ((run.k + 1) * static_cast<std::int64_t>(columns.names.size()) > kMostCells)
    refuse("they have more than 20 million cells.");
  const Picker picker(reader, run, columns);
  Catalogue header;
  for (const std::string& name : columns.names) header.add({.name = name});
  std::string text = csv_header(header);
  Frame frame;
  frame.values.resize(columns.names.size());
  std::int64_t expected = 0;
  reader.rows(run.id, picker.signals(), 0, run.k, [&](std::int64_t k, double t, std::span<const double> values) {
    if (k != expected++) return false;
    frame.k = k;
    frame.t = t;
    picker.pick(values, frame.values);
    append_csv_row(text, frame);
    return true;
  });
  if (expected != run.k + 1) refuse("it has not kept every tick (log.every, log.keep and log.policy of the document).");
  return text;
}

}  // namespace vigil
