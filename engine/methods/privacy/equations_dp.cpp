/// Equations of seed 004, chapters 3 and 4; numbers are its own. Specification (privacy), sections 1.6, 3 and 4.
#include "engine/methods/equation.hpp"

namespace vigil {
namespace {

const std::vector<std::string> kSensors{"dp_sensors"};
const std::vector<std::string> kTwoStep{"two_step"};

const EquationsRegistration differential({
    {"privacy/3-16",
     "(3-16)",
     {"The Gaussian mechanism: noise of standard deviation Gamma times the sensitivity is (epsilon, delta)-private",
      "高斯机制：标准差为 Γ 乘以灵敏度的噪声满足 (ε, δ)-差分隐私"},
     R"(\Gamma(\epsilon,\delta) = \frac{k + \sqrt{k^2 + 2\epsilon}}{2\epsilon},\quad k = Q^{-1}(\delta))",
     {"dp_centre", "dp_sensors", "two_step"}},
    {"privacy/3-10",
     "(3-10)",
     {"What is published: the mean of kappa fused estimates", "发布量：κ 个融合估计的平均"},
     R"(x_u(t) = \frac{1}{\kappa}\sum_{k=t-\kappa+1}^{t}\hat x_f(k))",
     {"dp_centre", "dp_sensors"}},
    {"privacy/3-17",
     "(3-17)",
     {"Noise at the centre; print forgets 1/kappa, which makes it safe and too large",
      "中心加噪；原文漏去 1/κ，偏于安全但过大"},
     R"(x_u + a,\quad \operatorname{var}a \ge \left(\Gamma\,\sigma\lambda\right)^2,\quad \sigma =)"
     R"( \lVert W K C H\rVert)",
     {"dp_centre"}},
    {"privacy/3-23",
     "(3-23)-(3-27)",
     {"Noise shared out among the sensors: what each sends (PLSE), and what a listener fuses (PDFE)",
      "噪声分摊到各传感器：各自发送量（PLSE）与窃听者的融合结果（PDFE）"},
     R"(\hat x_i^p = \hat x_i + W_i^{-1}\xi_i,\; \xi_i \sim \mathcal{N}(0, q_i I),\quad \sum_i q_i =)"
     R"( \frac{(\Gamma\,\sigma\lambda)^2}{\kappa},)"
     R"(\quad W\hat x^p = \hat x_f + \sum_i\xi_i)",
     kSensors},
    {"privacy/3-26",
     "(3-26)",
     {"The legitimate user fuses by weights that know the noise (CDFE)", "合法用户以已知噪声的权重融合（CDFE）"},
     R"(P_c = P + \operatorname{diag}\left(q_i W_i^{-1}W_i^{-\top}\right),\quad \hat x_c = W_c\hat)"
     R"( x^p,\quad W_c = \left(e^\top P_c^{-1}e\right)^{-1}e^\top P_c^{-1})",
     kSensors},
    {"privacy/loss",
     "",
     {"Chance that the privacy loss exceeds epsilon, for a shift d between neighbours under noise of covariance S",
      "噪声协方差为 S、邻居间偏移为 d 时，隐私损失超过 ε 的概率"},
     R"(P(\text{loss} > \epsilon) = Q\left(\frac{\epsilon}{\mu} - \frac{\mu}{2}\right),\quad \mu =)"
     R"( \sqrt{d^\top S^{-1}d})",
     {"dp_centre", "dp_sensors", "two_step"}},
});

const EquationsRegistration two_step({
    {"privacy/4-11",
     {"(4-11), (4-12)", true},
     {"Messages: noisy estimates summed over a window of tq terms (print sums one too many), null-space noise on top",
      "报文：带噪估计在 t_q 项窗口内求和（原文多一项），再叠加零空间噪声"},
     R"(s(t) = \sum_{k=t-t_q+1}^{t}\left(\hat x(k) + R\,\xi(k)\right) + \left(I - W_c^{+}W_c\right)\alpha(t))",
     kTwoStep},
    {"privacy/4-14",
     "(4-14)",
     {"Noise of a message, and what makes it private: the least eigenvalue decides",
      "报文噪声及其隐私条件：由最小特征值决定"},
     R"(Q_{\phi,i} = t_q\,q_{\xi,i}R_i R_i^\top + q_\alpha\Pi_{ii},\quad \lambda_{\min}(Q_{\phi,i}))"
     R"( \ge \left(\Gamma\,\sigma_i\zeta\right)^2)",
     kTwoStep},
    {"privacy/4-18",
     "(4-18)",
     {"The legitimate user takes differences that cancel the null-space noise", "合法用户作差，消去零空间噪声"},
     R"(\hat x_f(t) = W_c\left(s(t) - s(t-1)\right) + \hat x_f(t - t_q))",
     kTwoStep},
    {"privacy/4-20",
     "(4-20), (4-21)",
     {"So does an eavesdropper, with the nominal weights, for whom it does not cancel",
      "窃听者以名义权重作差，噪声不能消去"},
     R"(x_w(t) = s(t) - s(t-1) + x_w(t - t_q),\quad \hat x_w = W x_w)",
     kTwoStep},
    {"privacy/4-24",
     {"(4-24)-(4-27)", true},
     {"The eavesdropper's covariance: linear growth, since only the null-space noise adds up",
      "窃听者误差协方差：只有零空间噪声累积，因此线性增长"},
     R"(\operatorname{tr}(W P_p W^\top) + c(t)\,q_\alpha\operatorname{tr}(W\Pi W^\top),\quad c(t))"
     R"( \approx \frac{2t}{t_q})",
     kTwoStep},
    {"privacy/code",
     "",
     {"State-secrecy code: relative to the last acknowledged message; L = A, or per sensor with S_i = S - P_ii",
      "状态保密编码：相对于最近被确认的报文；L = A，或按传感器取 S_i = S − P_ii"},
     R"(z_i(t) = \hat x_i(t) - L\,\hat x_i(t-1),\quad L_i = S_i A^{-\top}S_i^{-1})",
     {"secrecy_code"}},
});

}  // namespace
}  // namespace vigil
