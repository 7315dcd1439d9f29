#include "engine/methods/replay/mixed_filter.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace vigil::replay {
namespace {

constexpr int kShownStates = 4;  ///< covariance and shape are signals up to this many states

Threshold threshold_of(const std::string& text) {
  if (text == "frozen") return Threshold::frozen;
  if (text == "fixed_norm") return Threshold::fixed_norm;
  return text == "fixed_square" ? Threshold::fixed_square : Threshold::printed;
}

DetectorSettings detector_settings(const Params& params) {
  return {params.integer("window"), threshold_of(params.text("threshold")),
          params.integer("tau"),    params.real("eta"),
          params.real("iota"),      params.text("dead_band") == "held" ? DeadBand::held : DeadBand::raw_step};
}

double zeta_max(const Params& params) {
  return params.given("zeta_max") ? params.real("zeta_max") : std::numeric_limits<double>::infinity();
}

Watermark watermark_of(const Params& params, const Knowledge& knowledge) {
  const std::string text = params.text("watermark");
  if (text != "none" && knowledge.monitor)
    throw InputError("/watermark",
                     "watermark is \"" + text + "\" and the path is monitor; expected none, or the path loop", "none");
  if (text == "control" && knowledge.plant->inputs() == 0)
    throw InputError("/watermark", "watermark is \"control\" and the plant has no input; expected none or sensor",
                     "none, sensor");
  return text == "sensor" ? Watermark::sensor : (text == "control" ? Watermark::control : Watermark::none);
}

/// The cost must not be identically zero.
double checked_mu(const Params& params, const System& system) {
  const double mu = params.real("mu");
  if (mu == 1 && system.P.isZero(0) && system.R.isZero(0))
    throw InputError("/mu",
                     "mu is 1 and there is no random noise (P = R = 0): the cost is identically zero; expected mu < 1",
                     "< 1");
  if (mu == 0 && system.Mw.isZero(0) && system.Mv.isZero(0))
    throw InputError(
        "/mu", "mu is 0 and there is no bounded noise (Mw = Mv = 0): the cost is identically zero; expected mu > 0",
        "> 0");
  return mu;
}

const char* word(Corner corner) {
  if (corner == Corner::infinite) return "zeta = inf";
  return corner == Corner::zero ? "zeta = 0" : "none";
}

}  // namespace

MixedFilter::MixedFilter(const Params& params, const Knowledge& knowledge)
    : system_(read_system(knowledge)),
      ids_(knowledge.nodes),
      start_(system_),
      update_(system_.C, system_.R, system_.Mv, checked_mu(params, system_), zeta_max(params)),
      first_(start_.batch().error(system_.P, system_.R, system_.Mw, system_.Mv)),
      schedule_(Schedule::make(system_, update_, first_)),
      by_innovation_(params.text("residual") == "innovation"),
      monitor_(knowledge.monitor),
      watermark_(watermark_of(params, knowledge)),
      amplitude_(params.real("amplitude")),
      sensor_key_(knowledge.seed, "watermark.sensor"),
      control_key_(knowledge.seed, "watermark.control"),
      detector_(detector_settings(params)),
      x_(knowledge.estimates.col(0)),
      predicted_(x_),
      bounds_(first_),
      spread_(first_.Q + first_.M),
      input_(Eigen::VectorXd::Zero(system_.B.cols())),
      heard_(Eigen::VectorXd::Zero(system_.channels())),
      residual_(heard_) {
  if (!schedule_)
    throw InputError("/", named("R", system_.R) + " and " + named("Mv", system_.Mv) +
                              ": the innovation matrix C W C' + S is not invertible, as what the sensor says is "
                              "certain already; expected noise in every channel");
}

void MixedFilter::declare(SignalScope& scope) {
  const int n = system_.states();
  for (int c = 0; c < system_.channels(); ++c) {
    const int id = scope.add(0, "residual.y" + std::to_string(c + 1), "", SignalKind::scalar);
    if (residual_slot_ < 0) residual_slot_ = id;
  }
  zeta_slot_ = scope.add(0, "zeta", "", SignalKind::scalar);
  if (n > kShownStates) return;
  for (const char* set : {"covariance", "shape"}) {
    for (int a = 1; a <= n; ++a) {
      for (int b = a; b <= n; ++b) {
        const int id = scope.add(0, fmt::format("{}.x{}.x{}", set, a, b), "", SignalKind::scalar);
        if (sets_slot_ < 0) sets_slot_ = id;
      }
    }
  }
}

void MixedFilter::emit(int /*node*/, const Eigen::VectorXd& reading, const Eigen::VectorXd& /*input*/,
                       Eigen::VectorXd& sent) {
  sent = reading;
  if (watermark_ != Watermark::sensor) return;
  for (Eigen::Index c = 0; c < sent.size(); ++c)
    sent[c] += amplitude_ * sensor_key_.normal(k_ + 1, static_cast<std::uint32_t>(c));  // leaves before predict()
}

void MixedFilter::unmark(Eigen::VectorXd& reading) const {
  if (watermark_ != Watermark::sensor) return;
  for (Eigen::Index c = 0; c < reading.size(); ++c)
    reading[c] -= amplitude_ * sensor_key_.normal(k_, static_cast<std::uint32_t>(c));
}

void MixedFilter::mark_input(std::int64_t k, Eigen::Ref<Eigen::VectorXd> u) {
  if (watermark_ != Watermark::control) return;
  for (Eigen::Index i = 0; i < u.size(); ++i)
    u[i] += amplitude_ * control_key_.normal(k, static_cast<std::uint32_t>(i));
}

