#include "engine/linalg/sdp.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "engine/linalg/covariance.hpp"

namespace vigil {
namespace {

auto place(const SdpEntry& entry) { return std::tie(entry.matrix, entry.block, entry.row, entry.column); }

constexpr int kLargestBlock = 10000;  // a dense one of that order takes 0.8 GB

void check_entry(const SdpProblem& problem, const SdpEntry& entry) {
  const bool placed = entry.matrix >= 0 && entry.matrix <= problem.variables() && entry.block >= 0 &&
                      entry.block < static_cast<int>(problem.blocks.size());
  if (!placed || entry.row < 0 || entry.column >= problem.blocks[static_cast<std::size_t>(entry.block)]) {
    throw std::invalid_argument(
        fmt::format("no place ({}, {}) in block {} of matrix {}", entry.row, entry.column, entry.block, entry.matrix));
  }
  if (!std::isfinite(entry.value)) throw std::invalid_argument("an entry of a semidefinite program is not finite");
}

class Fnv1a {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte, word >>= 8) hash_ = (hash_ ^ (word & 255U)) * 1099511628211U;
  }
  void add(int number) { add(static_cast<std::uint64_t>(number)); }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037U;
};

}  // namespace

void canonicalise(SdpProblem& problem) {
  for (const double cost : problem.cost) {
    if (!std::isfinite(cost)) throw std::invalid_argument("a cost of a semidefinite program is not finite");
  }
  for (const int order : problem.blocks) {
    if (order < 0 || order > kLargestBlock) throw std::invalid_argument(fmt::format("no block of order {}", order));
  }
  auto& entries = problem.entries;
  for (SdpEntry& entry : entries) {
    if (entry.row > entry.column) std::swap(entry.row, entry.column);
    check_entry(problem, entry);
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const SdpEntry& a, const SdpEntry& b) { return place(a) < place(b); });
  std::size_t kept = 0;
  for (const SdpEntry& entry : entries) {
    if (kept > 0 && place(entries[kept - 1]) == place(entry)) {
      entries[kept - 1].value += entry.value;
    } else {
      entries[kept++] = entry;
    }
  }
  entries.resize(kept);
  std::erase_if(entries, [](const SdpEntry& entry) { return entry.value == 0; });
}

std::string content_hash(const SdpProblem& problem) {
  Fnv1a hash;
  hash.add(problem.variables());
  for (const double cost : problem.cost) hash.add(cost);
  hash.add(static_cast<int>(problem.blocks.size()));
  for (const int order : problem.blocks) hash.add(order);
  for (const SdpEntry& entry : problem.entries) {
    for (const int index : {entry.matrix, entry.block, entry.row, entry.column}) hash.add(index);
    hash.add(entry.value);
  }
  return fmt::format("{:016x}", hash.value());
}

double objective(const SdpProblem& problem, const Eigen::VectorXd& y) {
  return Eigen::Map<const Eigen::VectorXd>(problem.cost.data(), problem.variables()).dot(y);
}

std::vector<Eigen::MatrixXd> blocks_at(const SdpProblem& problem, const Eigen::VectorXd& y) {
  std::vector<Eigen::MatrixXd> blocks;
  blocks.reserve(problem.blocks.size());
  for (const int order : problem.blocks) blocks.push_back(Eigen::MatrixXd::Zero(order, order));
  for (const SdpEntry& entry : problem.entries) {
    auto& block = blocks[static_cast<std::size_t>(entry.block)];
    const double value = entry.matrix == 0 ? -entry.value : y[entry.matrix - 1] * entry.value;
    block(entry.row, entry.column) += value;
    if (entry.row != entry.column) block(entry.column, entry.row) += value;
  }
  return blocks;
}

std::vector<double> smallest_eigenvalues(const SdpProblem& problem, const Eigen::VectorXd& y) {
  std::vector<double> least;
  for (const Eigen::MatrixXd& block : blocks_at(problem, y)) {
    if (block.size() == 0) {
      least.push_back(0);
      continue;
    }
    least.push_back(least_eigenvalue(block));
  }
  return least;
}

}  // namespace vigil
