#include "engine/run/system_report.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "engine/core/params.hpp"
#include "engine/linalg/small.hpp"
#include "engine/run/system_fits.hpp"
#include "engine/run/system_judge.hpp"
#include "engine/run/system_model.hpp"
#include "engine/run/system_words.hpp"

namespace vigil {
namespace {

using Eigen::MatrixXd;

const char* kind_name(ModelKind kind) {
  const char* names[] = {"discrete", "sampled", "continuous", "linearised"};
  return names[static_cast<int>(kind)];
}

Json rows_of(const MatrixXd& M) {
  if (M.rows() > kMaxSmall || !M.allFinite()) return nullptr;
  Json rows = Json::array();
  for (const auto& row : M.rowwise()) {
    rows.push_back(Json::array());
    for (const double value : row) rows.back().push_back(value);
  }
  return rows;
}

Json names_of(const std::vector<Component>& components) {
  Json names = Json::array();
  for (const Component& component : components) names.push_back(component.name);
  return names;
}

class Report {
 public:
  explicit Report(const Scenario& scenario)
      : scenario_(scenario), system_(system_model(scenario)), judge_(system_.model.A, system_.time()) {}

  Json make() {
    report_ = {{"scenario", scenario_.id()}, {"tolerance", kVisibilityTolerance}, {"plant", plant()}};
    report_["nodes"] = Json::array();
    const Json together = joint();
    for (std::size_t i = 0; i < system_.nodes.size(); ++i) report_["nodes"].push_back(node(i, together));
    if (system_.nodes.size() > 1)
      say(together["observable"] == true ? "good" : (together["detectable"] == false ? "bad" : "note"), "joint",
          nullptr, together["verdict"]);
    report_["joint"] = together;
    report_["control"] = control();
    report_["controller"] = controller();
    report_["noise"] = noise();
    report_["graph"] = graph();
    report_["methods"] = method_fits(scenario_);
    report_["run"] = run();
    report_["verdicts"] = verdicts_;
    return std::move(report_);
  }

 private:
  void say(const char* level, const char* topic, const Json& node, const std::string& text) {
    verdicts_.push_back({{"level", level}, {"topic", topic}, {"node", node}, {"text", text}});
  }

  Json plant() {
    const Plant& plant = *system_.plant;
    const bool flows = system_.kind == ModelKind::continuous;
    Json part{{"type", scenario_.document()["plant"]["type"]},
              {"kind", kind_name(system_.kind)},
              {"dt", scenario_.document()["time"]["dt"]},
              {"states", names_of(plant.state())},
              {"inputs", names_of(plant.input())},
              {"A", rows_of(system_.model.A)},
              {"B", rows_of(system_.model.B)},
              {"poles", nullptr},
              {"continuous_poles", nullptr},
              {"measure", flows ? "real part" : "modulus"},
              {"largest", nullptr},
              {"stable", nullptr},
              {"verdict", judge_.untested()}};
    if (system_.kind == ModelKind::linearised)
      say("note", "plant", nullptr,
          "the plant is not linear: what follows holds of its linearisation at the initial truth");
    if (flows)
      say("note", "plant", nullptr, "what follows holds of the subsystems' linear part, their couplings included");
    if (judge_.modes()) {
      const TimeKind time = system_.time();
      part["poles"] = modes_json(judge_.modes()->all(), *judge_.modes(), time);
      part["largest"] = size_of(judge_.modes()->all().front(), time);
      part["stable"] = judge_.modes()->stable();
      part["verdict"] = plant_verdict();
    }
    if (system_.given_A) {
      if (const auto given = Modes::of(*system_.given_A, TimeKind::continuous))
        part["continuous_poles"] = modes_json(given->all(), *given, TimeKind::continuous);
    }
    say(part["stable"] == true ? "good" : "note", "plant", nullptr, part["verdict"]);
    return part;
  }

