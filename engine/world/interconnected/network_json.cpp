/// A network of the user's own as a document.
#include <fmt/format.h>

#include <cmath>

#include "engine/core/describe.hpp"
#include "engine/scenario/fields.hpp"
#include "engine/world/interconnected/plant.hpp"

namespace vigil::observer {
namespace {

const std::vector<std::string> kShapes{"sine", "tanh", "sine_last", "none"};  // in the order of Nonlinearity
constexpr const char* kMatrix = "a matrix as rows [[..],..] of finite numbers";

struct Slot {
  const char* name;
  Eigen::MatrixXd Subsystem::*matrix;
  bool required;
};
constexpr Slot kMatrices[] = {{"A", &Subsystem::A, true},  {"B", &Subsystem::B, false},   {"C", &Subsystem::C, true},
                              {"D", &Subsystem::D, false}, {"Dd", &Subsystem::Dd, false}, {"F", &Subsystem::F, false},
                              {"G", &Subsystem::G, false}, {"E", &Subsystem::E, false}};

/// Nothing, and a problem, where it is no matrix. [] and null stand for none.
Eigen::MatrixXd read_matrix(const Json& given, const std::string& name, const std::string& pointer,
                            std::vector<Problem>& problems) {
  if (given.is_null() || (given.is_array() && given.empty())) return {};
  const bool rows = given.is_array() && given.front().is_array() && given.size() <= kMaxSize;
  const std::size_t columns = rows ? given.front().size() : 0;
  Eigen::MatrixXd M(static_cast<Eigen::Index>(rows ? given.size() : 0), static_cast<Eigen::Index>(columns));
  bool good = rows && columns <= kMaxSize;
  for (std::size_t r = 0; good && r < given.size(); ++r) {
    good = given[r].is_array() && given[r].size() == columns;
    for (std::size_t c = 0; good && c < columns; ++c) {
      const Json& entry = given[r][c];
      good = entry.is_number() && std::isfinite(entry.get<double>());
      if (good) M(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = entry.get<double>();
    }
  }
  if (good) return M;
  problems.push_back(
      {pointer, fmt::format("{} is {}; expected {}, at most {} x {}", name, shown(given), kMatrix, kMaxSize, kMaxSize),
       kMatrix});
  return {};
}

double number(Fields& fields, const char* key, double fallback) {
  if (!fields.has(key)) return fallback;
  const Json& given = fields.at(key);
  if (given.is_number() && std::isfinite(given.get<double>())) return given.get<double>();
  fields.wrong(key, "a finite number");
  return fallback;
}

Subsystem read_subsystem(const std::string& id, const Json& given, std::vector<Problem>& problems) {
  const std::string pointer = child("/subsystems", id);
  Subsystem s;
  s.name = id;
  s.kappa.reset();
  Fields fields(given, pointer, problems);
  fields.known({"A", "B", "C", "D", "Dd", "F", "G", "E", "alpha", "tau", "phi"});
  for (const Slot& slot : kMatrices) {
    if (fields.has(slot.name))
      s.*slot.matrix = read_matrix(fields.at(slot.name), slot.name, fields.pointer(slot.name), problems);
    else if (slot.required)
      fields.missing(slot.name, kMatrix);
  }
  s.alpha = number(fields, "alpha", 1);
  s.tau = number(fields, "tau", 0);
  const Json shape = fields.choice("phi", kShapes, "sine");
  for (std::size_t kind = 0; kind < kShapes.size(); ++kind) {
    if (shape == kShapes[kind]) s.phi = static_cast<Nonlinearity>(kind);
  }
  complete(s);
  return s;
}

void read_coupling(const std::string& key, const Json& given, Network& network, std::vector<Problem>& problems) {
  const std::string pointer = child("/couplings", key);
  const auto index = [&](const std::string& id) {
    for (int i = 0; i < network.count(); ++i) {
      if (network.subsystems[static_cast<std::size_t>(i)].name == id) return i;
    }
    return -1;
  };
  const auto dash = key.find('-');
  const int from = dash == std::string::npos ? -1 : index(key.substr(0, dash));
  const int to = dash == std::string::npos ? -1 : index(key.substr(dash + 1));
  if (from < 0 || to < 0 || from == to) {
    problems.push_back(
        {pointer, in_quotes(key) + " is no coupling; expected \"FROM-TO\", two subsystems of this plant", "FROM-TO"});
    return;
  }
  const Eigen::MatrixXd H = read_matrix(given, "H", pointer, problems);
  const int rows = network.subsystems[static_cast<std::size_t>(to)].n();
  const int columns = network.subsystems[static_cast<std::size_t>(from)].n();
  if (H.size() > 0 && (H.rows() != rows || H.cols() != columns)) {
    problems.push_back(
        {pointer,
         fmt::format("H of {} is {} x {}; expected {} x {}, the states of \"{}\" by those of "
                     "\"{}\"",
                     in_quotes(key), H.rows(), H.cols(), rows, columns, key.substr(dash + 1), key.substr(0, dash)),
         fmt::format("{} x {}", rows, columns)});
    return;
  }
  if (H.size() > 0) network.couplings.push_back({to, from, H});
}

Json rows_of(const Eigen::MatrixXd& M) {
  Json all = Json::array();
  for (const auto& row : M.rowwise()) {
    Json one = Json::array();
    for (const double value : row) one.push_back(value);
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace

Network read_network(const Json& subsystems, const Json& couplings) {
  std::vector<Problem> problems;
  Network network;
  if (subsystems.empty() || subsystems.size() > kMaxSize) {
    throw InputError("/subsystems", fmt::format("there are {} subsystems; expected 1 to {}, keyed by their nodes",
                                                subsystems.size(), kMaxSize));
  }
  for (const auto& [id, given] : subsystems.items()) network.subsystems.push_back(read_subsystem(id, given, problems));
  if (problems.empty()) {
    for (const auto& [key, given] : couplings.items()) read_coupling(key, given, network, problems);
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return network;
}

Json write_network(const Network& network) {
  Json subsystems = Json::object(), couplings = Json::object();
  for (const Subsystem& s : network.subsystems) {
    Json one = Json::object();
    for (const Slot& slot : kMatrices) {
      if ((s.*slot.matrix).size() > 0) one[slot.name] = rows_of(s.*slot.matrix);
    }
    one["alpha"] = s.alpha;
    one["tau"] = s.tau;
    one["phi"] = kShapes[static_cast<std::size_t>(s.phi)];
    subsystems[s.name] = std::move(one);
  }
  for (const Coupling& one : network.couplings) {
    const auto name = [&](int i) { return network.subsystems[static_cast<std::size_t>(i)].name; };
    couplings[name(one.from) + "-" + name(one.to)] = rows_of(one.H);
  }
  return {{"subsystems", std::move(subsystems)}, {"couplings", std::move(couplings)}};
}

}  // namespace vigil::observer
