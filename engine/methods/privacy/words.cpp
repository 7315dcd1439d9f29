/// Of the fusion lane and the plainer protections.
#include "engine/methods/words.hpp"

namespace vigil {
namespace {

std::vector<Correction> fusion_corrected() {
  return {{"(2-52) divides the bearing row by r where its square belongs; with the printed derivative the fused "
           "error is many times larger (specification (privacy), section 2.6).",
           "printed_jacobian", true},
          {"(2-11) prints `F_i` on both sides; the right factor is `F_j` (section 1.3)."},
          {"(2-4) propagates with a matrix where `f` belongs, (2-5) linearises at the wrong time and (2-6) uses "
           "`A_i` twice; the filter as printed is biased (section 1.3)."},
          {"(3-8) lacks the inverse of the innovation's covariance, and (3-9) prints a minus where the noise is "
           "added; corrected, they give the printed numbers (4-33) (section 1.3)."},
          {"The source always inverts `P`, which is singular with a common start or equal predictions. Rao's "
           "unified least squares is used there, `M = P + s e e'`, exact for every `P` (section 1.4)."},
          {"No initial conditions are given: a common start, with weights `I/L` at tick 0 (section 1.2)."}};
}

MethodWords fusion() {
  return {
      .id = "fusion",
      .line = "Local Kalman filters that send their estimates to a centre, which fuses them with least variance",
      .model =
          "`x+ = A x + B w`, `y_i = C_i x + v_i`, or nonlinear `f`, `h_i` (seed 004, (2-1), (2-7), (3-1), (4-1)). "
          "Every "
          "sensor runs a filter of its own; the errors are correlated, `P = (P_ij)`, (2-11), as they share start and "
          "process noise. With `e = [I; ...; I]` the centre fuses by `W = (e' P^-1 e)^-1 e' P^-1`, `P_f = W P W'`, "
          "Lemma "
          "2.1, (2-12), (2-13). What protects the messages on the way is the lane's protection. Specification "
          "(privacy), "
          "section 1.",
      .steps =
          {"At each sensor: `Pz = A P_ii A' + B Q B'`, `S = C Pz C' + R`, `K = Pz C' S^-1`, `F = I - K C`, `xhat <- A "
           "xhat "
           "+ K (y - C A xhat)`, linearised at its own estimates, with the gain of the tick, or with that of the long "
           "run, by `filter`.",
           "Cross-covariances: `P_ij <- F_i (A P_ij A' + B Q B') F_j'`, and `K_i R_i K_i'` where i = j. Nothing is "
           "computed any more where they have settled to 1e-12.",
           "Weights `W`. The protection encodes; the estimates are sent.",
           "The centre decodes, puts its own prediction where nothing came, and fuses by the covariance of what it "
           "has."},
      .cost =
          "A tick: O(L n^3) for L filters of n states, O(L^2 n^3) for their cross-covariances, O((n L)^3) for the "
          "weights; O(L n^2) beside the protection once they have settled. A message carries n numbers.",
      .corrected = fusion_corrected(),
  };
}

MethodWords gaussian_noise() {
  return {
      .id = "gaussian_noise",
      .line = "White Gaussian noise on every message, which nobody takes off again",
      .model =
          "`message + xi`, `xi ~ N(0, q I)`; an eavesdropper that fuses has `W (P + q I) W'`, and so has the "
          "legitimate user with weights of its own. The plain Gaussian mechanism without an account of privacy "
          "(specification (privacy), section 1.6).",
      .steps = {"Add independent noise of variance `variance` to every entry of every message.",
                "The centre fuses knowing that covariance. Any lane whose nodes talk can have it."},
      .cost = "O(n) a message of n numbers.",
  };
}

MethodWords complex_noise() {
  return {
      .id = "complex_noise",
      .line = "Artificial noise from several antennas into the null space of the legitimate channel",
      .model =
          "After Goel and Negi: a sensor sends `u s + Z z`, `u = conj(h)/||h||` along the legitimate channel h, `Z` "
          "spanning its null space, so that the user never sees `z`. The eavesdropper with channel g decodes where `ps "
          "|g u|^2 / (power ||g Z||^2 + s0) >= tau`. Seed 004 gives no equations; this is the standard model "
          "(specification (privacy), section 2.8).",
      .steps =
          {"The estimates go as they are; the legitimate link loses nothing.",
           "`fading`: draw h and g, complex normal, for every message; `static`: all gains 1, decoded where `ps/(power "
           "+ s0) >= tau`.",
           "The eavesdropper fuses what it decoded and predicts `A xe` for the rest."},
      .cost = "O(na) a message with na antennas. On the air it costs L (na - 1) power more for L sensors.",
      .corrected = {Correction{
          "The text has power 1 bounded and 5.6097 diverge exponentially. With eigenvalues on the unit "
          "circle no loss process gives exponential growth, and a predicting eavesdropper that "
          "decodes now and then is bounded; only a static channel that always loses diverges, "
          "polynomially (specification (privacy), section 2.8)."}},
  };
}

MethodWords secrecy_code() {
  return {
      .id = "secrecy_code",
      .line = "Each sensor sends its estimate less a multiple of its last acknowledged one",
      .model =
          "After Tsiamis, Gatsis and Pappas: `z_i(t) = xhat_i(t) - Lc^(t - t_ref) xhat_i(t_ref)`, `t_ref` the last "
          "message the user got. Code A: `Lc = A`. Code L: `Lc_i = S_i A^-T S_i^-1`, `S_i` the covariance of the "
          "sensor's estimate, so that what is sent is uncorrelated with it (specification (privacy), section 4.6).",
      .steps =
          {"Sensor and user hold the same multiple of the last decoded estimate; the sensor takes it off, the user "
           "adds "
           "it. The first message is not coded.",
           "The eavesdropper misses all messages of a tick with probability `loss`.",
           "Code A: it predicts `A xe` where it missed, else `xe = z + A xe`. Code L: after its first miss the best it "
           "has is the prior."},
      .cost =
          "O(n^2) a message of n numbers. Once: the stationary filters, and for codes L and L_state the best estimate "
          "from the "
          "last five messages of all sensors.",
      .corrected =
          {Correction{"With one `Lc = S A^-T S^-1` for all sensors, from the covariance of the state instead of the "
                      "estimates, the code leaks; code L takes each sensor's own (specification (privacy), "
                      "section 4.6).",
                      "code", "L_state", Reading::other},
           Correction{"How often the eavesdropper misses is not said; 0.36 by default, fitted to the printed index "
                      "3.66 (section 4.6)."},
           Correction{"Encoding against the sensor's own past estimate lets rounding grow with the powers of `Lc`; "
                      "it encodes against what the user has decoded (section 4.6)."}},
  };
}

const WordsRegistration registration("privacy (seed 004)",
                                     {fusion(), gaussian_noise(), complex_noise(), secrecy_code()});

}  // namespace
}  // namespace vigil
