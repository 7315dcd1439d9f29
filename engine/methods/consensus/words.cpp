#include "engine/methods/words.hpp"

namespace vigil {
namespace {

std::vector<Correction> corrected() {
  return {
      {"(28) and (29) fail at step 2 of the paper's own example, and unguarded the bound stops being positive definite "
       "(specification (consensus), section 6). `clip` keeps the eigenvalues of both bounds within a share `rho` of "
       "the "
       "limits; `strict` stops the run, `adapt` shrinks sigma and beta instead.",
       "guard", "none"},
      {"Theorem 1 is wrong for two neighbours and more: (24) drops the cross-covariances of neighbours, and (35), (36) "
       "turn double sums into single ones (specification (consensus), section 7, with two counterexamples). "
       "`corrected` "
       "and `tight` satisfy `1/m0 + d/mn + d/ma <= 1` and are valid.",
       "bound", "paper"},
      {"(39), the derivative behind the gain, is garbled; setting the derivative of the trace of (27) to zero gives "
       "(30) "
       "exactly, which is used (section 5)."},
      {"The last term of (24) prints `K R K`; it is `K R K'`, as in (27) (section 5)."},
      {"(27) needs the neighbours' bounds although only predictions are exchanged: they travel beside the packet and "
       "are "
       "not attacked; they count through the mean even where the packet is lost (section 5)."},
      {"\"The detector recognises attacks correctly\" means that the receiver knows which packets did not come. The "
       "filter "
       "may use the published rates and the norm bound, never which packets were falsified (section 4); discarding "
       "those "
       "is the separate mode `drop`."},
      {"U, V and the initial values are not given: `U = 0.01 I`, `V = 0.1 I` by default (section 5)."},
      {"Of eps the text demands only `0 < eps < 1/d_max`; by default it is `0.9/d_max`, 0.3 without edges, found anew "
       "where the graph changes (section 5)."},
      {"`U U'/(eps sigma)` in (26) is looser than what Lemma 1 gives; the printed one is kept, it is still valid "
       "(section 7)."},
      {"The certificate of theorem 2 asks the bound to be isotropic within 2.6 percent at the defaults, which no "
       "filter with an "
       "unmeasured direction is; it is evaluated and reported as it comes out (section 8)."},
  };
}

MethodWords consensus_ekf() {
  return {
      .id = "consensus_ekf",
      .line =
          "Recursive filters that pull towards their neighbours' predictions, with a bound on the error under DoS and "
          "false data",
      .model =
          "`x+ = f(x, u) + w`, `z_i = h_i(x) + v_i`; what arrives from neighbour j is `(1 - phi_ij)(xp_j + gamma_ij "
          "xi_ij)`, (6): lost with probability `phibar`, falsified by a vector of norm up to `delta` with probability "
          "`gammabar`. The filter is `x_i = xp_i + K_i (z_i - h_i(xp_i)) + C_i sum_j (received_j - xp_i)` over the "
          "packets that came, (7), with `C_i = tau Phi_i(k+1|k)`; `Phi` is an upper bound of the error covariance by "
          "(26), (27). Numbers are those of seed 000; specification (consensus), sections 4 to 8.",
      .steps =
          {"Predict `xp = f(x, u)`, (3). Judge (28) on `Phi(k|k)`, then guard it.",
           "`Phi(k+1|k) = F [Phi^-1 - (1+eps) sigma I]^-1 F' + U U'/(eps sigma) + Q`, (26), by one symmetric "
           "eigendecomposition. Judge (29), guard, `C = tau Phi(k+1|k)`. Send `xp`.",
           "With n packets received: `B = I - n C`, `M = (Phi(k+1|k)^-1 - beta I)^-1`, `S = H M H' + V V'/beta + "
           "R/m0`, "
           "`K = B M H' S^-1`, (30).",
           "Estimate by (7); a heading's difference is wrapped, the estimate itself is not.",
           "`Phi(k+1|k+1) = m0 G M G' + mn (1 - phibar) C (sum_j Phi_j) C' + ma d delta^2 gammabar C C' + K (m0 V "
           "V'/beta "
           "+ R) K'` with `G = B - K H`, (27); `m0, mn, ma` are `1 + 2d, 3, 3` with `bound` paper.",
           "Without a complete reading `K = 0`. Modes `naive_hold` and `naive_zero` know nothing of attacks: a lost "
           "packet is the last one received, or zero."},
      .cost =
          "O(N (d n^2 + n^3 + n^2 p + p^3)) a tick for N nodes with d neighbours: about two eigendecompositions of n x "
          "n a node. A message carries n numbers, its bound beside it. Memory is linear in nodes and links.",
      .corrected = corrected(),
  };
}

const WordsRegistration registration("consensus (seed 000)", {consensus_ekf()});

}  // namespace
}  // namespace vigil
