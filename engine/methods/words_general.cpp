/// Of the methods and detectors that serve every family.
#include "engine/methods/words.hpp"

namespace vigil {
namespace {

MethodWords local_ekf() {
  return {
      .id = "local_ekf",
      .line = "An ordinary extended Kalman filter at every node, which hears nobody",
      .model =
          "`x+ = f(x, u) + w`, `w ~ N(0, Q)`; node i reads `z_i = h_i(x) + v_i`, `v_i ~ N(0, R_i)`. Each node filters "
          "its own reading alone: no consensus, no inflation, no guard (specification (consensus), section 9, "
          "`isolated`).",
      .steps =
          {"Predict: `x- = f(x, u)`, `P- = F P F' + Q`, `F` the Jacobian of `f` at the last estimate.",
           "Innovation `r = z - h(x-)` with angles wrapped, `S = H P- H' + R`, `H` the Jacobian of `h` at `x-`; "
           "channels that gave nothing are left out.",
           "`K = P- H' S^-1` by Cholesky, `x = x- + K r`, `P` in Joseph's form. Without any channel the prediction "
           "stands."},
      .cost =
          "O(n^3 + n^2 p + p^3) a node and tick, with n states and p channels of a sensor; N nodes cost N times "
          "that. Nothing is sent.",
  };
}

MethodWords centralized_ekf() {
  return {
      .id = "centralized_ekf",
      .line = "One extended Kalman filter over all sensors, which uses no channel: the attack-free lower bound",
      .model =
          "The model of `local_ekf` with all readings at hand in one place, beginning at the first node's initial "
          "estimate. No message is sent, so no attack on a link reaches it (specification (consensus), section 9, "
          "`centralized`).",
      .steps = {"Predict as `local_ekf` does.", "Linearise every sensor at the same prediction.",
                "With `gate` set, leave out a sensor whose `r' S^-1 r` lies above that quantile of its chi-square law.",
                "Condition on one sensor after the other: `R` is block-diagonal, so this is the stacked update with "
                "small matrices."},
      .cost = "O(n^3) for the prediction and O(N (n^2 p + n^3 + p^3)) for N sensors of p channels a tick.",
  };
}

MethodWords dead_reckoning() {
  return {
      .id = "dead_reckoning",
      .line = "The known input integrated, no reading used: what any sensor must beat",
      .model =
          "`x+ = f(x, u)`, `P+ = F P F' + Q` from the initial estimate on; on the plant of seed 001, stable and with "
          "a known start, this is PRED, `xhat(k) = Abar^k x0` (specification (sparse), section 13).",
      .steps = {"Predict. Nothing else: no reading and no message is heard, and no attack on either meets it."},
      .cost = "O(n^3) a tick and output, for the covariance; the estimate alone is O(n^2).",
  };
}

MethodWords chi_square() {
  return {
      .id = "chi_square",
      .line = "The normalised innovation squared, over a window, against a chi-square quantile",
      .model =
          "Without attack `r ~ N(0, S)`, so that `r' S^-1 r` follows a chi-square law of p degrees of freedom, and "
          "the sum over t independent ones a law of t p (Mehra and Peschon, 1971). `S` is the lane's own.",
      .steps =
          {"Add `r' S^-1 r` to a ring of the last `window` ones; an innovation whose `S` is not positive definite is "
           "not judged.",
           "Once the ring is full: alarm where the sum exceeds the `1 - alpha` quantile of the chi-square law of "
           "`window` times p degrees of freedom."},
      .cost = "O(p^3 + t) an innovation of p channels, t the window.",
  };
}

MethodWords cusum() {
  return {
      .id = "cusum",
      .line = "A cumulative sum of normalised innovations squared: finds what is small and lasts",
      .model =
          "`C <- max(0, C + (r' S^-1 r - p) / sqrt(2 p) - drift)` after Page (1954): without attack the middle term "
          "has mean 0 and variance 1, so drift and threshold are in standard deviations of it.",
      .steps = {"With `restart`, set `C` to zero where it stood above the threshold.", "Add the innovation's term.",
                "Alarm where `C` exceeds `threshold`."},
      .cost = "O(p^3) an innovation of p channels.",
  };
}

MethodWords dynamic() {
  return {
      .id = "dynamic",
      .line = "The mean energy of the innovation against a threshold that follows it",
      .model =
          "`xi_k = (1/t) sum r' r` over the last t innovations, and `theta = mean + eta std` of tau values of `xi`, "
          "moved only by `iota` or more (seed 003, eqs. (25)-(28)), on the innovation of any lane.",
      .steps = {"Energy `r' r`, zero below 1e-14; `xi` is the mean of the last `window` ones.",
                "`threshold` frozen: the window holds the last `tau` values of `xi` that were not flagged, before this "
                "one, and the threshold does not move after a flag. `threshold` printed: the last `tau` ones, this one "
                "included.",
                "The candidate becomes the threshold where it differs from the one held by `iota` or more.",
                "Alarm where `xi` exceeds it; a tick without an innovation is held and never flagged."},
      .cost =
          "O(p + t + tau) an innovation: mean and deviation in two passes over the window, since a running sum of "
          "squares cancels.",
      .corrected =
          {Correction{"The threshold of (27)-(28) un-flags itself: for a lasting step and `iota` 0 the flag is up for "
                      "fewer than `tau / (1 + eta^2 tau/(tau-1))` samples (specification (replay), sections 0 and 5). "
                      "Freezing it while flagged is the repair.",
                      "threshold", "printed"},
           Correction{"(25) has `r_k` inside a sum over i; it is `r_i' r_i` (specification (replay), section 5)."},
           Correction{"The window length t is never given; 5 by default (specification (replay), section 5)."}},
  };
}

MethodWords fixed() {
  return {
      .id = "fixed",
      .line = "The mean energy of the innovation against one threshold, given or learned",
      .model =
          "`xi_k = (1/t) sum r' r` as in `dynamic` (seed 003, eq. (25)), against a level given, or against the "
          "largest `||r||^2` of ticks 3 to 49 (specification (replay), section 5).",
      .steps = {"`xi` as in `dynamic`.",
                "Alarm where `xi` exceeds `level`; where none is given, from tick 50 on, the largest energy that was "
                "learned."},
      .cost = "O(p + t) an innovation.",
      .corrected = {Correction{
          "The source compares its \"fixed threshold sup ||r||\" with `xi`, a squared quantity; here "
          "it is the largest squared norm (specification (replay), section 5). The unsquared one "
          "is a choice of `mixed_filter`."}},
  };
}

const WordsRegistration methods("any scenario", {local_ekf(), centralized_ekf(), dead_reckoning()});
const WordsRegistration detectors("any lane with an innovation", {chi_square(), cusum(), dynamic(), fixed()});

}  // namespace
}  // namespace vigil
