#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "benchmark/adaptive_solver.h"

namespace spring_workbench::benchmark {
namespace {

constexpr int kStepStages = 12;  // stages of a step; the 13th is at its end, three more are for dense output
constexpr int kStages = 16;

constexpr double kC[kStages] = {0.0,
                                0.05260015195876773,
                                0.0789002279381516,
                                0.1183503419072274,
                                0.2816496580927726,
                                0.3333333333333333,
                                0.25,
                                0.3076923076923077,
                                0.6512820512820513,
                                0.6,
                                0.8571428571428571,
                                1.0,
                                1.0,
                                0.1,
                                0.2,
                                0.7777777777777778};
constexpr double kA[kStages][kStages] = {
    {0},
    {0.05260015195876773},
    {0.0197250569845379, 0.0591751709536137},
    {0.02958758547680685, 0, 0.08876275643042054},
    {0.2413651341592667, 0, -0.8845494793282861, 0.924834003261792},
    {0.037037037037037035, 0, 0, 0.17082860872947386, 0.12546768756682242},
    {0.037109375, 0, 0, 0.17025221101954405, 0.06021653898045596, -0.017578125},
    {0.03709200011850479, 0, 0, 0.17038392571223998, 0.10726203044637328, -0.015319437748624402, 0.008273789163814023},
    {0.6241109587160757, 0, 0, -3.3608926294469414, -0.868219346841726, 27.59209969944671, 20.154067550477894,
     -43.48988418106996},
    {0.47766253643826434, 0, 0, -2.4881146199716677, -0.590290826836843, 21.230051448181193, 15.279233632882423,
     -33.28821096898486, -0.020331201708508627},
    {-0.9371424300859873, 0, 0, 5.186372428844064, 1.0914373489967295, -8.149787010746927, -18.52006565999696,
     22.739487099350505, 2.4936055526796523, -3.0467644718982196},
    {2.273310147516538, 0, 0, -10.53449546673725, -2.0008720582248625, -17.9589318631188, 27.94888452941996,
     -2.8589982771350235, -8.87285693353063, 12.360567175794303, 0.6433927460157636},
    {0.054293734116568765, 0, 0, 0, 0, 4.450312892752409, 1.8915178993145003, -5.801203960010585, 0.3111643669578199,
     -0.1521609496625161, 0.20136540080403034, 0.04471061572777259},
    {0.056167502283047954, 0, 0, 0, 0, 0, 0.25350021021662483, -0.2462390374708025, -0.12419142326381637,
     0.15329179827876568, 0.00820105229563469, 0.007567897660545699, -0.008298},
    {0.03183464816350214, 0, 0, 0, 0, 0.028300909672366776, 0.053541988307438566, -0.05492374857139099, 0, 0,
     -0.00010834732869724932, 0.0003825710908356584, -0.00034046500868740456, 0.1413124436746325},
    {-0.42889630158379194, 0, 0, 0, 0, -4.697621415361164, 7.683421196062599, 4.06898981839711, 0.3567271874552811, 0,
     0, 0, -0.0013990241651590145, 2.9475147891527724, -9.15095847217987}};
constexpr double kErrorOf5[kStepStages] = {0.01312004499419488,
                                           0,
                                           0,
                                           0,
                                           0,
                                           -1.2251564463762044,
                                           -0.4957589496572502,
                                           1.6643771824549864,
                                           -0.35032884874997366,
                                           0.3341791187130175,
                                           0.08192320648511571,
                                           -0.022355307863886294};
constexpr double kDense[4][kStages] = {
    {-8.428938276109013, 0, 0, 0, 0, 0.5667149535193777, -3.0689499459498917, 2.38466765651207, 2.117034582445028,
     -0.871391583777973, 2.2404374302607883, 0.6315787787694688, -0.08899033645133331, 18.148505520854727,
     -9.194632392478356, -4.436036387594894},
    {10.427508642579134, 0, 0, 0, 0, 242.28349177525817, 165.20045171727028, -374.5467547226902, -22.113666853125306,
     7.733432668472264, -30.674084731089398, -9.332130526430229, 15.697238121770845, -31.139403219565178,
     -9.35292435884448, 35.81684148639408},
    {19.985053242002433, 0, 0, 0, 0, -387.0373087493518, -189.17813819516758, 527.8081592054236, -11.57390253995963,
     6.8812326946963, -1.0006050966910838, 0.7777137798053443, -2.778205752353508, -60.19669523126412,
     84.32040550667716, 11.99229113618279},
    {-25.69393346270375, 0, 0, 0, 0, -154.18974869023643, -231.5293791760455, 357.6391179106141, 93.40532418362432,
     -37.45832313645163, 104.0996495089623, 29.8402934266605, -43.53345659001114, 96.32455395918828, -39.17726167561544,
     -149.72683625798564}};
// Weights of the difference between the methods of order three and eight.
constexpr double kOf3[3] = {0.244094488188976377952755905512, 0.733846688281611857341361741547,
                            0.220588235294117647058823529412e-1};

class Dop853 final : public AdaptiveSolver {
 public:
  Dop853(int size, Rates rates) : rates_(std::move(rates)), k_(size, kStages) {}

  void begin(double t, const std::vector<double>& y, double tolerance, const std::vector<double>& scale) override {
    set_start(t, y, tolerance, scale);
  }

