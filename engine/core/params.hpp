/// Declared parameters: one table a method, attack, plant or sensor. From it come parsing, range errors, the JSON
/// Schema, the web form and the documentation.
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/input_error.hpp"
#include "engine/core/json.hpp"

namespace vigil {

/// The same words in the page's two languages.
struct Words {
  std::string en;
  std::string zh;
};

enum class ParamType {
  real,
  integer,
  boolean,
  text,    ///< one of `choices`
  texts,   ///< a list of texts, none of them empty
  vector,  ///< [..], any length unless `rows` is set
  matrix,  ///< [[..],..], a diagonal [..], or a number times the identity; kept as given
  object,  ///< a document of its own, read and checked by whoever declared it
};

/// One declared parameter. Built with designated initialisers; what is left out is free.
struct Param {
  std::string name;
  ParamType type = ParamType::real;
  Json fallback;  ///< the default; null: see `nullable`
  std::string unit;
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool exclusive_minimum = false;
  bool exclusive_maximum = false;
  std::vector<std::string> choices;
  int rows = 0;           ///< length of a vector, 0: any
  bool nullable = false;  ///< null is legal and means "follow" or "automatic", as `meaning` says
  bool required = false;  ///< no default: the document must give it (a camera's position)
  bool live = false;      ///< may be changed while a run goes on
  std::string symbol;     ///< of the paper
  Words meaning;
};

class Params;

/// The declared table. Immutable after it was made.
class ParamTable {
 public:
  ParamTable() = default;
  ParamTable(std::vector<Param> params);  // NOLINT(google-explicit-constructor): a table is its list

  const std::vector<Param>& all() const { return params_; }
  const Param* find(std::string_view name) const;

  /// Checks an object of given values and fills in the defaults; problems found are appended with pointers under
  /// `pointer` (unknown key with the nearest valid one, wrong type, out of range, non-finite). The result is usable
  /// only if none were.
  Json complete(const Json& given, const std::string& pointer, std::vector<Problem>& problems) const;
  /// The same for one value; the problem or nothing.
  std::optional<Problem> check(const Param& param, const Json& value, const std::string& pointer) const;

  Json schema() const;   ///< JSON Schema object with "properties", additionalProperties false
  Json to_json() const;  ///< [{name,type,unit,default,minimum,maximum,choices,nullable,live,symbol,meaning{en,zh}}]

 private:
  std::vector<Param> params_;
};

/// Completed values of a table, read by name. Reading a name that was not declared is a programming error (throws
/// std::logic_error).
class Params {
 public:
  Params() = default;
  explicit Params(Json values) : values_(std::move(values)) {}

  bool given(std::string_view name) const;  ///< not null
  double real(std::string_view name) const;
  int integer(std::string_view name) const;
  bool boolean(std::string_view name) const;
  std::string text(std::string_view name) const;
  std::vector<std::string> texts(std::string_view name) const;
  Eigen::VectorXd vector(std::string_view name) const;
  /// A square matrix of size n from [[..]], a diagonal or a number. Throws InputError (pointer "/<name>") when the
  /// sizes do not fit.
  Eigen::MatrixXd square(std::string_view name, int n) const;
  /// A matrix of any shape from [[..]], a diagonal or a number.
  Eigen::MatrixXd matrix(std::string_view name) const;
  const Json& values() const { return values_; }

 private:
  const Json& at(std::string_view name) const;
  Json values_ = Json::object();
};

/// Reads a square matrix of size n from [[..]], a diagonal [..] or a number. Throws InputError at `pointer` otherwise.
Eigen::MatrixXd square_matrix(const Json& value, int n, const std::string& pointer);

/// The candidate with the smallest edit distance to `word`, "" when there is none near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace vigil
