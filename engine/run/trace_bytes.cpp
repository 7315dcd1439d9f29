/// A trace as bytes: what a campaign ships to processes elsewhere.
#include <stdexcept>

#include "engine/core/bytes.hpp"
#include "engine/run/trace.hpp"

namespace vigil {

std::string Trace::save() const {
  if (grows_) throw std::logic_error("A trace that grows cannot be saved.");
  ByteWriter out;
  out.integer(first_tick_);
  out.integer(rows_);
  out.number(dt_);
  out.word(columns_.size());
  for (const std::string& column : columns_) out.text(column);
  for (const double cell : cells_) out.number(cell);
  return out.take();
}

Trace Trace::load(std::string_view bytes) {
  ByteReader in(bytes);
  Trace trace;
  trace.first_tick_ = in.integer();
  trace.rows_ = in.integer();
  trace.dt_ = in.number();
  for (std::size_t left = in.count(8); left > 0; --left) {
    const std::string& column = trace.columns_.emplace_back(in.text());
    trace.index_.emplace(column, static_cast<int>(trace.columns_.size()) - 1);
  }
  const std::size_t columns = trace.columns_.size();
  const auto most = static_cast<std::int64_t>(bytes.size());
  if (trace.rows_ < 0 || trace.rows_ > most || trace.index_.size() != columns)
    throw std::runtime_error("A saved trace is damaged.");
  const std::size_t cells = static_cast<std::size_t>(trace.rows_) * columns;
  if (cells > bytes.size() / 8) throw std::runtime_error("A saved trace is cut off.");
  for (std::size_t cell = 0; cell < cells; ++cell) trace.cells_.push_back(in.number());
  if (!in.done()) throw std::runtime_error("A saved trace has something left over.");
  return trace;
}

}  // namespace vigil
