#include "engine/methods/privacy/unprotected.hpp"

#include "engine/methods/privacy/eavesdroppers.hpp"
#include "engine/methods/privacy/start.hpp"

namespace vigil::privacy {
namespace {

class Unprotected final : public Protection {
 public:
  explicit Unprotected(const Knowledge& knowledge) : knowledge_(knowledge), moment_(knowledge) {}
  std::unique_ptr<Protection> clone() const override { return std::make_unique<Unprotected>(*this); }
  void encode(const PublicTick& tick, Eigen::MatrixXd& /*messages*/) override {
    if (tick.k > 0) moment_.step(tick.input);
  }
  std::unique_ptr<Eavesdropper> eavesdropper(const std::string& variant) const override {
    if (variant == "zero") return zero_eavesdropper(knowledge_.plant->states());
    return fusing_eavesdropper(knowledge_);
  }
  double eavesdropper_trace(const PublicTick& tick, const std::string& variant) const override {
    if (variant == "fusing") return tick.nominal.P.trace();
    if (variant == "zero" && moment_.known()) return moment_.second().trace();
    return Protection::eavesdropper_trace(tick, variant);
  }

 private:
  Knowledge knowledge_;
  StateMoment moment_;
};

}  // namespace

std::unique_ptr<Protection> unprotected(const Knowledge& knowledge) { return std::make_unique<Unprotected>(knowledge); }

}  // namespace vigil::privacy