  std::string plant_verdict() const {
    const Mode& slowest = judge_.modes()->all().front();
    const std::string size = fmt::format("{:.6g}", size_of(slowest, system_.time()));
    const std::string measure = system_.time() == TimeKind::continuous ? "the real part" : "the modulus";
    if (judge_.modes()->stable())
      return fmt::format("the plant is stable: its slowest mode {} has {} {}", mode_text(slowest), measure, size);
    std::vector<Mode> lasting = judge_.modes()->all();
    std::erase_if(lasting, [this](const Mode& mode) { return judge_.modes()->fate(mode) == Fate::decays; });
    return fmt::format("the plant is not stable: it has {}", modes_text(lasting, *judge_.modes()));
  }

  Json joint() const {
    const Question all{"all nodes together", "see", "do not see", ": no lane can follow the plant there"};
    return judge_.observes(all, stacked(system_.C, static_cast<int>(system_.model.A.rows())));
  }

  Json node(std::size_t i, const Json& together) {
    const std::string id = system_.nodes[i];
    const bool linear = system_.sensors[i]->linear();
    const Question own{"node " + id, "sees", "does not see", ": its own readings alone cannot follow the plant"};
    Json part{{"id", id}, {"channels", names_of(system_.sensors[i]->channels())}, {"linear", linear}};
    part.update(judge_.observes(own, system_.C[i]));
    const bool lost = part["detectable"] == false;
    const std::string at = linear || system_.kind == ModelKind::linearised ? "" : ", linearised at the initial truth";
    say(part["observable"] == true ? "good" : (lost && together["detectable"] == false ? "warning" : "note"), "node",
        id, part["verdict"].get<std::string>() + at);
    if (lost && i == 0 && system_.controller)
      say("warning", "controller", id,
          fmt::format(
              "node {} drives the plant by its estimate, and what it does not see alone it must hear from others", id));
    return part;
  }

  Json control() {
    if (system_.plant->inputs() == 0) return nullptr;
    const bool one = system_.plant->inputs() == 1;
    const Question inputs{one ? "the input" : "the inputs", one ? "moves" : "move",
                          one ? "does not move" : "do not move", ": no feedback stabilises the plant"};
    Json part = judge_.moves(inputs, system_.model.B);
    say(part["controllable"] == true ? "good" : (system_.controller ? "warning" : "note"), "control", nullptr,
        part["verdict"]);
    return part;
  }

  Json controller() {
    if (!system_.controller) return nullptr;
    const std::vector<std::string> warnings = system_.controller->warnings();
    const Json design = system_.controller->design();
    for (const std::string& warning : warnings) say("warning", "controller", nullptr, warning);
    if (warnings.empty())
      say("good", "controller", nullptr,
          fmt::format("the closed loop is stable: its spectral radius is {:.6g}",
                      design.at("spectral_radius").get<double>()));
    return {{"type", scenario_.document()["controller"]["type"]}, {"design", design}, {"warnings", warnings}};
  }

  static Json definiteness(const MatrixXd& M) {
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<MatrixXd>(M, Eigen::EigenvaluesOnly).eigenvalues();
    const double least = values[0], most = values[values.size() - 1];
    const bool definite = least > 1e-12 * most;
    return {{"size", M.rows()},
            {"smallest", std::isfinite(least) ? Json(least) : Json(nullptr)},
            {"largest", std::isfinite(most) ? Json(most) : Json(nullptr)},
            {"kind", most == 0 ? "zero" : (definite ? "positive definite" : "positive semidefinite")}};
  }

  Json noise() {
    const Json& given = scenario_.document()["noise"];
    const int n = system_.plant->states();
    Json part{{"Q", definiteness(square_matrix(given["Q"], n, "/noise/Q"))},
              {"P0", definiteness(square_matrix(given["P0"], n, "/noise/P0"))},
              {"R", Json::object()}};
    std::string text =
        fmt::format("Q is {}, P0 {}", part["Q"]["kind"].get<std::string>(), part["P0"]["kind"].get<std::string>());
    bool exact = false;
    for (std::size_t i = 0; i < system_.nodes.size(); ++i) {
      part["R"][system_.nodes[i]] = definiteness(system_.sensors[i]->noise());
      exact = exact || part["R"][system_.nodes[i]]["kind"] != "positive definite";
    }
    say("note", "noise", nullptr, text + (exact ? ", a sensor's R is singular" : ", every R positive definite"));
    return part;
  }

