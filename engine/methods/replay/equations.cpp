/// Equations of seed 003; numbers are its own. Specification (replay), sections 2 to 8.
#include "engine/methods/equation.hpp"

namespace vigil {
namespace {

const std::vector<std::string> kMixed{"mixed_filter"};
const std::vector<std::string> kDetector{"mixed_filter", "dynamic"};

const EquationsRegistration filter({
    {"replay/1",
     "(1)",
     {"The plant: d and f are random, w and v unknown but in ellipsoids", "对象：d、f 为随机噪声，w、v 未知但有椭球界"},
     R"(x_{k+1} = A x_k + B u_k + w_k + d_k,\quad y_k = C x_k + v_k + f_k,\quad w^\top M_w^{-1}w \le)"
     R"( 1,\; v^\top M_v^{-1}v \le 1)"},
    {"replay/5",
     "(5)-(7)",
     {"Time update: covariance of the random part, and the ellipsoid of least trace around the bounded one",
      "时间更新：随机部分的协方差，以及有界部分的最小迹椭球"},
     R"(\begin{aligned} \bar x_k &= A\hat x_{k-1} + B u_{k-1},\quad \bar Q_k = A Q_{k-1}A^\top + P \\)"
     R"( \bar M_k &= (s_1 + s_2)\left(\frac{A M_{k-1}A^\top}{s_1} + \frac{M_w}{s_2}\right),\quad)"
     R"( s_1 = \sqrt{\operatorname{tr}(A M_{k-1}A^\top)},\; s_2 = \sqrt{\operatorname{tr}M_w} \end{aligned})",
     kMixed},
    {"replay/12",
     "(12)-(24)",
     {"Measurement update: one gain for both kinds of noise, sigma = 1/(1 + zeta) by bisection",
      "量测更新：同一增益兼顾两类噪声，σ = 1/(1+ζ) 由二分法求得"},
     R"(\begin{aligned} \hat x_k &= \bar x_k + K_k(y_k - C\bar x_k),\quad K = W C^\top\left(C W C^\top)"
     R"( + S\right)^{-1} \\)"
     R"( W &= \mu\bar Q_k + (1-\mu)\frac{\bar M_k}{\sigma},\quad S = \mu R + (1-\mu)\frac{M_v}{1-\sigma} \\)"
     R"( J &= \mu\operatorname{tr}Q_k + (1-\mu)\operatorname{tr}M_k,\quad X = I - K C \\)"
     R"( Q_k &= X\bar Q_k X^\top + K R K^\top,\quad M_k = (1+\zeta)X\bar M_k X^\top + \left(1 +)"
     R"( \frac{1}{\zeta}\right)K M_v K^\top \end{aligned})",
     kMixed},
    {"replay/corner",
     "",
     {"With the paper's parameters of scenarios 2 and 3 the optimum is this corner: the residual is zero",
      "在论文情形 2、3 的参数下最优解位于此角点：残差恒为零"},
     R"(\zeta \to \infty:\quad K = C^{-1},\quad r_k = y_k - C\hat x_k = 0)",
     kMixed},
    {"replay/peak",
     "",
     {"Reduction of the peak error, by the means over runs", "峰值误差的降低率（对各次运行取平均）"},
     R"(1 - \frac{\sum_r \max_{k\ge 20}\lVert e_{k,r}\rVert_\infty}{\sum_r \max_{k\ge 20}\lVert)"
     R"( e'_{k,r}\rVert_\infty})"},
});

const EquationsRegistration detector({
    {"replay/25",
     {"(25)", true},
     {"Detection function: mean energy of the last t residuals; the printed sum has an index too many",
      "检测函数：最近 t 个残差的平均能量；原文求和中的下标有误"},
     R"(\xi_k = \frac{1}{t}\sum_{i=k-t+1}^{k} r_i^\top r_i,\quad r_k = y_k - C\hat x_k)",
     {"mixed_filter", "dynamic", "fixed"}},
    {"replay/27",
     "(27), (28)",
     {"Dynamic threshold of the last tau values, moved by iota or more. As printed flagged values raise it themselves; "
      "frozen, they do not enter",
      "由最近 τ 个值得到的动态阈值，变化达到 ι 才更新。按原文，被标记的值会抬高阈值；冻结时它们不进入窗口"},
     R"(c_k = \operatorname{mean}(\xi) + \eta\operatorname{std}(\xi),\quad)"
     R"( \theta_k = \begin{cases} c_k & \lvert c_k - \theta_{k-1}\rvert \ge \iota \\ \theta_{k-1} &)"
     R"( \text{else} \end{cases},\quad \text{alarm: } \xi_k > \theta_k)",
     kDetector},
    {"replay/lasts",
     "",
     {"So long a flag lasts at most under (27), (28), for a step and iota 0",
      "按 (27)、(28)，阶跃且 ι = 0 时标记最多持续的样本数"},
     R"(q < \frac{\tau}{1 + \eta^2\,\tau/(\tau - 1)})",
     kDetector},
    {"replay/29",
     "(29)",
     {"Read literally, only the residual meets the replayed output; the estimate does not",
      "按字面理解，只有残差用到重放输出，估计不受影响"},
     R"(r_k = y_{j(k)} - C\hat x_k)",
     kMixed},
    {"replay/attack",
     "",
     {"Replay of y_50 to y_100, in a loop where the attack is longer; a keyed watermark s does not cancel then",
      "重放 y₅₀ 至 y₁₀₀，攻击更长时循环；此时密钥水印 s 不再抵消"},
     R"(j(k) = 50 + (k - k_0)\operatorname{mod} 51,\quad y_k \to y_{j(k)} + s_{j(k)} - s_k)",
     kMixed},
    {"replay/accuracy",
     "",
     {"Accuracy of a run: the share of ticks judged rightly", "一次运行的准确率：判断正确的时刻所占比例"},
     R"(\frac{1}{300}\left\lvert\{k \mid \text{alarm}_k = (k \in \mathcal{T})\}\right\rvert)"},
});

const EquationsRegistration rivals({
    {"replay/gmeekf",
     "",
     {"GMEEKF: the weights of its update, found anew until the estimate stands still",
      "GMEEKF：更新所用权重，迭代至估计不再变化"},
     R"(\Phi_{ij} = \lvert e_i - e_j\rvert^{\alpha-2}\exp\left(-\lvert e_i -)"
     R"( e_j\rvert^\alpha/\beta^\alpha\right),\quad)"
     R"( \Lambda = \Psi^\top\Psi + \Phi^\top\Phi)",
     {"gmeekf"}},
    {"replay/zonotope",
     "",
     {"Zonotope filter: all residuals that a healthy sensor can have, and what the secret code sends",
      "全对称多胞体滤波：正常传感器残差的全部可能值，以及加密后的发送量"},
     R"(\mathcal{Z}_k = \langle 0, [C\bar H_k,\; H_v]\rangle,\quad s_k = E_k z_k + m_k,\quad)"
     R"( \text{alarm: } E_k^\top(s_k - m_k) \notin \mathcal{Z}_k)",
     {"zonotope_watermark"}},
    {"replay/4",
     {"(4)", true},
     {"UFIR filter over the last N readings, with the input of the step before",
      "基于最近 N 个量测的 UFIR 滤波，输入取前一时刻"},
     R"(\hat x_l = A\hat x_{l-1} + B u_{l-1} + G_l C^\top(y_l - C\bar x_l),\quad G_l = \left(C^\top C)"
     R"( + (A G_{l-1}A^\top)^{-1}\right)^{-1})",
     {"ufir_filter"}},
    {"replay/chi",
     "",
     {"Chi-square test over a window of t innovations of p channels", "t 个 p 维新息的窗口上的卡方检验"},
     R"(\sum_{i=k-t+1}^{k} r_i^\top S_i^{-1}r_i > \chi^2_{t p}(1 - \alpha))",
     {"chi_square"}},
    {"replay/cusum",
     "",
     {"Cumulative sum", "累积和"},
     R"(C_k = \max\left(0,\; C_{k-1} + \frac{r_k^\top S_k^{-1}r_k - p}{\sqrt{2p}} - \text{drift}\right))",
     {"cusum"}},
});

}  // namespace
}  // namespace vigil
