#include <cmath>
#include <stdexcept>

#include "engine/core/describe.hpp"
#include "engine/core/params.hpp"

namespace vigil {
namespace {

[[noreturn]] void refuse(const Json& value, int n, const std::string& pointer) {
  const std::string size = std::to_string(n);
  const std::string expected = "a " + size + " x " + size + " matrix, a diagonal of " + size + " or a number";
  throw InputError(pointer, shown(value) + " does not fit; expected " + expected, expected);
}

double finite_entry(const Json& entry, const Json& whole, int n, const std::string& pointer) {
  if (!entry.is_number()) refuse(whole, n, pointer);
  const double value = entry.get<double>();
  if (!std::isfinite(value)) refuse(whole, n, pointer);
  return value;
}

}  // namespace

Eigen::MatrixXd square_matrix(const Json& value, int n, const std::string& pointer) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
  if (value.is_number()) {
    result.diagonal().setConstant(finite_entry(value, value, n, pointer));
    return result;
  }
  if (!value.is_array() || value.size() != static_cast<std::size_t>(n)) refuse(value, n, pointer);
  for (int i = 0; i < n; ++i) {
    const Json& row = value[static_cast<std::size_t>(i)];
    if (row.is_number()) {
      if (!value.front().is_number()) refuse(value, n, pointer);
      result(i, i) = finite_entry(row, value, n, pointer);
      continue;
    }
    if (!row.is_array() || value.front().is_number() || row.size() != static_cast<std::size_t>(n))
      refuse(value, n, pointer);
    for (int j = 0; j < n; ++j) result(i, j) = finite_entry(row[static_cast<std::size_t>(j)], value, n, pointer);
  }
  return result;
}

const Json& Params::at(std::string_view name) const {
  const auto place = values_.find(std::string(name));
  if (place == values_.end()) throw std::logic_error("parameter " + std::string(name) + " was not declared");
  return *place;
}

bool Params::given(std::string_view name) const { return !at(name).is_null(); }
double Params::real(std::string_view name) const { return at(name).get<double>(); }
int Params::integer(std::string_view name) const { return at(name).get<int>(); }
bool Params::boolean(std::string_view name) const { return at(name).get<bool>(); }
std::string Params::text(std::string_view name) const { return at(name).get<std::string>(); }
std::vector<std::string> Params::texts(std::string_view name) const { return at(name).get<std::vector<std::string>>(); }

Eigen::VectorXd Params::vector(std::string_view name) const {
  const Json& value = at(name);
  Eigen::VectorXd result(static_cast<Eigen::Index>(value.size()));
  for (std::size_t i = 0; i < value.size(); ++i) result(static_cast<Eigen::Index>(i)) = value[i].get<double>();
  return result;
}

Eigen::MatrixXd Params::matrix(std::string_view name) const {
  const Json& value = at(name);
  if (value.is_number()) return Eigen::MatrixXd::Constant(1, 1, value.get<double>());
  if (value.front().is_number()) return vector(name).asDiagonal();
  const auto rows = static_cast<Eigen::Index>(value.size()), columns = static_cast<Eigen::Index>(value.front().size());
  Eigen::MatrixXd result(rows, columns);
  for (Eigen::Index r = 0; r < rows; ++r) {
    for (Eigen::Index c = 0; c < columns; ++c)
      result(r, c) = value[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)].get<double>();
  }
  return result;
}

Eigen::MatrixXd Params::square(std::string_view name, int n) const {
  try {
    return square_matrix(at(name), n, "");
  } catch (const InputError& error) {
    throw InputError("/" + std::string(name), std::string(name) + " is " + error.problems().front().detail,
                     error.problems().front().allowed);
  }
}

}  // namespace vigil
