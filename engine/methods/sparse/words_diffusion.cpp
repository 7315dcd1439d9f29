/// Of the two lanes without a window: A3 and A5.
#include "engine/methods/words.hpp"

namespace vigil {
namespace {

Correction azimuth() {
  return {
      "The printed azimuth row is divided by the ground range where its square belongs (specification (sparse), "
      "section 4).",
      "printed_azimuth_row", true};
}

MethodWords kalman_consensus() {
  return {
      .id = "kalman_consensus",
      .line =
          "A3: information of the neighbourhood fused, and a pull towards the neighbours' predictions; knows of no "
          "attack",
      .model =
          "Olfati-Saber's Kalman-consensus filter (2007), restated: `xhat_i = xb_i + M_i (y_i - S_i xb_i) + gamma_i "
          "P_i sum_j (xb_j - xb_i)`, `gamma_i = gain/(1 + ||P_i||_F)` (specification (sparse), section 11, A3).",
      .steps = {"Predict `xb`, `P`. Send `xb`.",
                "At each node: `u = C' R^-1 (nu + C xb)`, `U = C' R^-1 C`, with the wrapped innovation `nu`.",
                "Sum `u` and `U` over the node itself and the neighbours it heard: `y_i`, `S_i`. `M_i = (P_i^-1 + "
                "S_i)^-1`, in a form that bears a singular `P`.",
                "Update as above, angles wrapped; `M_i` is the covariance that the next prediction starts from."},
      .cost =
          "O(N (n^3 + n^2 p + p^3 + d n^2)) a tick. A message carries n numbers; `u` and `U` (n + n^2) travel beside "
          "it, "
          "unattacked.",
      .corrected = {azimuth()},
  };
}

MethodWords diffusion_lms() {
  return {
      .id = "diffusion_lms",
      .line = "A5: each node adapts alone and together, and trusts neighbours near the median of what all found alone",
      .model =
          "Secure diffusion LMS after Liu and Li (2018): two copies a node, `a` that never listens and `w`, the "
          "estimate, both adapted by `z <- Abar z + mu C' (y - h(Abar z))`. The text names the parts; the constants "
          "are the specification's (specification (sparse), section 11, A5).",
      .steps = {"Adapt `a_i` from `a_i`, and `psi_i` from `w_i`. Send `psi_i`.",
                "`ref_i`: component by component the median of `a` over the node and the neighbours it heard.",
                "Trusted are those with `||psi_l - ref_i||^2 <= trust` (units of the state mixed).",
                "`w_i` is the mean of the trusted `psi`, or `ref_i` where none is."},
      .cost =
          "O(N (n^2 + n p + d n)) a tick: no covariance is kept. A message carries n numbers; `a` travels beside it.",
      .corrected = {azimuth()},
  };
}

const WordsRegistration registration("sparse (seed 001)", {kalman_consensus(), diffusion_lms()});

}  // namespace
}  // namespace vigil
