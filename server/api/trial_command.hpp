/// The line for a shell that repeats a trial.
#pragma once

#include <cstdint>
#include <string>

#include "engine/scenario/scenario.hpp"

namespace vigil {

/// `vigil run` of a scenario as it is with one seed: what differs from the preset of its name by --set, or where --set
/// does not reach by a patch on standard input; the whole document there where it is no preset's. trace_file: the file
/// of its trace, empty: none.
std::string run_command(const Scenario& scenario, std::uint64_t seed, const std::string& trace_file);
/// A word for a POSIX shell: as it is where nothing in it is special, else in single quotes.
std::string shell_word(const std::string& text);

}  // namespace vigil
