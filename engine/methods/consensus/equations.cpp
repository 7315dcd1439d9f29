/// Equations of seed 000; numbers are its own. Specification (consensus), sections 2 to 7 and 10.
#include "engine/methods/equation.hpp"

namespace vigil {
namespace {

const std::vector<std::string> kFilter{"consensus_ekf"};

const EquationsRegistration world({
    {"consensus/43",
     "(43)-(45)",
     {"The robot's motion by its wheels; kappa is radians per unit of the heading, s the mean of both wheels' ways",
      "机器人按两轮位移的运动；κ 为航向单位对应的弧度，s 为两轮位移的平均"},
     R"(\begin{aligned} x^+ &= x + s\cos\kappa\theta + w_x \\ y^+ &= y + s\sin\kappa\theta + w_y \\)"
     R"( \theta^+ &= \theta + \frac{s^R - s^L}{b\,\kappa} + w_\theta \end{aligned})"},
    {"consensus/46",
     "(46), (47)",
     {"What a camera at (x + Delta x, y + Delta y) sees of it", "位于 (x + Δx, y + Δy) 处的摄像机所见"},
     R"(\begin{aligned} p &= \frac{\gamma_u}{z}\left(-\Delta x\sin\kappa\theta + \Delta)"
     R"( y\cos\kappa\theta - d_2\right) + p_0 + v_p \\)"
     R"( q &= \frac{\gamma_v}{z}\left(-\Delta x\cos\kappa\theta - \Delta y\sin\kappa\theta -)"
     R"( d_1\right) + q_0 + v_q \end{aligned})"},
    {"consensus/6",
     "(6)",
     {"What arrives from neighbour j: nothing under DoS (phi = 1), shifted under false data (gamma = 1)",
      "来自邻居 j 的数据包：拒绝服务（φ = 1）时丢失，虚假数据注入（γ = 1）时被偏移"},
     R"((1 - \phi_{ij})\left(\hat x_{j,k+1|k} + \gamma_{ij}\,\xi_{ij}\right))",
     kFilter},
    {"consensus/signal",
     "",
     {"Strength of the injected vector, drawn anew for every channel and tick",
      "注入向量的强度，每个信道、每个时刻重新抽取"},
     R"(\xi_{ij} = \sin(s_{ij})\,\bar\xi,\quad s_{ij} \sim \mathcal{N}(0, s_{\text{std}}^2))"},
    {"consensus/rmse",
     "",
     {"Network RMSE over N nodes, T steps and M runs", "N 个节点、T 步、M 次运行的网络均方根误差"},
     R"(\sqrt{\frac{1}{N T M}\sum_{i,k,r} \left(e_{x}^2 + e_{y}^2\right)})"},
});

const EquationsRegistration filter({
    {"consensus/7",
     "(7)",
     {"The estimate: own reading, and a pull towards the predictions that came",
      "估计：自身量测，加上向已收到的邻居预测靠拢的一致项"},
     R"(\hat x_{i,k+1|k+1} = \hat x_{i,k+1|k} + K_i\left(z_{i,k+1} - h_i(\hat x_{i,k+1|k})\right))"
     R"( + C_i\sum_{j\in\mathcal{N}_i}(1-\phi_{ij})\left(\hat x_{j,k+1|k} + \gamma_{ij}\xi_{ij} - \hat)"
     R"( x_{i,k+1|k}\right),)"
     R"(\quad C_i = \tau\,\Phi_{i,k+1|k})",
     kFilter},
    {"consensus/26",
     "(26)",
     {"Upper bound of the prediction's error covariance", "预测误差协方差的上界"},
     R"(\Phi_{i,k+1|k} = F\left[\Phi_{i,k|k}^{-1} - (1+\varepsilon)\sigma I\right]^{-1}F^\top)"
     R"( + \frac{1}{\varepsilon\sigma}U U^\top + Q)",
     kFilter},
    {"consensus/27",
     "(27)",
     {"Upper bound of the estimate's; as printed the multipliers are 1 + 2d, 3, 3, valid for one neighbour only",
      "估计误差协方差的上界；原文系数为 1 + 2d、3、3，仅对单个邻居成立"},
     R"(\begin{aligned} \Phi_{i,k+1|k+1} &= m_0\,G M G^\top +)"
     R"( m_n(1-\bar\phi)\,C_i\left(\sum_{j\in\mathcal{N}_i}\Phi_{j,k+1|k}\right)C_i^\top)"
     R"( + m_a d_i\delta^2\bar\gamma\,C_i C_i^\top + K_i\left(\frac{m_0}{\beta}V V^\top + R\right)K_i^\top \\)"
     R"( G &= B - K_i H,\quad B = I - n_i C_i,\quad M = \left(\Phi_{i,k+1|k}^{-1} - \beta)"
     R"( I\right)^{-1} \end{aligned})",
     kFilter},
    {"consensus/28",
     "(28), (29)",
     {"Conditions of the theorem; they fail at step 2 of the paper's own example, so a guard keeps to them",
      "定理的条件；论文自身算例在第 2 步即不满足，因此由保护环节维持"},
     R"(\lambda_{\max}\left(\Phi_{i,k|k}\right) < \frac{1}{(1+\varepsilon)\sigma},\quad)"
     R"( \lambda_{\max}\left(\Phi_{i,k+1|k}\right) < \frac{1}{\beta})",
     kFilter},
    {"consensus/30",
     "(30)",
     {"Gain: the minimum of the trace of (27)", "增益：使 (27) 的迹最小"},
     R"(K_i = B M H^\top\left(H M H^\top + \frac{1}{\beta}V V^\top + \frac{1}{m_0}R\right)^{-1})",
     kFilter},
});

const EquationsRegistration ordinary({
    {"consensus/ekf",
     "",
     {"An ordinary extended Kalman filter, for comparison", "用作对比的普通扩展卡尔曼滤波"},
     R"(\begin{aligned} \hat x^- &= f(\hat x, u),\quad P^- = F P F^\top + Q \\)"
     R"( K &= P^- H^\top\left(H P^- H^\top + R\right)^{-1},\quad \hat x = \hat x^- + K\left(z - h(\hat)"
     R"( x^-)\right) \\)"
     R"( P &= (I - K H)P^-(I - K H)^\top + K R K^\top \end{aligned})",
     {"local_ekf", "centralized_ekf", "window_ekf"}},
    {"consensus/dead",
     "",
     {"The known input integrated, no reading used", "只积分已知输入，不用任何量测"},
     R"(\hat x^+ = f(\hat x, u),\quad P^+ = F P F^\top + Q)",
     {"dead_reckoning"}},
});

}  // namespace
}  // namespace vigil
