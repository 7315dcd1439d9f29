/// Parts of seed 001's items.
#pragma once

#include <string>
#include <vector>

#include "engine/papers/item.hpp"

namespace vigil::papers {

/// The five algorithms of the source, A1 to A5, by their lanes.
inline const std::vector<std::string> kAlgorithms{"omp_game", "l1", "dkf", "etpg", "sdlms"};

/// Runs of an algorithm: those of A2 and A4, which solve a program for each window, at most 40.
std::int64_t sparse_runs(const Laboratory& laboratory, const std::string& lane);

/// Figures 3 to 6.
std::vector<Item> sparse_figures();

}  // namespace vigil::papers
