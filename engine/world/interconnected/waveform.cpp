#include "engine/world/interconnected/waveform.hpp"

#include <fmt/format.h>

#include <cmath>

namespace vigil::observer {

Param pieces_param() {
  return {
      .name = "pieces",
      .type = ParamType::matrix,
      .required = true,
      .meaning = {"One row a piece, until, offset, slope, sine, cosine, rate, phase: offset + slope t + sine "
                  "sin(rate t + phase) + cosine cos(rate t + phase) up to and with t = until; the last goes on",
                  "每行一段：until、offset、slope、sine、cosine、rate、phase，即 offset + slope t + sine sin(rate t + "
                  "phase) + cosine cos(rate t + phase)，到 t = until（含）为止；最后一段一直持续"}};
}

Signal read_pieces(const Params& params) {
  const Json& table = params.values().at("pieces");
  const bool rows = table.is_array() && table.front().is_array();
  const Eigen::MatrixXd M = rows ? params.matrix("pieces") : Eigen::MatrixXd();
  if (M.cols() != kPieceColumns) {
    throw InputError("/pieces",
                     "pieces is no table of pieces; expected rows of 7 numbers: until, offset, slope, sine, cosine, "
                     "rate, phase",
                     "[[until,offset,slope,sine,cosine,rate,phase],…]");
  }
  std::vector<Piece> pieces;
  for (const auto& row : M.rowwise()) {
    if (!pieces.empty() && !(row[0] > pieces.back().until)) {
      throw InputError(
          fmt::format("/pieces/{}/0", pieces.size()),
          fmt::format("until is {} s, not after {} s, where the piece before it ends", row[0], pieces.back().until));
    }
    pieces.push_back({row[0], row[1], row[2], row[3], row[4], row[5], row[6]});
  }
  return Signal(std::move(pieces));
}

Json write_pieces(const Signal& signal, double horizon) {
  Json table = Json::array();
  for (const Piece& p : signal.pieces()) {
    const double until = std::isfinite(p.until) ? p.until : horizon;
    table.push_back(Json::array({until, p.offset, p.slope, p.sine, p.cosine, p.rate, p.phase}));
  }
  return table;
}

Signal read_signal(const Json& document, const std::string& pointer) {
  const auto* entry = Registry<SignalMake>::find(document.at("type").get<std::string>());
  if (entry == nullptr) throw InputError(pointer + "/type", "there is no such signal");
  try {
    return entry->make(Params(document.at("params")));
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) problem.pointer = pointer + "/params" + problem.pointer;
    throw InputError(std::move(problems));
  }
}

namespace {

const Registration<SignalMake> registration({
    "waveform",
    {"A signal in pieces", "分段信号"},
    "specification (observer), section 7",
    ParamTable({pieces_param()}),
    read_pieces,
});

}  // namespace
}  // namespace vigil::observer
