/// Given signals of a document: a table of pieces. Specification (observer), sections 7 and 8.
#pragma once

#include "engine/core/params.hpp"
#include "engine/core/registry.hpp"
#include "engine/world/interconnected/signals.hpp"

namespace vigil::observer {

/// Columns of a table of pieces: until, offset, slope, sine, cosine, rate, phase.
inline constexpr int kPieceColumns = 7;

/// The declared parameter "pieces".
Param pieces_param();
/// Throws InputError at /pieces where the table has other columns or its times do not rise.
Signal read_pieces(const Params& params);
/// The table of a signal. A last piece without an end is written with the end `horizon`, s: it goes on all the same.
Json write_pieces(const Signal& signal, double horizon);

/// {"type","params"}, complete. Throws InputError under `pointer`.
Signal read_signal(const Json& document, const std::string& pointer);

using SignalMake = Signal (*)(const Params& params);

}  // namespace vigil::observer
