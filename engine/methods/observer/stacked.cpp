#include "engine/methods/observer/stacked.hpp"

namespace vigil::observer {

void StackedObserver::stack(const Eigen::Ref<const Eigen::VectorXd>& z, const Eigen::VectorXd& y,
                            const Eigen::VectorXd& u) {
  stacked_.head(size()) = z;
  stacked_.segment(size(), outputs()) = y;
  stacked_.tail(inputs()) = u;
}

void StackedObserver::slope(const Eigen::Ref<const Eigen::VectorXd>& z, const Eigen::VectorXd& y,
                            const Eigen::VectorXd& u, Eigen::Ref<Eigen::VectorXd> dz) {
  stack(z, y, u);
  dz.noalias() = slope_ * stacked_;
  if (nonlinear_.empty()) return;
  argument_.noalias() = arguments_ * stacked_;
  Eigen::Index argument = 0, entry = 0;
  for (const int i : nonlinear_) {
    const Subsystem& s = subsystems_[static_cast<std::size_t>(i)];
    nonlinearity(s, argument_.segment(argument, s.n()), phi_.segment(entry, s.r()));
    argument += s.n();
    entry += s.r();
  }
  dz.noalias() += entrances_ * phi_;
}

void StackedObserver::say(const Eigen::Ref<const Eigen::VectorXd>& z, const Eigen::VectorXd& y,
                          const Eigen::VectorXd& u, std::vector<Said>& said) {
  stack(z, y, u);
  said.resize(rows_.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto fill = [&](const Eigen::MatrixXd& rows, Eigen::VectorXd& out) {
      out.resize(rows.rows());
      out.noalias() = rows * stacked_;
    };
    fill(rows_[i].xhat, said[i].xhat);
    fill(rows_[i].what, said[i].what);
    fill(rows_[i].fhat, said[i].fhat);
    fill(rows_[i].innovation, said[i].innovation);
  }
}

}  // namespace vigil::observer
