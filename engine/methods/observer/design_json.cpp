/// Designs and certificates as documents: what is stored with a run and what the page shows.
#include <cmath>

#include "engine/core/input_error.hpp"
#include "engine/methods/observer/certificate.hpp"

namespace vigil::observer {
namespace {

using Matrix = Eigen::MatrixXd;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json rows(const Matrix& M) {
  Json all = Json::array();
  for (const auto& row : M.rowwise()) {
    Json one = Json::array();
    for (const double value : row) one.push_back(number(value));
    all.push_back(std::move(one));
  }
  return all;
}

Json matrices(const std::vector<Matrix>& list) {
  Json all = Json::array();
  for (const Matrix& M : list) all.push_back(rows(M));
  return all;
}

/// Of the size that its first row says.
Matrix read_matrix(const Json& document, const std::string& pointer) {
  const auto table = document.get<std::vector<std::vector<double>>>();
  const auto columns = table.empty() ? 0 : table.front().size();
  Matrix M(static_cast<Eigen::Index>(table.size()), static_cast<Eigen::Index>(columns));
  for (std::size_t row = 0; row < table.size(); ++row) {
    if (table[row].size() != columns) throw InputError(pointer, "the rows of a matrix differ in length");
    for (std::size_t column = 0; column < columns; ++column) {
      M(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = table[row][column];
    }
  }
  return M;
}

std::vector<Matrix> read_matrices(const Json& document, const std::string& pointer) {
  std::vector<Matrix> list;
  for (const Json& one : document) list.push_back(read_matrix(one, pointer + "/" + std::to_string(list.size())));
  return list;
}

void check_sizes(const Design& design, const std::string& pointer) {
  const auto count = design.L.size();
  const bool whole = design.P.size() == count && design.gamma_d.size() == count && design.gamma_w.size() == count &&
                     design.kappa.size() == count;
  if (!whole) throw InputError(pointer, "a design's lists differ in length: one entry a subsystem was expected");
  for (std::size_t i = 0; i < count; ++i) {
    if (design.P[i].rows() != design.P[i].cols() || design.P[i].rows() != design.L[i].rows()) {
      throw InputError(pointer + "/P/" + std::to_string(i), "P is not square with as many rows as L");
    }
  }
}

}  // namespace

Json to_json(const Certificate& c) {
  Json poles = Json::array(), margins = Json::array(), norms = Json::array();
  for (const auto& pole : c.poles) poles.push_back(Json::array({number(pole.real()), number(pole.imag())}));
  for (const double margin : c.margins) margins.push_back(number(margin));
  for (const double norm : c.norm_l) norms.push_back(number(norm));
  return {{"holds", c.holds},
          {"reason", c.reason},
          {"lambda_max_sigma", number(c.lambda_max_sigma)},
          {"lambda_min_p", number(c.lambda_min_p)},
          {"margins", std::move(margins)},
          {"max_real_pole", number(c.max_real_pole)},
          {"fastest_pole", number(c.fastest_pole)},
          {"poles", std::move(poles)},
          {"norm_l", std::move(norms)}};
}

Json to_json(const Design& design) {
  return {{"L", matrices(design.L)},   {"P", matrices(design.P)}, {"gamma_d", design.gamma_d},
          {"gamma_w", design.gamma_w}, {"kappa", design.kappa},   {"objective", number(design.objective)}};
}

Design read_design(const Json& document, const std::string& pointer) {
  try {
    Design design;
    design.L = read_matrices(document.at("L"), pointer + "/L");
    design.P = read_matrices(document.at("P"), pointer + "/P");
    document.at("gamma_d").get_to(design.gamma_d);
    document.at("gamma_w").get_to(design.gamma_w);
    document.at("kappa").get_to(design.kappa);
    document.at("objective").get_to(design.objective);
    check_sizes(design, pointer);
    return design;
  } catch (const Json::exception& error) {
    throw InputError(pointer, std::string("a design cannot be read: ") + error.what());
  }
}

}  // namespace vigil::observer
