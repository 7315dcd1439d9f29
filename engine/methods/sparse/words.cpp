/// Of the lanes that share a filter over a window: A1 with and without the game, A2, A4, the extension and the
/// unprotected filter.
#include "engine/methods/words.hpp"

namespace vigil {
namespace {

const char* const kWindow =
    "Each node's last T readings are stacked and linearised: `r = Phi dx + E + noise` with blocks `Phi_j = C_j "
    "Abar^j`; "
    "`dx` is the deviation at the window's start and `E` the attack (seed 001, eq. (4)). With `M = I - Q1 Q1'` from "
    "the "
    "QR of `Phi` the state is projected out: `M r = M E + noise` (specification (sparse), section 7). ";

const char* const kPredict =
    "Predict `x- = Abar x`, `P- = Abar P Abar' + Q`, take the reading into the window. A missing reading empties it.";
const char* const kUpdate =
    "Take the newest p entries of `E` off the wrapped innovation; Kalman update in Joseph's form, the covariance as "
    "without an attack. Until the window is full: predict alone (`startup` predict).";

const char* const kPlay =
    "Game: utility of copying j, `U_i(j) = -r ln max(max |E_j|, u_floor) - sum_l ||[E_j != 0] xor [E_l != 0]||_1` over "
    "the neighbours l of i, (7); probabilities `exp(beta (U_i(j) - max U))`, normalised, (9). One draw a node; it "
    "takes "
    "the chosen node's estimate and covariance, all nodes at once.";

/// What every lane with a window carries; `more` is put before it.
std::vector<Correction> with_window(std::vector<Correction> more) {
  const std::vector<Correction> window = {
      {"The text stacks a constant C where it varies: everything is linearised anew along the trajectory through the "
       "present prior (specification (sparse), section 7).",
       "window", "current"},
      {"What happens before the window is full is not said: no measurement update, since the start is known (section "
       "7); "
       "an ordinary update is the other choice.",
       "startup", "update", Reading::other},
      {"The printed azimuth row is divided by the ground range where its square belongs (section 4).",
       "printed_azimuth_row", true},
      {"The printed `y = C (x - xtilde) + ...` is the innovation form: filters use `y - h(prior)` with `atan2` and "
       "wrapped angles, and the last entry of the elevation row is `rho2/rho^2` instead of `rho2^2/rho^2` (section "
       "4)."},
  };
  more.insert(more.end(), window.begin(), window.end());
  return more;
}

Correction stopping() {
  return {
      "The text always takes q T entries, which puts noise into every clean node's support. The Gaussian stopping rule "
      "`||res|| <= kappa sigma sqrt(m + 2 sqrt(m ln m))`, `m = p T - n`, is the default (section 8).",
      "stop", "fixed"};
}

Correction cancelling() {
  return {
      "\"Cancel the current attack\" is read as taking the last p entries of `E` off the innovation, the covariance "
      "update unchanged (section 9)."};
}

std::vector<Correction> game() {
  return {
      {"The printed (7) takes the logarithm of a number that is negative for any realistic attack. Two readings make "
       "sense: supports beside the logarithm (`split`, the default) or inside it (section 9).",
       "form", "inside", Reading::other},
      {"Without any attack found the logarithm has no value: the size is floored at `u_floor`, the sensors' noise, so "
       "that clean nodes tie (section 9)."},
      {"The text swaps predicted pairs; swapping the updated ones and predicting then is the same (section 9)."},
  };
}

MethodWords omp_ekf() {
  return {
      .id = "omp_ekf",
      .line =
          "The attack of a window by orthogonal matching pursuit, taken off a Kalman filter's innovation at each node",
      .model = std::string(kWindow) +
               "`E` is sought sparse, of at most q T entries, by orthogonal matching pursuit (eq. "
               "(6)). This is A1 without its game.",
      .steps =
          {kPredict,
           "Where the window is full: with `res = M r`, pick the entry of largest `|res_j|/sqrt(M_jj)`, solve least "
           "squares on all picked, repeat while the residual exceeds the stopping level and fewer than `min(q T, p "
           "T - n)` are picked.",
           kUpdate},
      .cost =
          "A node and tick: O(p T n^2) for the QR, O((p T)^2 n) for `M`, and O(s^2 p T) for s picked entries of the "
          "pursuit; the filter adds O(n^3 + p^3). Nothing is sent.",
      .corrected = with_window({stopping(), cancelling()}),
  };
}

MethodWords omp_game() {
  std::vector<Correction> corrected = {stopping()};
  for (Correction& one : game()) corrected.push_back(std::move(one));
  corrected.push_back(cancelling());
  return {
      .id = "omp_game",
      .line = "A1: `omp_ekf`, and a potential game in which each node keeps its estimate or copies a neighbour's",
      .model = std::string(kWindow) +
               "`E` is found as in `omp_ekf`, (6). Each node then plays a potential game that "
               "rewards small attacks and supports that agree with the neighbourhood's, (7)-(9).",
      .steps = {kPredict, "Where the window is full, find `E` as `omp_ekf` does.", kUpdate, kPlay},
      .cost =
          "That of `omp_ekf`, and O(d^2) a node for the utilities once the N^2 pairs of supports are compared in O(N^2 "
          "p T). A message carries n numbers; covariance and support are declared beside it.",
      .corrected = with_window(std::move(corrected)),
  };
}

MethodWords omp_game_channels() {
  return {
      .id = "omp_game_channels",
      .line = "Extension: the attack as whole channels, fewest first, then the game of A1",
      .model = std::string(kWindow) +
               "Not in the source: `E` is sought as all samples of at most q whole channels "
               "(section 12).",
      .steps =
          {kPredict,
           "Where the window is full and `||M r||` exceeds the stopping level: for sets K of 1, 2, … q channels fit "
           "all their samples by least squares; stop at the first size at which a set leaves a residual within the "
           "level, and take the least one of that size (the least at size q where none passes).",
           "Set entries below `block_floor` to exactly zero: the game counts entries.", kUpdate, kPlay},
      .cost =
          "A node and tick: O((p T)^2 n) for `M`, and at most the sum over sizes k <= q of (p over k) fits of O((k "
          "T)^3); the game as in `omp_game`.",
      .corrected = with_window(game()),
  };
}

MethodWords l1_ekf() {
  return {
      .id = "l1_ekf",
      .line = "A2: the attack of smallest l1 norm that explains the window exactly, by an interior point",
      .model = std::string(kWindow) +
               "`E = argmin ||E||_1` subject to `Q2' E = Q2' r`, no allowance for noise (seed 001, "
               "Sec. 4; specification, section 10). `E` comes out dense.",
      .steps =
          {kPredict,
           "Where the window is full: `E = u - v`, `u, v >= 0`, by Mehrotra's predictor-corrector; where it stalls, "
           "simplex steps finish from its last iterate. The answer has passed a duality certificate (1e-7 of the "
           "norm), or none is used.",
           "Entries below 1e-6 of the largest count as zero.", kUpdate},
      .cost =
          "A node and tick: the full QR in O((p T)^2 n), then about 15 iterations (60 at most) of O((p T - n)^2 p T). "
          "Nothing is sent.",
      .corrected = with_window({}),
  };
}

MethodWords etpg_ekf() {
  return {
      .id = "etpg_ekf",
      .line = "A4: the attack by projected gradient descent that projects only when the cost has fallen",
      .model = std::string(kWindow) +
               "`V(x, E) = 1/2 ||r - Phi x - E||^2` is brought down by gradient steps in both, `E` "
               "projected on q channels at events (Shoukry and Tabuada 2016, restated in the "
               "specification, section 11, A4; step and trigger constants are the "
               "specification's).",
      .steps =
          {kPredict,
           "Where the window is full: `eta = 1/(||Phi||^2 + 1)`, `g = r - Phi x - E`, `x += eta Phi' g`, `E += eta "
           "g`, at most `max_steps` times, ended early at `V <= 1e-6`.",
           "Event: where the projected `E` brings `V` to `(1 - shrink)` of that of the last event, or after 30 "
           "steps, `E` becomes its projection: the q channels of largest energy (`block`) or the q T largest "
           "entries (`element`). Project once more at the end.",
           kUpdate},
      .cost = "A node and tick: at most `max_steps` of O(p T n), and O(n^3) for the step size. Nothing is sent.",
      .corrected = with_window({}),
  };
}

MethodWords window_ekf() {
  return {
      .id = "window_ekf",
      .line = "The same filter with nothing taken off: the unprotected reference",
      .model =
          "The plant and stations of seed 001, each node a Kalman filter on its own innovations, which knows no attack "
          "(specification (sparse), section 13, EKF).",
      .steps = {"Predict `x- = Abar x`, `P- = Abar P Abar' + Q`.",
                "Kalman update with the wrapped innovation in Joseph's form; `startup` update by default, so from the "
                "first reading on."},
      .cost = "O(n^3 + n^2 p + p^3) a node and tick. Nothing is sent.",
      .corrected = {Correction{"The printed azimuth row is divided by the ground range where its square belongs "
                               "(specification (sparse), section 4).",
                               "printed_azimuth_row", true},
                    Correction{"The last entry of the elevation row is `rho2/rho^2` instead of `rho2^2/rho^2`; `atan2` "
                               "and wrapped innovations throughout (section 4)."}},
  };
}

const WordsRegistration registration("sparse (seed 001)",
                                     {omp_ekf(), omp_game(), omp_game_channels(), l1_ekf(), etpg_ekf(), window_ekf()});

}  // namespace
}  // namespace vigil
