#include "engine/metrics/lane_score.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/core/missing.hpp"
#include "engine/linalg/chi_square.hpp"

namespace vigil {
namespace {

/// v' A^-1 v by Cholesky; NaN where A is not positive definite.
double inverse_form(const double* a, const BoundedVector& v) {
  const auto n = v.size();
  const BoundedMatrix A = Eigen::Map<const Eigen::MatrixXd>(a, n, n);
  const Eigen::LLT<BoundedMatrix> cholesky(A);
  if (cholesky.info() != Eigen::Success) return kMissing;
  const BoundedVector whitened = cholesky.matrixL().solve(v);
  return whitened.squaredNorm();
}

}  // namespace

BoundedVector state_error(const Eigen::VectorXd& truth, const double* estimate, const std::vector<double>& periods) {
  BoundedVector e(truth.size());
  for (Eigen::Index c = 0; c < e.size(); ++c) e[c] = wrap(estimate[c] - truth[c], periods[static_cast<std::size_t>(c)]);
  return e;
}

void LaneScore::Sum::add(double value) {
  if (!std::isfinite(value)) return;
  total += value;
  ++count;
}

double LaneScore::Sum::mean() const { return count == 0 ? kMissing : total / static_cast<double>(count); }

LaneScore::LaneScore(const Plant& plant, std::vector<std::string> outputs, ScoreRules rules,
                     std::vector<std::vector<int>> components)
    : rules_(std::move(rules)),
      groups_(plant.errors()),
      outputs_(std::move(outputs)),
      components_(std::move(components)) {
  for (const Component& component : plant.state()) periods_.push_back(component.period);
  sums_.resize(outputs_.size() * groups_.size());
  last_.resize(outputs_.size() * kWindow);
  mse_.resize(outputs_.size() * rules_.mse.size());
  error_.resize(plant.states());
  components_.resize(outputs_.size());
  for (std::vector<int>& own : components_) {
    if (own.empty()) {
      own.resize(static_cast<std::size_t>(plant.states()));
      std::iota(own.begin(), own.end(), 0);
    }
    members_.emplace_back(groups_.size());
    for (std::size_t place = 0; place < own.size(); ++place) {
      for (std::size_t g = 0; g < groups_.size(); ++g) {
        const auto& group = groups_[g].components;
        if (std::find(group.begin(), group.end(), own[place]) != group.end())
          members_.back()[g].push_back(static_cast<int>(place));
      }
    }
  }
}

TickScore LaneScore::judge(std::int64_t k, int output, const Eigen::VectorXd& truth, const Belief& belief) {
  TickScore score;
  const auto& own = components_[static_cast<std::size_t>(output)];
  auto e = error_.head(static_cast<Eigen::Index>(own.size()));
  for (std::size_t place = 0; place < own.size(); ++place) {
    const auto c = static_cast<std::size_t>(own[place]);
    e[static_cast<Eigen::Index>(place)] = wrap(belief.mean[place] - truth[own[place]], periods_[c]);
  }
  for (int g = 0; g < groups(); ++g) {
    double square = 0;
    for (const int c : members_[static_cast<std::size_t>(output)][static_cast<std::size_t>(g)]) square += e[c] * e[c];
    score.error[g] = std::sqrt(square);
    if (!rules_.window.holds(k)) continue;
    cell(output, g).add(square);
    if (g == 0) {
      Sum& slot = last_[static_cast<std::size_t>(output * kWindow + static_cast<int>(k % kWindow))];
      slot = {};
      slot.add(square);
    }
  }
  for (std::size_t f = 0; f < rules_.mse.size(); ++f) {
    const auto found = std::find(own.begin(), own.end(), rules_.mse[f].component);
    if (found == own.end()) continue;
    const double value = e[found - own.begin()];
    if (rules_.mse[f].window.holds(k)) mse_[f * outputs_.size() + static_cast<std::size_t>(output)].add(value * value);
  }
  score.nees = belief.covariance == nullptr ? kMissing : inverse_form(belief.covariance, BoundedVector(e));
  score.nis = kMissing;
  if (belief.innovation != nullptr) {
    const Eigen::Map<const Eigen::VectorXd> r(belief.innovation, belief.innovation_size);
    score.nis = belief.innovation_covariance == nullptr ? r.squaredNorm()
                                                        : inverse_form(belief.innovation_covariance, BoundedVector(r));
  }
  if (rules_.window.holds(k)) {
    nees_.add(score.nees);
    nis_.add(score.nis);
  }
  return score;
}

void LaneScore::append_metrics(const std::string& lane, std::vector<MetricValue>& metrics) const {
  const auto add = [&](const std::string& node, const std::string& name, double value) {
    metrics.push_back({lane, node, name, "", value, false});
  };
  for (int g = 0; g < groups(); ++g) {
    Sum all;
    for (int o = 0; o < static_cast<int>(outputs_.size()); ++o) {
      all.total += cell(o, g).total;
      all.count += cell(o, g).count;
    }
    add("", "rmse_" + groups_[static_cast<std::size_t>(g)].name, std::sqrt(all.mean()));
    if (g == 0) {
      Sum recent;
      for (const Sum& slot : last_) {
        recent.total += slot.total;
        recent.count += slot.count;
      }
      add("", "rmse_" + groups_[0].name + "_last10", std::sqrt(recent.mean()));
    }
  }
  if (outputs_.size() > 1 || outputs_.front() != "fused") {
    for (int g = 0; g < groups(); ++g) {
      for (std::size_t o = 0; o < outputs_.size(); ++o) {
        add(outputs_[o], "rmse_" + groups_[static_cast<std::size_t>(g)].name,
            std::sqrt(cell(static_cast<int>(o), g).mean()));
      }
    }
  }
  for (std::size_t f = 0; f < rules_.mse.size(); ++f) {
    for (std::size_t o = 0; o < outputs_.size(); ++o)
      add(outputs_[o], rules_.mse[f].name, mse_[f * outputs_.size() + o].mean());
  }
  if (nees_.count > 0) add("", "nees_mean", nees_.mean());
  if (nis_.count > 0) add("", "nis_mean", nis_.mean());
}

Json LaneScore::bounds(int channels) const {
  const auto interval = [](int degrees) {
    return Json{chi_square_quantile(0.025, degrees), chi_square_quantile(0.975, degrees)};
  };
  return {{"nees_interval_95", interval(static_cast<int>(periods_.size()))}, {"nis_interval_95", interval(channels)}};
}

}  // namespace vigil
