/// Equations of seed 004, chapter 2 and what all chapters share; numbers are its own. Specification (privacy), sections
/// 1 and 2.
#include "engine/methods/equation.hpp"

namespace vigil {
namespace {

const std::vector<std::string> kFusion{"fusion"};
const std::vector<std::string> kContamination{"contamination"};

const EquationsRegistration common({
    {"privacy/2-1",
     "(2-1), (2-7)",
     {"Plant and sensors", "对象与传感器"},
     R"(x(t+1) = A x(t) + B w(t),\quad y_i(t) = C_i x(t) + v_i(t))"},
    {"privacy/2-11",
     {"(2-11)", true},
     {"Cross-covariance of two local filters; the right factor belongs to sensor j",
      "两个局部滤波误差的互协方差；右侧因子属于传感器 j"},
     R"(P_{ij} = F_i\left(A P_{ij}A^\top + B Q B^\top\right)F_j^\top + \delta_{ij}K_i R_i)"
     R"( K_i^\top,\quad F_i = I - K_i C_i)",
     kFusion},
    {"privacy/2-12",
     "(2-12), (2-13)",
     {"Fusion of least variance; where P is singular, by the symmetric pseudo-inverse of P + s e e'",
      "最小方差融合；P 奇异时用 P + s·e·eᵀ 的对称伪逆"},
     R"(W = \left(e^\top P^{-1}e\right)^{-1}e^\top P^{-1},\quad \hat x = \sum_i W_i\hat x_i,\quad P_f)"
     R"( = W P W^\top,\quad e = [I;\ldots;I])",
     kFusion},
    {"privacy/3-8",
     {"(3-7)-(3-9)", true},
     {"Stationary filter: an inverse is missing in print, and the last sign is plus",
      "稳态滤波：原文缺一个逆，且末项符号应为正"},
     R"(\begin{aligned} \Sigma &= A\Sigma A^\top + B Q B^\top - A\Sigma C^\top\left(C\Sigma C^\top +)"
     R"( R\right)^{-1}C\Sigma A^\top \\)"
     R"( P_{ij} &= \Psi_i P_{ij}\Psi_j^\top + F_i B Q B^\top F_j^\top + \delta_{ij}K_i R_i)"
     R"( K_i^\top,\quad \Psi_i = F_i A \end{aligned})",
     kFusion},
    {"privacy/4-10",
     "(4-10)",
     {"Confidentiality index; below 0 the eavesdropper is the better off", "保密性指标；小于 0 时窃听者更优"},
     R"(\mathrm{CI} =)"
     R"( \log_2\frac{\operatorname{tr}P_{\text{eavesdropper}}}{\operatorname{tr}P_{\text{legitimate}}})"},
    {"privacy/mse",
     "",
     {"Mean squared error over M runs", "M 次运行的均方误差"},
     R"(\mathrm{MSE}(t) = \frac{1}{M}\sum_{r=1}^{M}\lVert x_r(t) - \hat x_r(t)\rVert^2)"},
});

const EquationsRegistration contamination({
    {"privacy/2-14",
     "(2-14)-(2-20)",
     {"What a sensor sends: some components replaced by noise that the nominal weights do not let through",
      "传感器发送的内容：部分分量被名义权重不通过的噪声取代"},
     R"(x_r = H\hat x + (I - H)\phi,\quad \phi = \left(I - G^{+}G\right)a,\; G = W(I - H),\; a \sim)"
     R"( \mathcal{N}(0, Q_a I),\quad x_e = W x_r)",
     kContamination},
    {"privacy/2-23",
     "(2-23), (2-41)",
     {"The legitimate user puts a prediction in their place, and fuses anew", "合法用户以预测值代替并重新融合"},
     R"(x_c = H x_r + (I - H)\,e\,p,\quad p = A\hat x_f(t-1) \;\text{ or }\; f(\hat x_f(t-1)),\quad)"
     R"( \hat x_f = W_f x_c)",
     kContamination},
    {"privacy/2-21",
     "(2-21), (2-22)",
     {"Theorem 2.1's choice of components, among the sets that keep the user's error bounded",
      "定理 2.1 的分量选择，仅限于保持合法用户误差有界的集合"},
     R"(\max_H \lVert H - H_m\rVert,\quad H_m = e\,\Lambda\left(\Lambda + P_f\right)^{-1}W,\quad)"
     R"( \Lambda(t) = A\Lambda(t-1)A^\top + B Q B^\top)",
     kContamination},
    {"privacy/2-30",
     {"(2-30)-(2-33)", true},
     {"Covariance of what the user fuses; X is that of a local error with the prediction's",
      "合法用户所融合量的协方差；X 为局部误差与预测误差的互协方差"},
     R"(S_{ij} = H_i P_{ij}H_j + H_i X_i(I - H_j) + (I - H_i)X_j^\top H_j + (I - H_i)\bar P(I - H_j),)"
     R"(\quad X_i = F_i\left(A_i C_{fi}^\top A_f^\top + B Q B^\top\right),\quad \bar P = A_f P_f)"
     R"( A_f^\top + B Q B^\top)",
     kContamination},
    {"privacy/2-26",
     {"(2-26)", true},
     {"The eavesdropper's error, with the cross terms that print drops", "窃听者误差，包含原文遗漏的交叉项"},
     R"(P_e = W\left(H P H + \bar H\Lambda_F\bar H + H X\bar H + \bar H X^\top H\right)W^\top,\quad \bar H = I - H)",
     kContamination},
    {"privacy/2-52",
     {"(2-52)", true},
     {"Derivatives of a bearing; printed, they are divided by r where it must be r squared",
      "方位角的导数；原文除以 r，应除以 r²"},
     R"(\frac{\partial\theta}{\partial(S_x, S_y, \Theta)} = \left(-\frac{\Delta y}{r^2},\;)"
     R"( \frac{\Delta x}{r^2},\; 1\right),\quad r^2 = \Delta x^2 + \Delta y^2)",
     kFusion},
    {"privacy/2-4",
     {"(2-4)-(2-6)", true},
     {"Extended local filter: propagated and linearised at the right points", "扩展局部滤波：在正确的点上传播与线性化"},
     R"(\hat x_i^- = f(\hat x_i(t-1)),\quad A_i = \frac{\partial f}{\partial x}(\hat x_i(t-1)),\quad)"
     R"( C_i = \frac{\partial h_i}{\partial x}(\hat x_i^-))",
     kFusion},
    {"privacy/noise",
     "",
     {"Artificial noise of n antennas: how likely the eavesdropper decodes a packet on a fading channel",
      "n 根天线的人工噪声：衰落信道上窃听者解码成功的概率"},
     R"(p = \frac{\exp(-\tau s_0/p_s)}{\left(1 + \tau\,P_z/p_s\right)^{n-1}},\quad \hat x_e \leftarrow)"
     R"( A\hat x_e \;\text{ on loss})",
     {"complex_noise"}},
    {"privacy/white",
     "",
     {"White noise on every message", "对每个报文加白噪声"},
     R"(\hat x_i' = \hat x_i + \xi_i,\quad \xi_i \sim \mathcal{N}(0, q I))",
     {"gaussian_noise"}},
});

}  // namespace
}  // namespace vigil
