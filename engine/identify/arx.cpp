#include "engine/identify/arx.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/describe.hpp"
#include "engine/core/input_error.hpp"
#include "engine/core/missing.hpp"
#include "engine/identify/regression.hpp"

namespace vigil::identify {
namespace {

/// Complete rows: what the outputs of row k are explained by, and the outputs.
struct Sample {
  Eigen::MatrixXd past, inputs, outputs;
};

bool complete(const Records& records, Eigen::Index k, int order, int lag) {
  if (k < std::max(order, lag)) return false;
  for (int i = 0; i <= order; ++i) {
    if (!records.outputs.row(k - i).allFinite()) return false;
  }
  return records.inputs.row(k - lag).allFinite();
}

Sample gather(const Records& records, Eigen::Index from, Eigen::Index to, int order, int lag) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index k = from; k < to; ++k) {
    if (complete(records, k, order, lag)) rows.push_back(k);
  }
  const Eigen::Index count = static_cast<Eigen::Index>(rows.size()), n = records.outputs.cols();
  Sample sample{Eigen::MatrixXd(count, n * order), Eigen::MatrixXd(count, records.inputs.cols()),
                Eigen::MatrixXd(count, n)};
  for (Eigen::Index r = 0; r < count; ++r) {
    const Eigen::Index k = rows[static_cast<std::size_t>(r)];
    sample.outputs.row(r) = records.outputs.row(k);
    sample.inputs.row(r) = records.inputs.row(k - lag);
    for (int i = 0; i < order; ++i) sample.past.row(r).segment(i * n, n) = records.outputs.row(k - 1 - i);
  }
  return sample;
}

void check(const Records& records, const Sample& sample, int order) {
  const Eigen::Index weights = sample.past.cols() + sample.inputs.cols() + 1, rows = sample.outputs.rows();
  if (rows < 3 * weights)
    throw InputError(
        "/rows", fmt::format("{} complete rows are too few for {} weights an output at order {}; expected at least {}",
                             rows, weights, order, 3 * weights));
  for (Eigen::Index c = 0; c < sample.outputs.cols(); ++c) {
    if (sample.outputs.col(c).maxCoeff() > sample.outputs.col(c).minCoeff()) continue;
    throw InputError(fmt::format("/outputs/{}", c), records.output(c) + " never changes; expected outputs that move");
  }
}

void split(const Eigen::MatrixXd& weights, int order, Arx& model) {
  const Eigen::Index n = weights.rows();
  for (int i = 0; i < order; ++i) model.A.emplace_back(weights.middleCols(i * n, n));
  model.B = weights.rightCols(weights.cols() - order * n);
}

Eigen::MatrixXd autonomous(const std::vector<Eigen::MatrixXd>& A, const Eigen::MatrixXd& past) {
  const Eigen::Index n = A.front().rows();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(past.rows(), n);
  for (std::size_t i = 0; i < A.size(); ++i)
    sum += past.middleCols(static_cast<Eigen::Index>(i) * n, n) * A[i].transpose();
  return sum;
}

/// Squares of each output's residuals over the sample.
Eigen::VectorXd squares(const Arx& model, const Sample& sample) {
  Eigen::MatrixXd left = sample.outputs - autonomous(model.A, sample.past) - sample.inputs * model.B.transpose();
  left.rowwise() -= model.c.transpose();
  return left.colwise().squaredNorm().transpose();
}

void stabilise(const Sample& sample, Arx& model) {
  model.fitted_radius = model.radius = spectral_radius(model.A);
  if (model.radius <= kLargestRadius) return;
  const Eigen::VectorXd before = squares(model, sample);
  const double shrink = kLargestRadius / model.radius;
  double factor = 1;
  for (Eigen::MatrixXd& A : model.A) A *= factor *= shrink;
  const Regression rest = regress(sample.inputs, sample.outputs - autonomous(model.A, sample.past));
  model.B = rest.weights;
  model.c = rest.constant;
  model.radius = spectral_radius(model.A);
  const Eigen::VectorXd after = squares(model, sample), exact = 1e-20 * sample.outputs.colwise().squaredNorm();
  model.loss = ((after + exact).array() / (before + exact).array()).mean();
  if (model.loss <= kLargestLoss) return;
  throw InputError("/rows",
                   fmt::format("what was recorded grows: its model of order {} has spectral radius {:.6g}, and the "
                               "nearest stable one has {:.3g} times its squared error; expected a plant that is stable",
                               model.order(), model.fitted_radius, model.loss),
                   fmt::format("spectral radius <= {}", kLargestRadius));
}

}  // namespace

