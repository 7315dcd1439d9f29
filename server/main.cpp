#include "server/cli/cli.hpp"

int main(int argc, char** argv) { return vigil::run_command_line(argc, argv); }
