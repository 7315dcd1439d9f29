#include "engine/methods/words.hpp"

namespace vigil {
namespace {

std::vector<Correction> of_estimator() {
  return {
      {"The printed optimum is `K = C^-1`, zeta infinite, in scenarios 2 and 3, so that the residual is identically "
       "zero "
       "and the detector blind; figures 4, 5 and 7 cannot come from it (specification (replay), sections 0 and 4.5). A "
       "bound `zeta_max` is the repair.",
       "zeta_max", nullptr},
      {"The cost is said to be convex in zeta; it is not, but it is in sigma, where the optimum is sought (section "
       "4.5)."},
      {"(12) and (23) have a gain `G* C'` with an inverse of `C'(.)C`, which is singular for p < n and restricted for "
       "p > "
       "n; `K(sigma) = W C' (C W C' + S)^-1` is the same for an invertible C and right for all (section 4.5)."},
      {"(5)-(7) write the noise terms inside the estimate; they are the two parts of its error, and only the point is "
       "computed (section 4.4)."},
      {"`xh_0 = x_0` and no `M_0`, `Q_0` are given: the batch of (2)-(3) starts the filter, its error sets are exact "
       "consequences of (1) and (3) (section 4.3). The printed `H` carries a transpose on a row of blocks; it is the "
       "stacked column (section 4.1)."},
  };
}

std::vector<Correction> of_mixed() {
  std::vector<Correction> all = of_estimator();
  const std::vector<Correction> more = {
      {"The printed residual is that after the update, `y - C xh`, which is zero with the gain above; the innovation "
       "is the "
       "other choice (sections 0 and 5).",
       "residual", "posterior"},
      {"The threshold of (27)-(28) un-flags itself within a few samples of a lasting step (sections 0 and 5); frozen "
       "it "
       "does not.",
       "threshold", "printed"},
      {"theta_{k-1} in the dead-band is read as the threshold held; comparing successive candidates lets it stay "
       "behind a "
       "slow ramp (section 5). Both are choices.",
       "dead_band", "raw_step", Reading::other},
      {"The fixed threshold `sup ||r||` is compared with a squared quantity in the source; the largest norm and its "
       "square "
       "are both choices (section 5).",
       "threshold", "fixed_norm"},
      {"(25) has `r_k` inside a sum over i; it is `r_i' r_i`. The window length t is never given: 5 (section 5)."},
      {"(30)-(31) conclude that replayed noise keeps the statistic up. The residual of a loop fed with replayed data "
       "is "
       "that of a shifted copy of itself, so a replay is stealthy in the method as written (section 7.2); the keyed "
       "watermark is an addition."},
  };
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

MethodWords mixed_filter() {
  return {
      .id = "mixed_filter",
      .line = "One gain for Gaussian-like and for bounded noise, with a residual-energy detector and a keyed watermark",
      .model =
          "`x+ = A x + B u + w + d`, `y = C x + v + f`, (1): d, f random with covariances P, R; w, v in ellipsoids Mw, "
          "Mv. "
          "The error has a random part of covariance `Q` and a bounded part in the ellipsoid `M`; the gain minimises "
          "`J = "
          "mu tr Q + (1 - mu) tr M`, with `M = (1 + zeta) X Mp X' + (1 + 1/zeta) K Mv K'`, `X = I - K C` (seed 003, "
          "eqs. "
          "(5)-(24)). Statistic and threshold by (25)-(28). Specification (replay), sections 4 to 7.",
      .steps =
          {"Start: unbiased FIR batch over the first n readings, `xh = G H' (Y - E U) + BN U`, (2)-(3), with its exact "
           "error sets.",
           "Time: `xp = A xh + B u`; `Qp = A Q A' + P`; `Mp` the minimum-trace sum of `A M A'` and `Mw`.",
           "Gain: with `sigma = 1/(1 + zeta)`, `W = mu Qp + (1 - mu) Mp/sigma`, `S = mu R + (1 - mu) Mv/(1 - sigma)`, "
           "`K(sigma) = W C' (C W C' + S)^-1`. The optimum is the zero of `tr(K Mv K')/(1 - sigma)^2 - tr(X Mp "
           "X')/sigma^2`, which does not decrease; at the ends `K = 0` or `K = C^-1`. No gain depends on a reading: "
           "they "
           "are made once.",
           "Take the sensor's mark off what arrived; `xh = xp + K (y - C xp)`.",
           "Detector: `xi` is the mean of `r' r` over the last `window` residuals; flag where it exceeds the threshold "
           "`mean + eta std` of `tau` values of `xi`, moved by `iota` or more; or frozen, or fixed.",
           "On the path `monitor` the estimator hears the true output, and only the residual what arrived, (29)."},
      .cost =
          "A tick: O(n^2 + n p), and O(p + t + tau) of the detector. Once a lane: at most 120 trial gains of O(n^3 + "
          "p^3) a tick "
          "until they no longer change; the same on line after a missing reading.",
      .corrected = of_mixed(),
  };
}

MethodWords ufir_filter() {
  return {
      .id = "ufir_filter",
      .line = "The state anew at every tick from the last N readings, without noise statistics or a prior",
      .model =
          "`x+ = A x + B u + noise`, `y = C x + noise`, of which no covariance is used: an unbiased batch over the "
          "first n samples of a horizon of N, then the recursion of seed 003, eq. (4) (specification (replay), "
          "sections 4.1 and 4.2).",
      .steps =
          {"Batch over the horizon's first n readings: `xh = G H' (Y - E U) + BN U`, `G = (H'H)^-1`, (2)-(3).",
           "For each later reading: `xp = A x + B u_{l-1}`, `G <- (C'C + (A G A')^-1)^-1`, `x <- xp + G C' (y_l - C "
           "xp)`.",
           "A missing reading empties the horizon; predictions stand until n readings have come again."},
      .cost = "O(n^2 p + N n (n + p)) a tick, the gains being made once in O(N n^3).",
      .corrected = {Correction{
                        "(4) prints `B u_l`; with the plant (1) it is `u_{l-1}` (specification (replay), section "
                        "4.2)."},
                    Correction{"The horizon N is not given; 10 by default (section 4.2)."},
                    Correction{
                        "The printed `H` carries a transpose on a row of blocks; it is the stacked column, and the "
                        "\"N_x-th row\" is the last block row (section 4.1)."}},
  };
}

MethodWords gmeekf() {
  return {
      .id = "gmeekf",
      .line = "A Kalman filter whose update minimises the entropy of its errors: a baseline for heavy tails",
      .model =
          "Prediction and reading as one regression `d = Wt x + e`, whitened by `chol(Pp)` and `chol(R)`; the errors' "
          "pairs are weighted by the kernel `exp(-(|e_i - e_j|/beta)^alpha)`. Seed 003 only cites it ([25]); the "
          "algorithm is stated in full in the specification (replay), section 8.1.",
      .steps =
          {"Start as `mixed_filter` does. `xp = A x + B u`, `Pp = A P A' + P_d`, `P_d` the covariance of the process "
           "noise.",
           "Fixed point, at most 50 times: errors `e = d - Wt x`, weights `Phi_ij = |e_i - e_j|^(alpha-2) exp(-(|e_i - "
           "e_j|/beta)^alpha)`, `Psi` the diagonal of its row sums.",
           "`Lam = Psi'Psi + Phi'Phi` (`square`) or `Psi - Phi` (`diff`), `K` from the weighted least squares, `x = xp "
           "+ K (y - C xp)`; stop where it moves by 1e-6 of itself. One that does not settle is kept and counted.",
           "`P = (I - K C) Pp (I - K C)' + K R K'`."},
      .cost = "At most 50 iterations of O((n + p)^3) a tick.",
      .corrected = {Correction{
          "The source gives no kernel parameters: alpha = 2, beta = 2, form `square` (specification "
          "(replay), section 8.1). Every figure of merit depends on them."}},
  };
}

MethodWords zonotope_watermark() {
  return {
      .id = "zonotope_watermark",
      .line =
          "A smart sensor sends its residual, turned and marked in secret; the receiver asks whether it can be healthy",
      .model =
          "Bounded noise in boxes; the error lies in a zonotope `<0, H>`, and a healthy residual in `<0, Z>`, `Z = [C "
          "Hp, Hv]`. The sensor sends `s = E z + m` with a secret rotation `E` and a secret mark `m`. Seed 003 only "
          "cites it ([26]); reconstructed from its abstract in the specification (replay), section 8.2.",
      .steps =
          {"`Hp = [A H, Hw]`, `K = Hp Hp' C' (C Hp Hp' C' + Hv Hv')^-1`, `H = reduce([(I - K C) Hp, K Hv])` to `order` "
           "generators; made without a reading.",
           "Sensor: `z = y - C xp` of its own estimate, which it updates; sends `E z + m`, `m` uniform in a box of "
           "`rho` half widths of the healthy set.",
           "Receiver: `E' (s - m)`; alarm where it lies outside `<0, Z>`, judged exactly (by the generators' normals "
           "for p = 2, by a linear program beyond).",
           "Without alarm `xh = xp + K z`, with one the prediction stands."},
      .cost =
          "O(n^2 order + order log order) a tick for the zonotope of one sensor, and O(order^2) for membership with p "
          "= "
          "2.",
      .corrected = {Correction{
          "The mark's size is not given: `rho` half widths, and with 0 nothing can be detected, as a "
          "rotation keeps the norm (specification (replay), section 8.2)."}},
  };
}

const WordsRegistration registration("replay (seed 003)",
                                     {mixed_filter(), ufir_filter(), gmeekf(), zonotope_watermark()});

}  // namespace
}  // namespace vigil
