#include "server/crew/fingerprint.hpp"

#include <gnu/libc-version.h>

#include <Eigen/Core>
#include <sstream>

#include "db/records.hpp"
#include "engine/core/json.hpp"
#include "engine/run/campaign.hpp"
#include "server/runs/order.hpp"

namespace vigil {
namespace {

/// Trials short enough that nobody waits for them; between them every room of the engine computes something.
std::string computation() {
  std::string bytes;
  for (const char* preset : {"consensus", "replay-nongaussian", "privacy-turn", "sparse"})
    bytes += save_trial(run_trial(Scenario::preset(preset).with("time.steps", 4), 1));
  return sha256_hex(bytes).substr(0, 16);
}

Fingerprint make() {
  Fingerprint print;
  print["version"] = std::string(version());
  std::ostringstream build;
  build << VIGIL_BUILD << ", Eigen " << EIGEN_WORLD_VERSION << "." << EIGEN_MAJOR_VERSION << "." << EIGEN_MINOR_VERSION
        << " in " << EIGEN_MAX_ALIGN_BYTES << " bytes";
  print["build"] = build.str();
  print["processor"] = cpu_features();
  print["libraries"] = std::string("glibc ") + gnu_get_libc_version();
  print["computation"] = computation();
  return print;
}

}  // namespace

const Fingerprint& own_fingerprint() {
  static const Fingerprint print = make();
  return print;
}

namespace {

/// Longer than in_quotes, since builds may differ at their ends only; not without end, since somebody else said it.
std::string whole(const std::string& text) {
  return Json(text.substr(0, 400)).dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::optional<std::string> difference(const Fingerprint& theirs, const Fingerprint& mine) {
  for (const char* part : {"version", "build", "processor", "libraries", "computation"}) {
    const std::string here = mine.is_object() ? mine.value(part, "") : "";
    const std::string there = theirs.is_object() ? theirs.value(part, "") : "";
    if (here != there)
      return std::string("its ").append(part) + " is " + whole(here) + ", the campaign's is " + whole(there);
  }
  return std::nullopt;
}

}  // namespace vigil
