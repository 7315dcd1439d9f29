/// Executables that stand in for Vigil where a solver must misbehave.
#pragma once

#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/server/api/fixture.hpp"

namespace vigil::api_test {

/// A shell script with that body. It is called with one argument, `solve-sdp`.
inline std::string script(const TemporaryFolder& folder, const std::string& name, const std::string& body) {
  const std::string path = folder.file(name);
  std::ofstream(path + ".new") << "#!/bin/sh\n" << body << "\n";
  std::filesystem::permissions(path + ".new", std::filesystem::perms::owner_all);
  std::filesystem::rename(path + ".new", path);
  return path;
}

/// Says who it is in a file and is silent for ever after.
inline std::string silent(const TemporaryFolder& folder) {
  return script(folder, "silent",
                "echo $$ > " + folder.file("pid.new") + "; mv " + folder.file("pid.new") + " " + folder.file("pid") +
                    "; exec sleep 1000");
}

/// Solves once the file `go` is there.
inline std::string gated(const TemporaryFolder& folder) {
  return script(folder, "gated",
                "while [ ! -e " + folder.file("go") + " ]; do sleep 0.02; done; exec " VIGIL_EXECUTABLE " \"$@\"");
}
inline void open_gate(const TemporaryFolder& folder) { std::ofstream(folder.file("go")) << "\n"; }

/// Of the silent one; waits until it has said so.
inline pid_t child_of(const TemporaryFolder& folder) {
  pid_t pid = 0;
  EXPECT_TRUE(eventually([&] { return static_cast<bool>(std::ifstream(folder.file("pid")) >> pid); }));
  return pid;
}

/// No such process, or nothing but its exit code is left of it.
inline bool gone(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  if (!std::getline(file, text)) return true;
  const auto end = text.rfind(')');
  return end == std::string::npos || text.compare(end, 3, ") Z") == 0 || text.compare(end, 3, ") X") == 0;
}

}  // namespace vigil::api_test