  Json graph();
  Json run();

  const Scenario& scenario_;
  SystemModel system_;
  ModeJudge judge_;
  Json report_;
  Json verdicts_ = Json::array();
};

/// Node indices of each part, in document order.
std::vector<std::vector<std::size_t>> components(const Graph& graph) {
  const auto count = static_cast<std::size_t>(graph.nodes());
  if (graph.centre() >= 0) {
    std::vector<std::size_t> all(count);
    for (std::size_t i = 0; i < count; ++i) all[i] = i;
    return {all};
  }
  std::vector<std::size_t> part(count);
  for (std::size_t i = 0; i < count; ++i) part[i] = i;
  for (std::size_t round = 0; round < count; ++round) {
    for (const Link& link : graph.links()) {
      auto &one = part[static_cast<std::size_t>(link.from)], &other = part[static_cast<std::size_t>(link.to)];
      one = other = std::min(one, other);
    }
  }
  std::vector<std::vector<std::size_t>> list(count);
  for (std::size_t i = 0; i < count; ++i) list[part[i]].push_back(i);
  std::erase_if(list, [](const auto& nodes) { return nodes.empty(); });
  return list;
}

Json Report::graph() {
  const Graph& graph = system_.graph;
  const auto parts = components(graph);
  Json part{{"name", scenario_.document()["network"]["graph"]},
            {"connected", parts.size() == 1},
            {"degrees", Json::object()},
            {"components", Json::array()}};
  for (std::size_t i = 0; i < system_.nodes.size(); ++i)
    part["degrees"][system_.nodes[i]] = graph.centre() >= 0 ? 1 : graph.degree(static_cast<int>(i));
  std::string blind;
  for (const auto& nodes : parts) {
    std::vector<std::string> names;
    std::vector<MatrixXd> C;
    for (const std::size_t i : nodes) {
      names.push_back(system_.nodes[i]);
      C.push_back(system_.C[i]);
    }
    const bool single = names.size() == 1;
    const Question question{single ? "node " + names.front() : fmt::format("nodes {}", fmt::join(names, ", ")),
                            single ? "sees" : "see", single ? "does not see" : "together do not see", ""};
    const Json own = judge_.observes(question, stacked(C, static_cast<int>(system_.model.A.rows())));
    part["components"].push_back({{"nodes", names}, {"detectable", own["detectable"]}, {"hidden", own["hidden"]}});
    if (own["detectable"] == false) blind += "; " + own["verdict"].get<std::string>();
  }
  const bool none = graph.links().empty() && system_.nodes.size() > 1;
  const bool alone = system_.nodes.size() == 1;
  std::string verdict = alone  ? "there is one node"
                        : none ? "no node hears of another"
                               : (parts.size() == 1 ? "the network is connected"
                                                    : fmt::format("the network falls into {} parts", parts.size()));
  if (parts.size() > 1) verdict += blind;
  part["verdict"] = verdict;
  const bool harmful = parts.size() > 1 && (!none || !blind.empty());
  say(parts.size() == 1 ? "good" : (harmful ? "warning" : "note"), "graph", nullptr, verdict);
  return part;
}

Json Report::run() {
  Json part = run_fit(scenario_);
  if (part["starts"] == true) {
    say("good", "run", nullptr, "a run of this scenario starts");
    for (const Json& warning : part["warnings"]) say("warning", "run", nullptr, warning);
  } else {
    say("bad", "run", nullptr, "a run is refused: " + part["reason"].get<std::string>());
  }
  return part;
}

}  // namespace

Json system_report(const Scenario& scenario) { return Report(scenario).make(); }

}  // namespace vigil
