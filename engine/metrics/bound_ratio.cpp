#include "engine/metrics/bound_ratio.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vigil {

void BoundSums::grow(std::size_t cells) {
  while (counts_.size() < cells) {
    counts_.push_back(0);
    outer_.emplace_back(Eigen::MatrixXd::Zero(states_, states_));
    bounds_.emplace_back(Eigen::MatrixXd::Zero(states_, states_));
  }
}

void BoundSums::add(const BoundSums& other) {
  if (other.empty()) return;
  if (empty()) {
    *this = other;
    return;
  }
  if (states_ != other.states_) throw std::runtime_error("Bounds of other sizes cannot be summed.");
  grow(other.counts_.size());
  for (std::size_t cell = 0; cell < other.counts_.size(); ++cell) {
    counts_[cell] += other.counts_[cell];
    outer_[cell] += other.outer_[cell];
    bounds_[cell] += other.bounds_[cell];
  }
}

void BoundSums::add(const BoundRecord& record) {
  if (!empty() && states_ != record.states) throw std::runtime_error("Bounds of other sizes cannot be summed.");
  states_ = record.states;
  if (states_ == 0) return;
  const auto n = static_cast<std::size_t>(states_);
  const std::size_t cells = record.errors.size() / n;
  grow(cells);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const Eigen::Map<const Eigen::VectorXd> e(record.errors.data() + cell * n, states_);
    if (!e.allFinite()) continue;
    outer_[cell] += e * e.transpose();
    bounds_[cell] += Eigen::Map<const Eigen::MatrixXd>(record.bounds.data() + cell * n * n, states_, states_);
    ++counts_[cell];
  }
}

double BoundSums::max() const {
  double worst = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t cell = 0; cell < counts_.size(); ++cell) {
    if (counts_[cell] == 0) continue;
    const double runs = static_cast<double>(counts_[cell]);
    const Eigen::LLT<Eigen::MatrixXd> cholesky(bounds_[cell] / runs);
    if (cholesky.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
    const Eigen::MatrixXd half = cholesky.matrixL().solve(outer_[cell] / runs);
    const Eigen::MatrixXd ratio = cholesky.matrixL().solve(half.transpose());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (ratio + ratio.transpose()),
                                                               Eigen::EigenvaluesOnly);
    worst = std::fmax(worst, eigen.eigenvalues()[states_ - 1]);
  }
  return worst;
}

void BoundSums::save(ByteWriter& out) const {
  out.integer(states_);
  out.word(counts_.size());
  for (std::size_t cell = 0; cell < counts_.size(); ++cell) {
    out.integer(counts_[cell]);
    for (const double value : outer_[cell].reshaped()) out.number(value);
    for (const double value : bounds_[cell].reshaped()) out.number(value);
  }
}

void BoundSums::load(ByteReader& in) {
  states_ = static_cast<int>(in.integer());
  if (states_ < 0 || states_ > 10'000) throw std::runtime_error("Saved bounds have an impossible size.");
  const std::size_t cells = in.count(8 + 16 * static_cast<std::size_t>(states_) * static_cast<std::size_t>(states_));
  counts_.assign(cells, 0);
  outer_.assign(cells, Eigen::MatrixXd(states_, states_));
  bounds_ = outer_;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    counts_[cell] = in.integer();
    for (double& value : outer_[cell].reshaped()) value = in.number();
    for (double& value : bounds_[cell].reshaped()) value = in.number();
  }
}

void BoundRatio::close_block() {
  whole_.add(block_);
  block_ = {};
}

double BoundRatio::max() const {
  BoundSums all = whole_;
  all.add(block_);
  return all.max();
}

void BoundRatio::save(ByteWriter& out) const {
  whole_.save(out);
  block_.save(out);
}

void BoundRatio::load(ByteReader& in) {
  whole_.load(in);
  block_.load(in);
}

}  // namespace vigil
