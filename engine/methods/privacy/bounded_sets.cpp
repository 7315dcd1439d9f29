#include "engine/methods/privacy/bounded_sets.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;

constexpr int kHalfway = 200, kLast = 400;  // steps
constexpr double kGrowth = 1.02;            // what the trace may grow by between them
constexpr double kSettled = 1e-13;          // relative change below which nothing moves any more

bool still(const MatrixXd& now, const MatrixXd& before) { return (now - before).norm() <= kSettled * now.norm(); }

bool same(const MatrixXd& a, const MatrixXd& b) { return a.rows() == b.rows() && a.cols() == b.cols() && a == b; }

bool same(const FusionModel& a, const FusionModel& b) {
  return a.count() == b.count() && same(a.A, b.A) && same(a.noise(), b.noise()) && same(a.P0, b.P0) &&
         std::equal(a.sensors.begin(), a.sensors.end(), b.sensors.begin(),
                    [](const SensorModel& x, const SensorModel& y) { return same(x.C, y.C) && same(x.R, y.R); });
}

}  // namespace

BoundedCheck::BoundedCheck(FusionModel model) : model_(std::move(model)), steps_(local_steps(model_)) {
  if (model_.P0.size() == 0) {
    const auto filters = stationary_filters(model_);
    if (!filters) return;
    start_ = filters->P;
  } else {
    start_ = common_start(model_.P0, model_.count());
  }
  MatrixXd P = start_;
  const MatrixXd Qb = model_.noise();
  for (int t = 1; t <= kLast; ++t) {
    const MatrixXd before = P;
    auto gains = step_local(steps_, Qb, P);
    if (!gains) {
      P_.clear();
      return;
    }
    P_.push_back(P);
    gains_.push_back(std::move(*gains));
    if (still(P, before)) return;
  }
}

bool BoundedCheck::bounded(const ComponentSet& set) const {
  if (P_.empty()) return false;
  const Eigen::VectorXd h = kept(set, model_.stacked());
  const MatrixXd Qb = model_.noise();
  Legitimate user =
      model_.P0.size() == 0 ? legitimate_from(start_, model_.states()) : legitimate_start(model_.P0, model_.count());
  double halfway = 0;
  for (std::size_t t = 0; t < kLast; ++t) {
    const std::size_t at = std::min(t, P_.size() - 1);
    const MatrixXd P_before = user.P, X_before = user.X;
    step_legitimate(steps_, gains_[at], Qb, P_[at], model_.A, h, user);
    if (t < kHalfway) halfway = user.P.trace();
    if (t >= P_.size() && still(user.P, P_before) && still(user.X, X_before)) break;
  }
  return user.P.trace() <= kGrowth * halfway;
}

// What is remembered belongs to one thread, so that runs in several never meet.
std::shared_ptr<const BoundedCheck> bounded_check(const FusionModel& model) {
  thread_local std::shared_ptr<const BoundedCheck> last;
  if (!last || !same(last->model(), model)) last = std::make_shared<BoundedCheck>(model);
  return last;
}

bool bounded(const std::shared_ptr<const BoundedCheck>& check, const ComponentSet& set) {
  thread_local std::shared_ptr<const BoundedCheck> asked;
  thread_local std::map<ComponentSet, bool> answers;
  if (asked != check) {
    asked = check;
    answers.clear();
  }
  const auto [answer, fresh] = answers.try_emplace(set, false);
  if (fresh) answer->second = check->bounded(set);
  return answer->second;
}

std::vector<ComponentSet> bounded_sets(const FusionModel& model, const std::vector<ComponentSet>& sets) {
  const auto check = bounded_check(model);
  std::vector<ComponentSet> admissible;
  std::copy_if(sets.begin(), sets.end(), std::back_inserter(admissible),
               [&](const ComponentSet& set) { return bounded(check, set); });
  return admissible;
}

}  // namespace vigil::privacy