std::string Records::output(Eigen::Index place) const {
  const auto p = static_cast<std::size_t>(place);
  return "output " + (p < names.size() ? in_quotes(names[p]) : std::to_string(p + 1));
}

Eigen::MatrixXd companion(const std::vector<Eigen::MatrixXd>& A) {
  const Eigen::Index n = A.front().rows(), size = n * static_cast<Eigen::Index>(A.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < A.size(); ++i) result.block(0, static_cast<Eigen::Index>(i) * n, n, n) = A[i];
  result.bottomLeftCorner(size - n, size - n).diagonal().setOnes();
  return result;
}

double spectral_radius(const std::vector<Eigen::MatrixXd>& A) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(companion(A), false).eigenvalues().cwiseAbs().maxCoeff();
}

Arx fit(const Records& records, Eigen::Index from, Eigen::Index to, int order, int lag) {
  const Sample sample = gather(records, from, to, order, lag);
  check(records, sample, order);
  Eigen::MatrixXd regressors(sample.past.rows(), sample.past.cols() + sample.inputs.cols());
  regressors << sample.past, sample.inputs;
  const Regression found = regress(regressors, sample.outputs);
  Arx model;
  model.lag = lag;
  model.c = found.constant;
  model.ridge = found.ridge;
  split(found.weights, order, model);
  stabilise(sample, model);
  return model;
}

Eigen::MatrixXd residuals(const Arx& model, const Records& records) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Constant(records.outputs.rows(), records.outputs.cols(), kMissing);
  for (Eigen::Index k = 0; k < result.rows(); ++k) {
    if (!complete(records, k, model.order(), model.lag)) continue;
    Eigen::VectorXd left = records.outputs.row(k).transpose() - model.c;
    left.noalias() -= model.B * records.inputs.row(k - model.lag).transpose();
    for (int i = 0; i < model.order(); ++i)
      left.noalias() -= model.A[static_cast<std::size_t>(i)] * records.outputs.row(k - 1 - i).transpose();
    result.row(k) = left.transpose();
  }
  return result;
}

Eigen::VectorXd free_run_error(const Arx& model, const Records& records, Eigen::Index from) {
  const Eigen::Index n = records.outputs.cols(), rows = records.outputs.rows();
  Eigen::Index k = std::max<Eigen::Index>(from, std::max(model.order(), model.lag));
  while (k < rows && !complete(records, k, model.order(), model.lag)) ++k;
  if (k >= rows) return Eigen::VectorXd::Constant(n, kMissing);
  Eigen::MatrixXd own = records.outputs;
  Eigen::VectorXd input = records.inputs.row(k - model.lag).transpose();
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(n), count = sum;
  for (; k < rows; ++k) {
    for (Eigen::Index c = 0; c < input.size(); ++c) {
      const double value = records.inputs(k - model.lag, c);
      if (std::isfinite(value)) input[c] = value;
    }
    Eigen::VectorXd next = model.c + model.B * input;
    for (int i = 0; i < model.order(); ++i)
      next += model.A[static_cast<std::size_t>(i)] * own.row(k - 1 - i).transpose();
    own.row(k) = next.transpose();
    if (!next.allFinite()) return Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity());
    for (Eigen::Index c = 0; c < n; ++c) {
      const double error = records.outputs(k, c) - next[c];
      if (!std::isfinite(error)) continue;
      sum[c] += error * error;
      ++count[c];
    }
  }
  return (sum.array() / count.array()).sqrt();
}

}  // namespace vigil::identify
