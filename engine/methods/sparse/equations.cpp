/// Equations of seed 001; numbers are its own. Specification (sparse), sections 3 to 11 and 13.
#include "engine/methods/equation.hpp"

namespace vigil {
namespace {

const std::vector<std::string> kWindow{"omp_game", "omp_game_channels", "omp_ekf", "l1_ekf", "etpg_ekf"};
const std::vector<std::string> kGame{"omp_game", "omp_game_channels"};

const EquationsRegistration world({
    {"sparse/1",
     "(1)",
     {"The target under state feedback, known to every station", "状态反馈下的目标，各站点已知其模型"},
     R"(x(k+1) = \bar A\,x(k) + w(k),\quad \bar A = A + B G,\quad w \sim \mathcal{N}(0, Q))"},
    {"sparse/2",
     {"(2)", true},
     {"What a station reads: range, azimuth, elevation, velocity; the quadrant is kept by atan2",
      "站点的量测：距离、方位、俯仰与速度；以 atan2 保留象限"},
     R"(y = \left[\rho,\; \operatorname{atan2}(\Delta y,\Delta x),\; \operatorname{atan2}(\Delta)"
     R"( z,\rho_2),\; v_x,\; v_y,\; v_z\right]^\top)"
     R"( + e + v,\quad \rho_2 = \sqrt{\Delta x^2 + \Delta y^2})"},
    {"sparse/jacobian",
     {"", true},
     {"Its derivatives of azimuth and elevation; the printed ones divide by rho_2, and have rho_2 squared",
      "方位与俯仰对位置的导数；原文分别误作除以 ρ₂ 与 ρ₂²"},
     R"(\frac{\partial\psi}{\partial(p_x,p_y)} = \frac{(-\Delta y,\; \Delta x)}{\rho_2^2},\quad)"
     R"( \frac{\partial\vartheta}{\partial p_z} = \frac{\rho_2}{\rho^2})"},
    {"sparse/attacks",
     "Table 1",
     {"Attacks of type I and II on range and azimuth; psi is constant over a run",
      "对距离与方位的 I 型与 II 型攻击；ψ 在一次运行中不变"},
     R"(e_{\mathrm{I}} = \left[\mathcal{U}(-5,5),\; \mathcal{U}(0,2\pi),\; 0,0,0,0\right]^\top,\quad)"
     R"( e_{\mathrm{II}} = \left[10 + \mathcal{U}(-5,5),\; \psi,\; 0,0,0,0\right]^\top)"},
    {"sparse/graph",
     "",
     {"An undirected graph: whom a station hears, itself left out", "无向图：站点所听取的邻居，不含自身"},
     R"(\mathcal{N}_i = \{j \ne i \mid (i,j)\in\mathcal{E}\},\quad (i,j)\in\mathcal{E})"
     R"( \;\Leftrightarrow\; (j,i)\in\mathcal{E})"},
    {"sparse/mse",
     "Table 2",
     {"Mean squared error of the x position at station i", "站点 i 的 x 方向位置均方误差"},
     R"(\frac{1}{200}\sum_{k=1}^{200}\left(\hat p_{x,i}(k) - p_x(k)\right)^2)"},
});

const EquationsRegistration window({
    {"sparse/4",
     "(4)",
     {"The last T readings, linearised and stacked: a deviation and a sparse attack",
      "最近 T 个量测线性化后堆叠：状态偏差加稀疏攻击"},
     R"(r = \Phi\,\delta x + E + v,\quad \Phi = \left[C_0;\; C_1\bar A;\; \ldots;\; C_{T-1}\bar A^{T-1}\right])",
     kWindow},
    {"sparse/6",
     "(6)",
     {"The state projected out, and the sparsest attack that explains the rest, by matching pursuit",
      "投影消去状态，再以匹配追踪求能解释余量的最稀疏攻击"},
     R"(M = I - Q_1 Q_1^\top,\; \Phi = Q_1 R_1:\quad \min_E \lVert E\rVert_0 \;\text{ subject to }\;)"
     R"( \lVert M(r - E)\rVert_2 \le \epsilon)",
     {"omp_game", "omp_game_channels", "omp_ekf"}},
    {"sparse/epsilon",
     "",
     {"Where matching pursuit stops, of m = pT - n independent numbers; the text always makes qT steps",
      "匹配追踪的停止门限，m = pT − n；原文总是执行 qT 步"},
     R"(\epsilon = \kappa\,\sigma\sqrt{m + 2\sqrt{m\ln m}})",
     {"omp_game", "omp_game_channels", "omp_ekf"}},
    {"sparse/update",
     "",
     {"The attack's newest part is taken off the innovation", "从新息中减去攻击的最新部分"},
     R"(\hat x = \hat x^- + K\left(\nu - E_{T-1}\right))",
     kWindow},
    {"sparse/7",
     {"(7)", true},
     {"Utility of copying j: a small attack, and one whose places the neighbours agree with. Printed, the logarithm's "
      "argument is negative",
      "采用 j 的估计的效用：攻击小，且其支撑与邻居一致。原文对数的自变量为负"},
     R"(U_i(j) = -r\ln\max\left(\max_c \lvert E_j(c)\rvert,\; U_0\right))"
     R"( - \sum_{l\in\mathcal{N}_i}\left\lVert [E_j \ne 0]\oplus[E_l \ne 0]\right\rVert_1)",
     kGame},
    {"sparse/9",
     "(9)",
     {"Probability of taking the estimate of j", "采用 j 的估计的概率"},
     R"(\pi_i(j) =)"
     R"( \frac{\exp\left(\beta\,U_i(j)\right)}{\sum_{l\in\mathcal{N}_i\cup\{i\}}\exp\left(\beta\,U_i(l)\right)})",
     kGame},
});

const EquationsRegistration rivals({
    {"sparse/a2",
     "",
     {"A2: the attack of smallest sum of magnitudes that explains the window exactly",
      "A2：精确解释窗口数据且绝对值之和最小的攻击"},
     R"(\min_E \lVert E\rVert_1 \;\text{ subject to }\; M E = M r)",
     {"l1_ekf"}},
    {"sparse/a3",
     "",
     {"A3: the neighbourhood's information fused, and a pull towards its predictions",
      "A3：融合邻域信息，并向其预测靠拢"},
     R"(\hat x_i = \bar x_i + M_i\left(y_i - S_i\bar x_i\right) + \gamma_i)"
     R"( P_i\sum_{j\in\mathcal{N}_i}\left(\bar x_j - \bar x_i\right),)"
     R"(\quad M_i = \left(P_i^{-1} + S_i\right)^{-1})",
     {"kalman_consensus"}},
    {"sparse/a4",
     "",
     {"A4: gradient steps for state and attack together; the attack is projected on the q strongest channels when the "
      "cost has fallen",
      "A4：对状态与攻击同时作梯度步；代价下降到位时把攻击投影到 q 个最强通道"},
     R"(g = r - \Phi x - E,\quad x \leftarrow x + \eta\,\Phi^\top g,\quad E \leftarrow E + \eta\,g,)"
     R"(\quad V = \frac{1}{2}\lVert g\rVert^2)",
     {"etpg_ekf"}},
    {"sparse/a5",
     "",
     {"A5: each station adapts, then averages over the neighbours it trusts", "A5：各站点先自适应，再对可信邻居取平均"},
     R"(\psi_i = \bar A w_i + \mu\,C_i^\top\left(y_i - h_i(\bar A w_i)\right),\quad w_i =)"
     R"( \frac{1}{\lvert\mathcal{T}_i\rvert}\sum_{l\in\mathcal{T}_i}\psi_l)",
     {"diffusion_lms"}},
});

}  // namespace
}  // namespace vigil
