#include "engine/methods/privacy/secrecy_eavesdropper.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace vigil::privacy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStop = 1e150;  // a path beyond it goes no further: numbers must stay finite

class CodeAListener final : public Eavesdropper {
 public:
  explicit CodeAListener(const FusionModel& model)
      : A_(model.A), x_(model.x0.replicate(1, model.count())), next_(x_), estimate_(model.x0) {}
  std::unique_ptr<Eavesdropper> clone() const override { return std::make_unique<CodeAListener>(*this); }

  void listen(const PublicTick& tick, const MatrixXd& messages, std::span<const char> heard) override {
    if (tick.k > 0)
      next_.noalias() = A_ * x_;
    else
      next_ = x_;
    for (Eigen::Index i = 0; i < x_.cols(); ++i) {
      if (!heard[static_cast<std::size_t>(i)]) continue;
      if (tick.k == 0) next_.col(i).setZero();  // the first message is not coded
      next_.col(i) += messages.col(i);
    }
    if (next_.norm() < kStop) x_.swap(next_);
    estimate_.noalias() = tick.nominal.W * x_.reshaped();
  }
  const VectorXd& estimate() const override { return estimate_; }

 private:
  MatrixXd A_, x_, next_;  ///< x: states x sensors
  VectorXd estimate_;
};

class CodeLListener final : public Eavesdropper {
 public:
  CodeLListener(const FusionModel& model, std::vector<MatrixXd> Lc, std::optional<RecentMessages> recent)
      : A_(model.A),
        Lc_(std::move(Lc)),
        recent_(std::move(recent)),
        memories_(Lc_.begin(), Lc_.end()),
        follows_(Lc_.size(), 1),
        x_(MatrixXd::Zero(model.states(), model.count())),
        mean_(model.x0),
        before_(model.x0),
        estimate_(model.x0) {
    if (!recent_) return;
    messages_ = VectorXd::Zero(recent_->depth() * model.stacked());
    heard_.assign(static_cast<std::size_t>(recent_->depth() * model.count()), 0);
  }
  std::unique_ptr<Eavesdropper> clone() const override { return std::make_unique<CodeLListener>(*this); }

  void listen(const PublicTick& tick, const MatrixXd& messages, std::span<const char> heard) override {
    if (tick.k > 0) {
      before_ = mean_;
      mean_.noalias() = A_ * before_;
    }
    for (std::size_t i = 0; i < memories_.size(); ++i) {
      if (!heard[i]) follows_[i] = 0;
      if (!follows_[i]) continue;
      memories_[i].advance();
      x_.col(static_cast<Eigen::Index>(i)) = memories_[i].decode(messages.col(static_cast<Eigen::Index>(i)));
    }
    if (recent_ && tick.k > 0) keep(messages, heard);
    const auto following = static_cast<std::size_t>(std::count(follows_.begin(), follows_.end(), 1));
    if (following == follows_.size()) {
      estimate_.noalias() = tick.nominal.W * x_.reshaped();
    } else if (recent_) {
      estimate_ = mean_;
      estimate_.noalias() += gain() * messages_;
    } else if (following == 0) {
      estimate_ = mean_;
    } else {
      fuse_some(tick.P);
    }
  }
  const VectorXd& estimate() const override { return estimate_; }

 private:
  /// The newest messages first, less their means.
  void keep(const MatrixXd& messages, std::span<const char> heard) {
    const auto n = x_.rows(), stacked = x_.size();
    std::rotate(heard_.begin(), heard_.end() - x_.cols(), heard_.end());
    std::rotate(messages_.begin(), messages_.end() - stacked, messages_.end());
    std::copy(heard.begin(), heard.end(), heard_.begin());
    for (Eigen::Index i = 0; i < x_.cols(); ++i) {
      const auto sensor = static_cast<std::size_t>(i);
      auto mine = messages_.segment(i * n, n);
      mine.setZero();
      if (!heard[sensor]) continue;
      mine.noalias() = Lc_[sensor] * before_;
      mine += messages.col(i) - mean_;
    }
  }
  const MatrixXd& gain() {
    const auto found = gains_.find(heard_);
    return found != gains_.end() ? found->second : gains_.emplace(heard_, recent_->best(heard_).gain).first->second;
  }
  void fuse_some(const MatrixXd& P) {
    const auto n = x_.rows();
    std::vector<Eigen::Index> rows;
    for (Eigen::Index c = 0; c < x_.size(); ++c) {
      if (follows_[static_cast<std::size_t>(c / n)]) rows.push_back(c);
    }
    estimate_ = fuse(P(rows, rows), static_cast<int>(n)).W * x_.reshaped()(rows);
  }

  MatrixXd A_;
  std::vector<MatrixXd> Lc_;
  std::optional<RecentMessages> recent_;
  std::vector<CodeMemory> memories_;
  std::vector<char> follows_;  ///< it has missed nothing of that sensor
  MatrixXd x_;                 ///< states x sensors, of those
  VectorXd mean_, before_;     ///< of the state, in this tick and in the one before
  VectorXd messages_;          ///< depth x L x states, less their means; zero where not heard
  std::vector<char> heard_;
  std::map<std::vector<char>, MatrixXd> gains_;
  VectorXd estimate_;
};

}  // namespace

std::unique_ptr<Eavesdropper> code_a_listener(const FusionModel& model) {
  return std::make_unique<CodeAListener>(model);
}

std::unique_ptr<Eavesdropper> code_l_listener(const FusionModel& model, const std::vector<MatrixXd>& Lc,
                                              std::optional<RecentMessages> recent) {
  return std::make_unique<CodeLListener>(model, Lc, std::move(recent));
}

}  // namespace vigil::privacy
