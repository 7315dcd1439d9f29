#include "engine/methods/words.hpp"

namespace vigil {
namespace {

std::vector<Correction> corrected() {
  return {
      {"gamma are in no list of given scalars, and minimising them alone is ill-posed: the infimum is 0 with infinite "
       "gains. Bounds on `P`, a price on large gains and a margin make the problem well posed (specification "
       "(observer), "
       "sections 5 and 6); what the source did is not known."},
      {"kappa is printed as a given scalar, which ties feasibility to varsigma although the observer does not depend "
       "on "
       "it. The source's value is used where the plant has one, a variable where it has none (section 5).",
       "free_kappa", false},
      {"The printed gains are stable and certified, but do not estimate the attacks; four digits are too few to work "
       "with "
       "(section 8.1).",
       "gains", "printed"},
      {"`K2^+` is called a pseudo-inverse; the matrix of (5) is a left inverse, not that of Moore and Penrose where p "
       "> g. "
       "The closed form is used (section 2)."},
      {"The derivative printed before (9) ends with `+ E2 y' - E2 y`; the last term is `- E2 y'`, so that nothing is "
       "differentiated (section 2)."},
      {"(19) and (22) carry a spurious factor 2, and \"(26) is sufficient\" is reversed; neither touches (17) (section "
       "5)."},
      {"mu is said to add freedom to the design; it only scales `L` (section 4). It is kept as a parameter."},
      {"Assumption 2 is stronger than needed: the check of a system of one's own is that `([A2 D2; 0 0], [C1 0])` is "
       "detectable (section 1). Nor is a bound on the fault's rate needed."},
      {"Initial values of the observer are not given: zeros (section 3). Integrator and step are not given: classical "
       "Runge-Kutta with a step that the fastest pole allows (section 7)."},
  };
}

MethodWords intermediate_observer() {
  return {
      .id = "intermediate_observer",
      .line =
          "State, attack on the actuator and sensor fault estimated together in every subsystem, gains from a linear "
          "matrix inequality",
      .model =
          "`x_i' = A_i x_i + B_i u_i + F_i Phi_i(x_i) + D_i w_i + Dd_i d_i - alpha_i sum_j H_ij x_j`, `y_i = C_i x_i + "
          "G_i "
          "f_i`, (1). With `xi1 = [x; f]`, (2)-(6), and `theta = w - N (xi1 - E2 y)`, `N = varsigma D2'`, the observer "
          "of "
          "(9)-(13) estimates `xi1` and `theta`; `what = thetahat + N xi2hat`, (11). Theorem 1, (17), bounds the "
          "errors by "
          "`int |e|^2 <= sum gamma_d^2 int |d|^2 + gamma_w^2 int |w'|^2`. Numbers are those of seed 002; specification "
          "(observer), sections 1 to 6.",
      .steps =
          {"Once: minimise `sum cd gamma_d^2 + cw gamma_w^2 + cnu nu` subject to `Sigma <= -eps I`, `pmin I <= P "
           "<= pmax "
           "I`, `L'PL <= nu I` and, with `rmax`, local poles right of `-rmax`; `L = P^-1 W`. The answer is accepted "
           "only on a "
           "certificate computed anew: `Sigma`, `P` and the poles of the whole network's errors.",
           "`xi1hat = xi2hat + E2 y`, (12); innovation `y - C1 xi1hat`, (13). Hand `xi1hat` to the neighbours.",
           "`core = A2 xi1hat + B2 u + F2 Phi(xhat) + D2 what + J2 y - alpha sum_j H2_ij xi1hat_j`.",
           "`xi2hat' = core + mu L1 inn`, (9); `thetahat' = -N core + mu L2 inn`, (10), integrated together with "
           "the plant "
           "by Runge-Kutta of order four.",
           "`structure` classical: no innovation in `thetahat'`. `gains` riccati: one Riccati equation a "
           "subsystem instead "
           "of the inequality."},
      .cost =
          "A stage of the integrator is one product with a stacked map, at most O((sum n)^2) with n the states of an "
          "observer. The synthesis, once: more than m (m + 1)/2 + m p unknowns for a subsystem of m error "
          "states and p outputs, in a time that grows like k^3 with k subsystems in a ring; above 1000 unknowns it is "
          "refused.",
      .corrected = corrected(),
  };
}

MethodWords matched_observer() {
  return {
      .id = "matched_observer",
      .line = "The unknown-input observer that needs `rank(C D) = rank(D)`: what the intermediate one is compared with",
      .model =
          "`T = I - D (CD)^+ C`, `z' = T (A xhat + B u - alpha sum_j H_ij xhat_j) + L (y - C xhat)`, `xhat = z + D "
          "(CD)^+ y`; the attack is what of the filtered derivative of y the model does not explain. It exists where "
          "`rank(C D) = rank(D)` (specification (observer), section 8.2).",
      .steps =
          {"Once: gains by the inequality of `intermediate_observer` with `T A + I` in place of its matrix, a decay "
           "rate of at least 1/s, without gamma.",
           "`xhat` and `z'` as above, of every subsystem, integrated together with the plant.",
           "`what = (CD)^+ (ydf - C (A xhat + B u - alpha sum_j H_ij xhat_j))`, `ydf = s' = (y - s)/Tf`, `Tf` 0.01 s.",
           "Where the matching condition is violated `(CD)^+` is zero, no attack is estimated, and the lane warns."},
      .cost =
          "As `intermediate_observer`: O((sum n)^2) a stage of the integrator, with n + p states an observer, and "
          "fewer unknowns in its synthesis.",
      .corrected = {Correction{
          "The source's reference [24] was not available: this is the standard observer with the same "
          "condition of existence, not a copy of it (specification (observer), section 8.2)."}},
  };
}

const WordsRegistration registration("observer (seed 002)", {intermediate_observer(), matched_observer()});

}  // namespace
}  // namespace vigil
