/// The command line: `vigil serve|run|campaign|synthesize|scenarios|methods|trace|db`.
#pragma once

namespace vigil {

/// Exit code: 0 done, 1 internal error, 2 bad input (one sentence on standard error), 3 a lane was stopped by a
/// numerical fault, or got no certified gains.
int run_command_line(int argc, char** argv);

}  // namespace vigil