void MixedFilter::predict(const Eigen::VectorXd& input, FaultReport& /*report*/) {
  ++k_;
  input_ = input;
  if (!ready()) return;
  predicted_.noalias() = system_.A * x_;
  predicted_.noalias() += system_.B * input_;
  x_ = predicted_;
}

void MixedFilter::measure(const Readings& readings, FaultReport& report) {
  heard_ = readings.front();
  unmark(heard_);
  if (ready()) {
    correct(heard_, report);
  } else if (const auto estimate = start_.take(input_, heard_)) {
    begin(*estimate);
  }
}

void MixedFilter::begin(const BoundedVector& estimate) {
  x_ = predicted_ = estimate;
  started_at_ = k_;
  bounds_ = first_;
  spread_ = bounds_.Q + bounds_.M;
}

/// Theorem 2. A missing reading leaves the prediction, and from there on the gains are computed on line.
void MixedFilter::correct(const Eigen::VectorXd& reading, FaultReport& report) {
  const bool heard = reading.allFinite();
  const GainChoice* planned = heard && on_schedule_ ? schedule_->step(k_ - started_at_) : nullptr;
  std::optional<GainChoice> computed;
  if (planned == nullptr) {
    on_schedule_ = false;
    time_update(system_.A, system_.P, system_.Mw, bounds_);
    if (heard) computed = update_.update(bounds_.Q, bounds_.M);
    if (!computed) {
      spread_ = bounds_.Q + bounds_.M;
      if (std::string* text = report.fault(0, heard ? "no_gain" : "no_reading"))
        *text = heard ? "the innovation matrix is not invertible; the reading was not used"
                      : "no finite reading; the prediction stands and nothing is judged";
      return;
    }
    planned = &*computed;
  }
  BoundedVector innovation(reading.size());
  innovation.noalias() = reading - system_.C * predicted_;
  x_.noalias() += planned->K * innovation;
  bounds_ = {planned->Q, planned->M};
  spread_ = bounds_.Q + bounds_.M;
  zeta_ = planned->zeta;
  if (x_.allFinite()) return;
  if (std::string* text = report.stop(0, "diverged")) *text = "the estimate is no longer finite";
}

/// The residual is that of what arrived: for the path monitor not what the estimator heard, (29).
void MixedFilter::judge(const Readings& arrived, FaultReport& /*report*/) {
  judged_ = ready() && k_ > started_at_;
  if (!judged_) return;
  residual_ = arrived.front();
  unmark(residual_);
  residual_.noalias() -= system_.C * (by_innovation_ ? predicted_ : x_);
  judged_ = residual_.allFinite();
  verdict_ = judged_ ? detector_.judge(k_, residual_) : detector_.hold();
}

Belief MixedFilter::belief(int /*output*/) const { return {.mean = x_.data(), .covariance = spread_.data()}; }

Detection MixedFilter::detection(int /*output*/) const {
  Detection detection;
  if (!ready() || k_ <= started_at_) return detection;
  if (verdict_.has_statistic) detection.statistic = verdict_.statistic;
  if (verdict_.has_threshold) detection.threshold = verdict_.threshold;
  detection.judged = judged_ && verdict_.has_statistic && verdict_.has_threshold;
  detection.alarm = verdict_.flag;
  return detection;
}

void MixedFilter::publish(std::span<double> values) const {
  if (!ready()) return;
  const auto put = [&](int slot, double value) { values[static_cast<std::size_t>(slot)] = value; };
  for (Eigen::Index c = 0; judged_ && c < residual_.size(); ++c)
    put(residual_slot_ + static_cast<int>(c), residual_[c]);
  put(zeta_slot_, zeta_);
  if (sets_slot_ < 0) return;
  int slot = sets_slot_;
  for (const BoundedMatrix* set : {&bounds_.Q, &bounds_.M}) {
    for (Eigen::Index a = 0; a < set->rows(); ++a) {
      for (Eigen::Index b = a; b < set->cols(); ++b) put(slot++, (*set)(a, b));
    }
  }
}

Json MixedFilter::design() const {
  const GainChoice& steady = schedule_->last();
  return {{"K", to_json(Eigen::MatrixXd(steady.K))},
          {"zeta", std::isfinite(steady.zeta) ? Json(steady.zeta) : Json(nullptr)},
          {"corner", word(steady.corner)},
          {"blind", steady.corner == Corner::infinite && !by_innovation_ && !monitor_},
          {"longest_step_flag", longest_step_flag(detector_.settings().tau, detector_.settings().eta)}};
}

std::vector<std::string> MixedFilter::warnings() const {
  std::vector<std::string> warnings;
  const DetectorSettings& s = detector_.settings();
  if (detector_.blind() && !monitor_)  // a monitor's residual is zero until what arrives is not what was sent
    warnings.emplace_back("residual identically zero: detector blind (the optimal gain is C^-1, whatever is replayed)");
  if (s.threshold == Threshold::printed && !can_rise(s.tau, s.eta))
    warnings.push_back(
        fmt::format("with tau {} and eta {:g} the printed threshold can never flag a step", s.tau, s.eta));
  return warnings;
}

void MixedFilter::retune(const Params& params) {
  amplitude_ = params.real("amplitude");
  detector_.retune(detector_settings(params));
}

}  // namespace vigil::replay