 private:
  bool evaluate(double t, const State& y, int stage) {
    return rates_(t, y.data(), k_.col(stage).data()) && k_.col(stage).allFinite();
  }
  bool stage(double h, int i) {
    State y = y_;
    for (int j = 0; j < i; ++j) {
      if (kA[i][j] != 0.0) y += h * kA[i][j] * k_.col(j);
    }
    return evaluate(t_ + kC[i] * h, y, i);
  }

  /// First step size (Hairer, Nørsett and Wanner, II.4).
  double first_step() {
    const State scale = absolute_ + tolerance_ * y_.cwiseAbs(), f = k_.col(0);
    const double d0 = norm(y_, scale), d1 = norm(f, scale);
    const double h0 = d0 < 1e-5 || d1 < 1e-5 ? 1e-6 : 0.01 * d0 / d1;
    if (!evaluate(t_ + h0, y_ + h0 * f, 1)) return 1e-3 * h0;
    const double d2 = norm(k_.col(1) - f, scale) / h0, most = std::max(d1, d2);
    return std::min(100.0 * h0, most < 1e-15 ? std::max(1e-6, 1e-3 * h0) : std::pow(0.01 / most, 1.0 / 8.0));
  }

  double error(double h, const State& y) const {
    const State scale = absolute_ + tolerance_ * y_.cwiseAbs().cwiseMax(y.cwiseAbs());
    State of5 = State::Zero(y.size()), of3 = (y - y_) / h;
    for (int i = 0; i < kStepStages; ++i) of5 += kErrorOf5[i] * k_.col(i);
    of3 -= kOf3[0] * k_.col(0) + kOf3[1] * k_.col(8) + kOf3[2] * k_.col(11);
    const double e5 = of5.cwiseQuotient(scale).squaredNorm(), e3 = of3.cwiseQuotient(scale).squaredNorm();
    const double sum = e5 + 0.01 * e3;
    return sum > 0.0 ? h * e5 / std::sqrt(sum * static_cast<double>(y.size())) : 0.0;
  }

  void step(double longest) override {
    if (!rates_known_ && !evaluate(t_, y_, 0)) throw std::runtime_error("DOP853: no rates at the start of a step");
    if (h_ == 0.0) h_ = first_step();
    for (bool rejected = false;; rejected = true) {
      if (!(h_ > 1e-14 * std::max(1.0, std::abs(t_))))
        throw std::runtime_error("DOP853: the step has become too small");
      const double h = std::min(h_, longest);
      bool fine = true;
      for (int i = 1; i < kStepStages && fine; ++i) fine = stage(h, i);
      State y = y_;
      for (int j = 0; j < kStepStages; ++j) y += h * kA[kStepStages][j] * k_.col(j);
      const double e = fine ? error(h, y) : std::numeric_limits<double>::infinity();
      const double factor = !std::isfinite(e) ? 0.2 : std::clamp(0.9 * std::pow(std::max(e, 1e-30), -0.125), 0.2, 10.0);
      if (e > 1.0 || !std::isfinite(e)) {
        h_ = h * std::min(factor, 0.9);
        continue;
      }
      if (!evaluate(t_ + h, y, kStepStages)) {
        h_ = 0.5 * h;
        continue;
      }
      const double next = h * (rejected ? std::min(factor, 1.0) : factor);
      h_ = h < h_ ? std::max(h_, next)
                  : next;  // the step was shortened for a stop, so the previous step size is still valid
      accept(h, y);
      return;
    }
  }

  void accept(double h, const State& y) {
    before_ = t_;
    from_ = y_;
    t_ += h;
    y_ = y;
    dense_ = false;
    first_ = k_.col(0);
    k_.col(0) = k_.col(kStepStages);
    rates_known_ = true;
  }

  /// Evaluates the polynomial of the last step, which takes three more evaluations once.
  State within_last_step(double share) override {
    if (!dense_) make_dense(t_ - before_);
    State y = share * polynomial_[6];
    for (int i = 5; i >= 0; --i) y = (i % 2 == 0 ? share : 1.0 - share) * (polynomial_[i] + y);
    return from_ + y;
  }

  void make_dense(double h) {
    const State end = k_.col(0);
    k_.col(0) = first_;
    for (int i = kStepStages + 1; i < kStages; ++i) {
      State y = from_;
      for (int j = 0; j < i; ++j) {
        if (kA[i][j] != 0.0) y += h * kA[i][j] * k_.col(j);
      }
      if (!evaluate(before_ + kC[i] * h, y, i)) throw std::runtime_error("DOP853: no rates for the dense output");
    }
    const State change = y_ - from_;
    polynomial_[0] = change;
    polynomial_[1] = h * first_ - change;
    polynomial_[2] = 2.0 * change - h * (first_ + end);
    for (int i = 0; i < 4; ++i) {
      polynomial_[3 + i].setZero(change.size());
      for (int j = 0; j < kStages; ++j) polynomial_[3 + i] += h * kDense[i][j] * k_.col(j);
    }
    k_.col(0) = end;
    dense_ = true;
  }

  Rates rates_;
  Eigen::Matrix<double, Eigen::Dynamic, kStages, 0, max_equations, kStages> k_;
  State from_, first_;  ///< start of the last step, and the rates there
  State polynomial_[7];
  bool dense_ = false;  ///< whether the polynomial of the last step is known
};

}  // namespace

std::unique_ptr<OdeSolver> make_dop853(int size, OdeSolver::Rates rates) {
  return std::make_unique<Dop853>(size, std::move(rates));
}

}  // namespace spring_workbench::benchmark
