#include "server/api/sample_csv.hpp"

#include <string>

#include "engine/run/frame_csv.hpp"

namespace vigil {

bool write_csv(const LogReader& reader, RunId run, const std::vector<Signal>& catalogue, const std::vector<int>& picked,
               std::int64_t from, std::int64_t to, const BodyWriter& write) {
  constexpr std::size_t part = 64 << 10;
  Catalogue columns;
  for (const int id : picked) columns.add(catalogue[static_cast<std::size_t>(id)]);
  std::string text = csv_header(columns);
  Frame frame;
  bool open = true;
  reader.rows(run, picked, from, to, [&](std::int64_t k, double t, std::span<const double> values) {
    frame.k = k;
    frame.t = t;
    frame.values.assign(values.begin(), values.end());
    append_csv_row(text, frame);
    if (text.size() < part) return true;
    open = write(text);
    text.clear();
    return open;
  });
  return open && (text.empty() || write(text));
}

}  // namespace vigil
