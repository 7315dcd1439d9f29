#include "engine/run/mrclam.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>
#include <vector>

#include "engine/core/input_error.hpp"
#include "engine/run/frame_csv.hpp"
#include "engine/world/plant.hpp"

namespace vigil {
namespace {

constexpr double kTurn = 6.283185307179586;
constexpr std::int64_t kMaxTicks = 10'000'000;

using Rows = std::vector<std::vector<double>>;

/// Numbers in columns, white space between them, lines with # left out.
Rows read_rows(std::string_view text, const char* file, std::size_t columns) {
  Rows rows;
  std::size_t line = 0;
  while (!text.empty()) {
    ++line;
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view rest = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    std::vector<double> row;
    while (true) {
      const std::size_t begin = rest.find_first_not_of(" \t\r");
      if (begin == std::string_view::npos || rest[begin] == '#') break;
      rest.remove_prefix(begin);
      double value = 0;
      const auto [stop, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
      if (error != std::errc() || !std::isfinite(value)) {
        throw InputError("/" + std::string(file),
                         fmt::format("line {} of {}: \"{}\" is not a number", line, file, rest.substr(0, 24)));
      }
      row.push_back(value);
      rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()));
    }
    if (row.empty()) continue;
    if (row.size() < columns) {
      throw InputError("/" + std::string(file),
                       fmt::format("line {} of {} has {} numbers; expected {}", line, file, row.size(), columns));
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty()) throw InputError("/" + std::string(file), fmt::format("{} has no rows", file));
  return rows;
}

void sort_by_time(Rows& rows) {
  std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a[0] < b[0]; });
}

/// Mean of column `column` over (from, to], each row holding until the next.
double held_mean(const Rows& rows, std::size_t& cursor, double from, double to, std::size_t column) {
  while (cursor + 1 < rows.size() && rows[cursor + 1][0] <= from) ++cursor;
  double sum = 0, at = from;
  for (std::size_t i = cursor; at < to; ++i) {
    const double until = i + 1 < rows.size() ? std::min(std::max(rows[i + 1][0], at), to) : to;
    sum += rows[i][column] * (until - at);
    at = until;
  }
  return sum / (to - from);
}

/// Pose at a time, linear between rows, the angle the short way round.
std::vector<double> pose_at(const Rows& rows, std::size_t& cursor, double time) {
  while (cursor + 2 < rows.size() && rows[cursor + 1][0] <= time) ++cursor;
  const auto& a = rows[cursor];
  const auto& b = rows[std::min(cursor + 1, rows.size() - 1)];
  const double share = b[0] > a[0] ? std::clamp((time - a[0]) / (b[0] - a[0]), 0.0, 1.0) : 0.0;
  return {a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2]), a[3] + share * wrap(b[3] - a[3], kTurn)};
}

/// Readings of one landmark at one tick: sums, to be averaged. Bearings are averaged around the first, not across the
/// seam.
struct Reading {
  double range = 0, bearing = 0, first = 0;
  int count = 0;
  void add(double r, double b) {
    if (count == 0) first = b;
    range += r;
    bearing += first + wrap(b - first, kTurn);
    ++count;
  }
};

using Sightings = std::map<std::int64_t, std::map<int, Reading>>;

Sightings gather(const Rows& measurement, const std::map<int, int>& subject_of,
                 const std::map<int, std::vector<double>>& landmarks, double begin, double dt, std::int64_t last) {
  Sightings readings;
  for (const auto& row : measurement) {
    const auto subject = subject_of.find(static_cast<int>(row[1]));
    if (subject == subject_of.end() || !landmarks.contains(subject->second)) continue;
    const auto tick = static_cast<std::int64_t>(std::llround((row[0] - begin) / dt));
    if (tick >= 1 && tick <= last) readings[tick][subject->second].add(row[2], row[3]);
  }
  return readings;
}

}  // namespace

std::string mrclam_to_csv(const MrclamFiles& files, double dt) {
  if (!(dt > 0) || !std::isfinite(dt))
    throw InputError("/dt", fmt::format("dt is {}; expected seconds above 0", dt), "> 0");
  std::map<int, int> subject_of;
  for (const auto& row : read_rows(files.barcodes, "Barcodes", 2))
    subject_of[static_cast<int>(row[1])] = static_cast<int>(row[0]);
  std::map<int, std::vector<double>> landmarks;
  for (const auto& row : read_rows(files.landmarks, "Landmark_Groundtruth", 3))
    landmarks[static_cast<int>(row[0])] = {row[1], row[2]};
  Rows truth = read_rows(files.groundtruth, "Groundtruth", 4), odometry = read_rows(files.odometry, "Odometry", 3);
  const Rows measurement = read_rows(files.measurement, "Measurement", 4);
  sort_by_time(truth);
  sort_by_time(odometry);
  const double begin = std::max(truth.front()[0], odometry.front()[0]);
  const double end = std::min(truth.back()[0], odometry.back()[0]);
  const double ticks = std::floor((end - begin) / dt + 1e-9);
  if (!(ticks >= 1)) throw InputError("/odometry", "odometry and truth do not overlap for one tick");
  if (ticks > static_cast<double>(kMaxTicks))
    throw InputError("/dt", fmt::format("dt is {} s: more than {} ticks", dt, kMaxTicks));
  const auto last = static_cast<std::int64_t>(ticks);
  const Sightings readings = gather(measurement, subject_of, landmarks, begin, dt, last);

  Catalogue catalogue;
  for (const char* name : {"truth.x", "truth.y", "truth.theta", "input.v", "input.omega"})
    catalogue.add({.name = name});
  for (const auto& [id, place] : landmarks) {
    for (const char* channel : {"range", "bearing"}) catalogue.add({.name = fmt::format("sensor.{}.{}", id, channel)});
  }
  for (const auto& [id, place] : landmarks) {
    for (const char* axis : {"x", "y"}) catalogue.add({.name = fmt::format("node.{}.position.{}", id, axis)});
  }
  std::string csv = csv_header(catalogue);
  Frame frame;
  std::size_t truth_cursor = 0, speed_cursor = 0, turn_cursor = 0;
  double heading = 0;
  for (std::int64_t k = 0; k <= last; ++k) {
    frame.k = k;
    frame.t = static_cast<double>(k) * dt;
    frame.values.assign(static_cast<std::size_t>(catalogue.size()), std::nan(""));
    const double now = begin + frame.t;
    const auto pose = pose_at(truth, truth_cursor, now);
    heading = k == 0 ? pose[2] : heading + wrap(pose[2] - heading, kTurn);  // unwrapped, as the state is
    frame.values[0] = pose[0];
    frame.values[1] = pose[1];
    frame.values[2] = heading;
    if (k > 0) {
      frame.values[3] = held_mean(odometry, speed_cursor, now - dt, now, 1);
      frame.values[4] = held_mean(odometry, turn_cursor, now - dt, now, 2);
    }
    std::size_t place = 5;
    const auto row = readings.find(k);
    for (const auto& [id, position] : landmarks) {
      if (row != readings.end()) {
        if (const auto found = row->second.find(id); found != row->second.end()) {
          frame.values[place] = found->second.range / found->second.count;
          frame.values[place + 1] = wrap(found->second.bearing / found->second.count, kTurn);
        }
      }
      place += 2;
    }
    for (const auto& [id, position] : landmarks) {
      if (k == 0) {
        frame.values[place] = position[0];
        frame.values[place + 1] = position[1];
      }
      place += 2;
    }
    append_csv_row(csv, frame);
  }
  return csv;
}

}  // namespace vigil
