/// Equations of seed 002; numbers are its own. Specification (observer), sections 1 to 6 and 8.
#include "engine/methods/equation.hpp"

namespace vigil {
namespace {

const std::vector<std::string> kProposed{"intermediate_observer"};

const EquationsRegistration plant({
    {"observer/1",
     "(1)",
     {"Subsystem i: attack w on its actuator, disturbance d, fault f of its sensor, coupling to the others",
      "子系统 i：执行器攻击 w、扰动 d、传感器故障 f，以及与其他子系统的耦合"},
     R"(\begin{aligned} \dot x_i &= A_i x_i + B_i u_i + F_i\Phi_i(x_i) + D_i w_i + \bar D_i d_i -)"
     R"( \alpha_i\sum_{j\ne i}H_{ij}x_j \\)"
     R"( y_i &= C_i x_i + G_i f_i \end{aligned})"},
    {"observer/6",
     "(2)-(6)",
     {"State and fault stacked; the left inverse is this one, not the Moore-Penrose inverse",
      "状态与故障合并；左逆取此式，而非 Moore-Penrose 逆"},
     R"(\xi_1 = \begin{bmatrix} x \\ f \end{bmatrix},\quad K_2^{+} = \begin{bmatrix} I & 0 \\ -G^{+}C)"
     R"( & G^{+}E^{-1} \end{bmatrix},)"
     R"(\quad G^{+} = (G^\top G)^{-1}G^\top)",
     kProposed},
    {"observer/rms",
     "",
     {"Root mean square of an error over the stated span of time", "误差在给定时段内的均方根"},
     R"(\sqrt{\frac{1}{n}\sum_{k} e(t_k)^2},\quad e = w - \hat w,\; f - \hat f,\; x - \hat x)"},
});

const EquationsRegistration observer({
    {"observer/9",
     "(9)-(13)",
     {"The observer: an intermediate variable makes attack, fault and state come out together",
      "观测器：借助中间变量同时估计攻击、故障与状态"},
     R"(\begin{aligned} \hat\xi_1 &= \hat\xi_2 + E_2 y,\quad \hat w = \hat\theta + N\hat\xi_2,\quad N)"
     R"( = \varsigma D_2^\top \\)"
     R"( c &= A_2\hat\xi_1 + B_2 u + F_2\Phi(\hat x) + D_2\hat w + J_2 y - \alpha\sum_j \bar H_{ij}\hat\xi_{1,j} \\)"
     R"( \dot{\hat\xi}_2 &= c + \mu L_1(y - \bar C_1\hat\xi_1),\quad \dot{\hat\theta} = -N c + \mu)"
     R"( L_2(y - \bar C_1\hat\xi_1) \end{aligned})",
     kProposed},
    {"observer/16",
     "(16)",
     {"Its errors: the fault does not enter them at all", "误差动态：故障完全不进入"},
     R"(\dot e_i = \left(\bar A - \mu L\bar C\right)e_i + \bar F\,\tilde\Phi_i + \bar K d_i + \bar)"
     R"( W\dot w_i - \alpha_i\bar N\sum_j \tilde H_{ij}e_j)",
     kProposed},
    {"observer/17",
     "(17)",
     {"The linear matrix inequality of the gains; M selects the state in e. The coupling's blocks stand beside the "
      "diagonal",
      "求增益的线性矩阵不等式；M 从 e 中取出状态。耦合块位于非对角位置"},
     R"(\begin{bmatrix} S & P\bar K & P\bar W & P\bar F \\ \ast & -\gamma_d^2 I & 0 & 0 \\ \ast & \ast)"
     R"( & -\gamma_w^2 I & 0 \\)"
     R"( \ast & \ast & \ast & -\kappa I \end{bmatrix} \prec 0,\quad)"
     R"( S = P\bar A - \mu W\bar C + \left(P\bar A - \mu W\bar C\right)^\top + \tau^2\kappa M^\top M +)"
     R"( I,\quad L = P^{-1}W)",
     kProposed},
    {"observer/cost",
     "",
     {"What is minimised: gamma alone is ill-posed, so P and the gains are bounded",
      "最小化的目标：仅最小化 γ 是不适定的，因此对 P 与增益加界"},
     R"(\min\sum_i\left(c_d\gamma_{d,i}^2 + c_w\gamma_{w,i}^2 + c_\nu\nu_i\right),\quad p_{\min}I)"
     R"( \prec P_i \prec p_{\max}I,)"
     R"(\quad L_i^\top P_i L_i \prec \nu_i I)",
     {"intermediate_observer", "matched_observer"}},
    {"observer/classical",
     "",
     {"The classical estimator is the same without an innovation in the intermediate variable",
      "经典估计器与此相同，但中间变量中没有新息项"},
     R"(\dot{\hat\theta} = -N c,\quad L_2 = 0,\quad P = \begin{bmatrix} P_\xi & 0 \\ 0 & P_\theta \end{bmatrix})",
     kProposed},
    {"observer/matched",
     "",
     {"The matched observer, and the condition without which it does not exist", "匹配条件观测器，及其存在条件"},
     R"(\hat w = (C D)^{+}\left(\dot y_f - C\left(A\hat x + B u - \alpha\sum_j H_{ij}\hat x_j\right)\right),)"
     R"(\quad \operatorname{rank}(C D) = \operatorname{rank}(D))",
     {"matched_observer"}},
});

}  // namespace
}  // namespace vigil
