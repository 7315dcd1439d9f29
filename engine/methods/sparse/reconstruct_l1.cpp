/// The attack by basis pursuit, without an allowance for noise: dense, with false entries where the state would rather
/// be blamed. Seed 001, section 4; specification, section 10.
#include <Eigen/QR>

#include "engine/linalg/basis_pursuit.hpp"
#include "engine/methods/sparse/reconstructor.hpp"

namespace vigil::sparse {
namespace {

class L1Reconstructor final : public Reconstructor {
 public:
  explicit L1Reconstructor(const WindowShape& shape)
      : states_(shape.states),
        rows_(shape.freedom()),
        pursuit_(std::max(rows_, 1), shape.size()),
        qr_(shape.size(), shape.states),
        full_(shape.size(), shape.size()),
        workspace_(shape.size()),
        D_(rows_, shape.size()),
        b_(rows_) {}

  std::unique_ptr<Reconstructor> clone() const override { return std::make_unique<L1Reconstructor>(*this); }

  bool solve(const Regression& regression, Eigen::Ref<Eigen::VectorXd> E) override {
    E.setZero();
    if (rows_ == 0) return true;
    qr_.compute(regression.Phi);
    qr_.householderQ().evalTo(full_, workspace_);
    D_ = full_.rightCols(rows_).transpose();  // Q2', of which any choice gives the same E
    b_.noalias() = D_ * regression.r;
    if (!pursuit_.solve(D_, b_)) return false;
    E = pursuit_.entries();
    const double least = 1e-6 * E.cwiseAbs().maxCoeff();  // what counts as an entry: specification, section 10
    E = (E.array().abs() > least).select(E, 0);
    return true;
  }

  bool selects() const override { return false; }

 private:
  int states_, rows_;
  BasisPursuit pursuit_;
  Eigen::HouseholderQR<Eigen::MatrixXd> qr_;
  Eigen::MatrixXd full_;
  Eigen::VectorXd workspace_;
  Eigen::MatrixXd D_;
  Eigen::VectorXd b_;
};

}  // namespace

std::unique_ptr<Reconstructor> make_l1(const Params& /*params*/, const WindowShape& shape) {
  return std::make_unique<L1Reconstructor>(shape);
}

}  // namespace vigil::sparse
