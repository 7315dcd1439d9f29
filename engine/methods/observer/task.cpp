/// A lane's gains as a task: what is solved, what comes back, what is accepted.
#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "engine/methods/observer/matched.hpp"
#include "engine/methods/observer/settings.hpp"

namespace vigil::observer {
namespace {

/// What is known of a task before anything is solved.
struct Prepared {
  Settings settings;
  std::optional<Synthesis> synthesis;  ///< nothing: no Riccati gains exist
};

const CertificationOptions kRiccatiBounds{.pmin = 1e-2, .pmax = 1e6};

Prepared prepare(const Settings& given) {
  Prepared made{given, std::nullopt};
  Settings& s = made.settings;
  if (s.source == Source::riccati) {
    const auto gains = riccati_gains(s.network, s.weights);
    if (!gains) return made;
    s.gains = *gains;
  }
  try {
    if (s.source == Source::design) {
      made.synthesis = theorem_1(s.system, s.options);
    } else {
      made.synthesis =
          certification(s.system, s.gains, s.source == Source::riccati ? kRiccatiBounds : CertificationOptions{});
    }
  } catch (const std::length_error& error) {
    throw InputError("/", std::string("the system is too large to design for: ") + error.what());
  }
  return made;
}

Json margins_of(const Synthesis& synthesis, const Certificate& certificate) {
  const auto names = block_names(synthesis);
  Json all = Json::array();
  const Json values = to_json(certificate)["margins"];
  for (std::size_t b = 0; b < values.size() && b < names.size(); ++b)
    all.push_back({{"block", names[b]}, {"value", values[b]}});
  return all;
}

Json record_of(const Prepared& made, const std::string& key, const DesignResult& result) {
  Json record = {{"key", key}, {"solver", result.solver}};
  record.update(to_json(result.certificate));
  record["margins"] = margins_of(*made.synthesis, result.certificate);
  record["verdict"] = to_string(result.solution.verdict);
  record["detail"] = result.solution.detail;
  record["iterations"] = result.solution.iterations;
  record["seconds"] = result.solution.seconds;
  const Json nothing(nullptr);
  if (result.design) {
    record.update(to_json(*result.design));
  } else {
    for (const char* missing : {"L", "P", "gamma_d", "gamma_w", "kappa", "lambda_max_sigma", "lambda_min_p"})
      record[missing] = nothing;
    if (made.settings.gains.empty()) {
      record["max_real_pole"] = nothing;
      record["fastest_pole"] = nothing;
    } else {
      record["L"] = to_json(Design{.L = made.settings.gains, .P = {}, .gamma_d = {}, .gamma_w = {}, .kappa = {}})["L"];
    }
  }
  if (made.settings.source != Source::design || !result.design) record["objective"] = nothing;
  record["matched"] = Json::array();
  for (const Subsystem& s : made.settings.network.subsystems) record["matched"].push_back(matching_condition(s));
  return record;
}

Json solve(const Prepared& made, const std::string& key, SdpSolver& solver, double limit) {
  if (!made.synthesis) {
    return {{"key", key},
            {"solver", "Riccati"},
            {"holds", false},
            {"reason", "a Riccati equation has no stabilising answer"},
            {"L", nullptr}};
  }
  const Settings& s = made.settings;
  if (s.source == Source::design) return record_of(made, key, synthesise(s.system, s.options, solver, limit));
  const auto bounds = s.source == Source::riccati ? kRiccatiBounds : CertificationOptions{};
  DesignResult result = certify_given(s.system, s.gains, bounds, solver, limit);
  if (s.source == Source::riccati) result.solver = "Riccati";
  return record_of(made, key, result);
}

Design read_record(Json record) {
  if (record.value("objective", Json(nullptr)).is_null()) record["objective"] = 0.0;
  return read_design(record, "");
}

void check(const Prepared& made, const std::string& key, const Json& record) {
  if (!record.is_object()) throw InputError("", "its gains have to be synthesised before it can run");
  if (record.value("key", "") != key) throw InputError("", "the gains on record are of another problem");
  const Settings& s = made.settings;
  const bool accepted_as_given = s.source == Source::printed || s.source == Source::given;
  if (accepted_as_given) return;
  const std::string reason = record.value("reason", "");
  if (!record.value("holds", false)) throw InputError("", "no certified gains: " + reason);
  const Design design = read_record(record);
  bool fits = design.L.size() == s.system.parts.size();
  for (std::size_t i = 0; fits && i < design.L.size(); ++i) {
    const ErrorPart& part = s.system.parts[i];
    fits = design.L[i].rows() == part.Abar.rows() && design.L[i].cols() == part.Cbar.rows();
  }
  if (!fits) throw InputError("", "the record has no gains of this network's sizes");
  const Certificate anew = certify(*made.synthesis, design, Eigen::VectorXd());
  if (!anew.holds) throw InputError("", "the certificate on record does not hold: " + anew.reason);
}

std::string key_of(const Prepared& made) {
  if (made.synthesis) return content_hash(made.synthesis->problem);
  SdpProblem none;  // of a Riccati equation without an answer: what it was asked with
  for (const Subsystem& s : made.settings.network.subsystems) none.cost.push_back(s.A.sum() + s.C.sum() + s.D.sum());
  return content_hash(none);
}

}  // namespace

DesignTask task_of(const Settings& settings) {
  const auto made = std::make_shared<const Prepared>(prepare(settings));
  DesignTask task;
  task.key = key_of(*made);
  const std::string key = task.key;
  task.solve = [made, key](SdpSolver& solver, double limit) { return solve(*made, key, solver, limit); };
  task.problem = [made] { return made->synthesis ? made->synthesis->problem : SdpProblem{}; };
  task.check = [made, key](const Json& record) { check(*made, key, record); };
  return task;
}

Gains accepted_gains(const Settings& settings, const Json& record) {
  task_of(settings).check(record);
  if (settings.source == Source::printed || settings.source == Source::given) return settings.gains;
  return read_record(record).L;
}

}  // namespace vigil::observer
