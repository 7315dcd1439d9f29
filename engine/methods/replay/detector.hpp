/// Residual energy over a window against a threshold. Seed 003, eqs. (25)-(28); specification (replay), section 5.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace vigil::replay {

/// printed: mean + eta std of the last tau statistics, this one included. frozen: of the last tau unflagged ones before
/// it, held while flagged. fixed_norm, fixed_square: the largest ||r|| resp. ||r||^2 of ticks 3..49.
enum class Threshold : std::uint8_t { printed, frozen, fixed_norm, fixed_square };

/// What a new candidate is compared with: the threshold held, or the candidate before it.
enum class DeadBand : std::uint8_t { held, raw_step };

struct DetectorSettings {
  int window = 5;  ///< t >= 1, residuals
  Threshold threshold = Threshold::printed;
  int tau = 20;     ///< >= 2, statistics
  double eta = 2;   ///< >= 0
  double iota = 0;  ///< >= 0, dead-band, in units of the statistic
  DeadBand dead_band = DeadBand::held;
};

struct Verdict {
  bool has_statistic = false, has_threshold = false, flag = false;
  double statistic = 0, threshold = 0;  ///< xi, theta; squared units of the residual (fixed_norm: of its norm)
};

/// Value semantics; memory is taken when made, judging allocates nothing.
class EnergyDetector {
 public:
  explicit EnergyDetector(const DetectorSettings& settings);

  /// The residual of tick k (1, 2, ... as in the paper; read by the fixed thresholds only). One that is not finite is
  /// held. Energies below 1e-14 count as zero, those above 1e150 as that much.
  Verdict judge(std::int64_t k, const Eigen::Ref<const Eigen::VectorXd>& residual);
  /// A tick without a residual: nothing moves, no statistic, no flag; the threshold is the one held.
  Verdict hold() const;

  /// Takes new settings. Windows start afresh where t or tau changed, the threshold where its kind did.
  void retune(const DetectorSettings& settings);

  /// At least tau residuals were judged and all were zero: whatever is replayed, nothing can be flagged.
  bool blind() const { return residuals_ >= settings_.tau && !seen_energy_; }
  std::int64_t residuals() const { return residuals_; }  ///< judged so far
  const DetectorSettings& settings() const { return settings_; }

 private:
  /// The last so many values, in no order.
  struct Ring {
    std::vector<double> values;
    std::size_t count = 0, next = 0;
    void restart(int size);
    void push(double value);
    bool full() const { return count == values.size(); }
    double mean() const;
  };
  bool fixed() const { return settings_.threshold >= Threshold::fixed_norm; }
  void learn(std::int64_t k, double energy);
  void follow();
  double candidate() const;

  DetectorSettings settings_;
  Ring energies_, statistics_;
  double threshold_ = 0, last_candidate_ = 0;
  double largest_ = 0;  ///< energy of ticks 3..49
  bool has_threshold_ = false, learned_ = false, flagged_ = false, seen_energy_ = false;
  std::int64_t residuals_ = 0;
};

/// Whether the printed threshold can flag a step at all: eta^2 < (tau - 1)^2 / tau.
bool can_rise(int tau, double eta);

/// For how many samples the printed threshold flags a lasting step, dead-band zero: the largest whole q below
/// tau / (1 + eta^2 tau / (tau - 1)).
int longest_step_flag(int tau, double eta);

}  // namespace vigil::replay
