/// Of the three mechanisms of seed 004.
#include "engine/methods/words.hpp"

namespace vigil {
namespace {

std::vector<Correction> contamination_corrected() {
  return {{"The printed choice is called optimal; it is a heuristic, and the exact trace finds better sets "
           "(specification (privacy), section 2.2).",
           "mode", "norm"},
          {"Theorem 2.1 asserts a bounded user for every set, which is false; sets that leave it unbounded are "
           "not chosen (section 2.2).",
           "bounded_check", false},
          {"The null space is trivial where `m <= n`, and exact zeros are sent; `null_dim` is reported and the "
           "lane warns (section 2.1)."},
          {"`sum gamma = s0` is written a sensor, but sets are counted over all, and gamma = 1 means kept: m "
           "counts contaminated components over all sensors (section 2.1)."},
          {"(2-30) has `H_i P_ij H_i` and a wrong factor in its third term, (2-31) and (2-43) take `H` of the "
           "wrong time; the recursion used follows from (2-28), (2-29) (section 2.3)."},
          {"(2-26) drops the cross terms between errors and state; the full form is used (section 2.4)."}};
}

MethodWords contamination() {
  return {
      .id = "contamination",
      .line =
          "Some components of the local estimates are replaced by noise that the nominal weights do not let through",
      .model =
          "`h` marks kept components, `H = diag(h)`, `Hb = I - H`, m zeros over all sensors. Sent is `xr = H xhat + Hb "
          "Pi "
          "a`, `a ~ N(0, Q_a I)`, `Pi` the projector on the null space of `W Hb`, (2-14)-(2-20): an eavesdropper that "
          "fuses "
          "has `W H xhat` whatever `a`. The user, who knows `h`, takes `xc = H xr + Hb e p`, `p` its own prediction, "
          "(2-23), "
          "(2-41). Seed 004, chapter 2; specification (privacy), section 2.",
      .steps = {"Choose the set by covariances alone. Linear plant: largest `||H - Hm||`, `Hm = e [Lam (Lam + P_f)^-1] "
                "W` with "
                "`Lam` the state's second moment (`norm`), or the largest exact trace of the eavesdropper (`exact`). "
                "Nonlinear "
                "plant: keep the components known worst, Theorem 2.2, (2-40).",
                "With `bounded_check`, a set is left out if, used at all times, it lets the user's trace grow by more "
                "than 2 % "
                "between steps 200 and 400.",
                "Replace the chosen components by those of `Pi a`. Tick 0 goes as it is.",
                "User: fuse the compensated estimates by their own covariance, (2-30)-(2-33) corrected."},
      .cost =
          "A tick: (n L over m) spectral norms of O((n L)^3) for the choice among the sets of m of n L components "
          "(more than 20000 sets are refused), and O(L^2 n^3) for the user's covariances; neither once all have "
          "settled.",
      .corrected = contamination_corrected(),
  };
}

Correction coverage() {
  return {
      "The theorem counts the difference at the window's last instant alone, but filters remember: later means, "
      "differences of means and the packets are covered less or not at all. Each view's distance `mu` and exact "
      "privacy "
      "loss is reported (section 3.5)."};
}

MethodWords dp_centre() {
  return {
      .id = "dp_centre",
      .line = "Differential privacy of a published mean of fused estimates, the noise added at the centre",
      .model =
          "The centre publishes `xu + a`, `xu` the mean of the last kappa fused estimates. Trajectories are adjacent "
          "if they "
          "differ at one time, in the components of `H`, by at most lambda. With `sigma = ||W KC H||`, `KC` the "
          "stacked `K_i C_i`, and `Gamma = (k "
          "+ "
          "sqrt(k^2 + 2 eps))/(2 eps)`, `k = Qinv(delta)`, a variance of `(Gamma sigma lambda)^2` on every entry makes "
          "it "
          "(eps, delta)-private (seed 004, Theorem 3.1, (3-16)-(3-21); specification (privacy), sections 1.6 and 3.2).",
      .steps =
          {"Once: stationary filters, weights, `sigma`, the variance.",
           "Sensors send in the clear; the user's estimate is the fused one.",
           "Publish the mean of the last kappa (of those there are, at first) plus fresh noise; the eavesdropper takes "
           "that for the state."},
      .cost =
          "O(n) a tick beside the fusion; memory of kappa n numbers. Once: O((n L)^3), and 400 powers of the filters "
          "for the views.",
      .corrected = {Correction{"(3-21) forgets the 1/kappa of the mean: `(Gamma sigma lambda/kappa)^2` is enough, the "
                               "printed variance is kappa^2 times too large (specification (privacy), section 3.2).",
                               "as_printed", true},
                    Correction{
                        "The source confuses standard deviation, variance and their squares; every q is a variance "
                        "here (section 1.6)."},
                    coverage()},
  };
}

MethodWords dp_sensors() {
  return {
      .id = "dp_sensors",
      .line = "The same privacy, the noise shared out among the sensors",
      .model =
          "Sensor i sends `xhat_i + W_i^-1 xi_i`, `xi_i ~ N(0, q_i I)`, so that fusing by the nominal weights gives "
          "the "
          "fused estimate plus `sum xi_i`; `q_i = s_i q_tot`, `q_tot = (Gamma sigma lambda)^2/kappa`, shares of sum 1 "
          "(seed "
          "004, Theorem 3.2, (3-23)-(3-33); specification (privacy), sections 3.2 and 3.3).",
      .steps = {"Once: stationary filters, weights, `q_i`, `Pc = P + blockdiag(q_i G_i G_i')`, `G_i = W_i^-1`.",
                "Sensors add `G_i xi_i` and send.",
                "The public fusion has `P_f + q_tot I` and publishes the mean of its last kappa; the user fuses by the "
                "weights of `Pc`."},
      .cost = "O(L n^2) a tick beside the fusion. Once as `dp_centre`.",
      .corrected =
          {Correction{
               "(3-29) forgets 1/kappa as (3-21) does; the two cancel and (3-27) is right (specification (privacy), "
               "section 3.2)."},
           Correction{
               "(3-32), all noise at one sensor, prints a division by L; the theorem asks for `q = q_tot` (section "
               "3.2)."},
           Correction{
               "Which fused estimate is published is not said; the theorem is about the one by the nominal weights, "
               "the user's own stays inside (section 3.3)."},
           Correction{
               "`W_i` may be singular. A condition of 1e10 or more is refused: with a pseudo-inverse the guarantee "
               "would be void (section 3.3)."},
           Correction{
               "The user is said to lose little whatever kappa, eps and delta. That holds only where nearly all noise "
               "is at one sensor, whose partner then sends in the clear; both settings are a matter of `shares` "
               "(section 3.4)."},
           coverage()},
  };
}

std::vector<Correction> two_step_corrected() {
  return {{"(4-12) sums tq + 1 terms for t > tq and tq before; then the printed decoder (4-18) does not telescope "
           "and the user diverges. tq terms agree with the rest (specification (privacy), section 4.2).",
           "sum", "printed"},
          {"(4-24)-(4-27) add increments as if independent; all but alpha telescope, and the printed formula "
           "over-estimates the eavesdropper's error. The exact one is used (section 4.4)."},
          {"Theorem 4.2, an infinite index, holds for the differencing eavesdropper only: one that takes the "
           "window's mean is bounded. Both can be chosen (section 4.4)."},
          {"That `Pi` depends on `Wc`, and (4-14) being a matrix inequality, are passed over; the order of design "
           "above is not circular, and all sensors share the vector alpha (section 4.1)."},
          {"The guarantee is for one message alone; the exact loss of a later message, of differences and of the "
           "stream is reported beside it (section 4.5)."},
          {"tq, zeta, q_alpha, epsilon and delta are not in the text (section 4.7); they are parameters."}};
}

MethodWords two_step() {
  return {
      .id = "two_step",
      .line =
          "Noisy estimates summed over a moving window, with null-space noise on top: who differences them diverges",
      .model =
          "`xp_i = xhat_i + Rg xi_i`; sent is `s(t) = sum of the last tq xp + Pi alpha(t)`, `Pi` the projector on the "
          "null "
          "space of the user's weights `Wc`, (4-11), (4-12). User: `xf(t) = Wc (s(t) - s(t-1)) + xf(t - tq)`, (4-18), "
          "which "
          "is `Wc xp(t)` at all times. The eavesdropper does the same with the nominal `W` and gathers one more alpha "
          "with "
          "every term (seed 004, (4-11)-(4-29); specification (privacy), section 4).",
      .steps =
          {"Once: `sigma_i = ||K_i C_i H||`, `q_xi,i = (Gamma sigma_i zeta)^2/(tq lambda_min(Rg Rg'))`, `Pp = P + "
           "blockdiag(q_xi Rg Rg')`, `Wc` from `Pp`, `Pi`, and the check (4-14) of every sensor.",
           "Sensors add the first noise, sum over the window, add their rows of `Pi alpha`, and send.",
           "The user telescopes by (4-18). A lost message is its prediction, and that error stays.",
           "The differencing eavesdropper has `tr(W Pp W') + c(t) q_alpha tr(W Pi W')`, `c(t)` growing by 2 every tq "
           "ticks; others take the window's mean, the messages as they are, or zero."},
      .cost = "O((n L)^2) a tick with all matrices made once; memory of tq n L numbers.",
      .corrected = two_step_corrected(),
  };
}

const WordsRegistration registration("privacy (seed 004)", {contamination(), dp_centre(), dp_sensors(), two_step()});

}  // namespace
}  // namespace vigil
