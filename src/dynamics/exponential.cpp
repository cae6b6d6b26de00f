#include "exponential.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear_part.h"
#include "spring_workbench/math/collocation.h"

namespace spring_workbench::dynamics {
namespace {

constexpr std::size_t nodes = math::Collocation::count;
constexpr std::size_t last = nodes - 1;

constexpr int most_iterations = 12;
constexpr int most_halvings = 4;
/// A step that takes no more sweeps than this is at its best. When the others' sweeps beyond it have cost what a linear
/// part costs, it is taken anew.
constexpr int few_iterations = 3;
constexpr int refactorisation_budget = 150;
/// Sweeps stop when what they would still change is below this share of the error that the cubic itself makes, or below
/// this share of the strain.
constexpr double share_of_error = 0.5;
constexpr double share_of_strain = 1e-12;
/// Squared, of the last step's cubic's error: a sweep that leaves more is not the last one.
constexpr double far_from_done = 25.0;
/// From the sixth sweep on, one that leaves more than this of the last one's change will not come to an end soon.
constexpr double slow_contraction = 0.7;
constexpr int iterations_to_judge = 5;
/// The most that the sweeps' own way is continued by, of a sweep.
constexpr double most_continued = 3.0;
/// Of a determinant to what it is at most: below this the ways of two pairs of sweeps are one.
constexpr double least_independence = 1e-3;
/// From one step to the next the sweeps' contraction, where it is not measured, is taken to get worse by this factor.
constexpr double forget_contraction = 1.3;
/// The last step's cubic is continued to this many times its length, and no further.
constexpr double farthest_continued = 1.5;
/// Steps whose lengths differ by less are equal: what differs is rounding of times.
constexpr double same_length = 1e-11;
/// The same for the start of a step and the end of the last one, as a share of the step, and for the handle's
/// acceleration.
constexpr double same_time = 1e-9;
constexpr double same_acceleration = 1e-12;

bool same(const Vector3d& a, const Vector3d& b) {
  return (a - b).cwiseAbs().maxCoeff() <= same_acceleration * b.cwiseAbs().maxCoeff();
}

/// `A x` for sizes that the compiler knows: all of it in registers.
template <int rows, int columns>
SPRING_WORKBENCH_INLINE Eigen::Matrix<double, rows, 1> times(const Eigen::Matrix<double, rows, columns>& A,
                                                             const Eigen::Matrix<double, columns, 1>& x) {
  Eigen::Matrix<double, rows, 1> y = A.col(0) * x[0];
  for (int j = 1; j < columns; ++j) y += A.col(j) * x[j];
  return y;
}

}  // namespace

class Exponential::Core {
 public:
  virtual ~Core() = default;
  virtual StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                            StrainState& state) = 0;
  virtual bool response(const HeldBody& body, double h, Response& r) = 0;
  virtual void exchange(math::StateArchive& state) = 0;
};

template <int n>
class Exponential::CoreOf final : public Core {
 public:
  StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                    StrainState& state) override {
    State s{state.q, state.q_dot};
    const Estimate e = step(body, handle, t, h, s, 0);
    state.q = s.q;
    state.q_dot = s.q_dot;
    return {e.error.template head<n>(), linear_.fastest * h, e.error.template tail<n>()};
  }

  bool response(const HeldBody& body, double h, Response& r) override {
    if (version_ != body.version()) return false;
    prepare(h);
    // The remainder is M⁻¹ Q at all nodes.
    Eigen::Matrix<double, 2 * n, n> modes;
    for (int i = 0; i < n; ++i) {
      NodeModes constant, x;
      for (int m = 0; m < 2 * n; ++m) constant[at(m)] = math::Pack{} + force_to_modes_(m, i);
      drive(NodeModes{}, constant, x);
      modes.col(i) = at_node(last, x);
    }
    const Eigen::Matrix<double, 2 * n, n> end = from_modes_ * modes * linear_.inverse_mass;
    r.q = end.template topRows<n>();
    r.q_dot = end.template bottomRows<n>();
    return true;
  }

  /// Not the sweeps themselves: each step begins its own.
  void exchange(math::StateArchive& state) override {
    state(version_);
    if (version_ < 0) return;  // nothing derived yet
    state(load_version_, linear_, q_reference_, stiffness_, damping_, to_modes_, from_modes_, force_to_modes_);
    state(h_, squared_weight_, decay_, node_, error_, nonlinear_residual_, contraction_, squared_cubic_);
    state(slow_iterations_, last_h_, t_end_, end_, end_acceleration_, end_angular_acceleration_, continued_ratio_,
          continued_);
  }

 private:
  using Strain = Eigen::Matrix<double, n, 1>;
  using Modes = Eigen::Matrix<double, 2 * n, 1>;
  using Square = Eigen::Matrix<double, n, n>;

  struct State {
    Strain q = Strain::Zero(), q_dot = Strain::Zero();
    void exchange(math::StateArchive& state) { state(q, q_dot); }
  };
  struct Estimate {
    Modes error = Modes::Zero();  ///< of the resulting strain and strain rate
    bool converged = false;
  };
  /// Modes, strains or strain rates at the nodes: a pack each.
  using NodeModes = std::array<math::Pack, 2 * n>;
  using NodeStrains = std::array<math::Pack, n>;
  /// A function of the linear part, in modes: x ↦ own x + other x with the members of each pair exchanged.
  template <typename S>
  struct Operator {
    std::array<S, 2 * n> own{}, other{};
    template <typename Other>
    SPRING_WORKBENCH_INLINE S of(const Other& x, int m) const {
      return own[at(m)] * x(m) + other[at(m)] * x(m ^ 1);
    }
    void exchange(math::StateArchive& state) { state(own, other); }
  };
  template <typename S>
  static void set(Operator<S>& o, std::size_t lane_of, int mode, double value) {
    math::set_lane(o.own[at(mode)], static_cast<int>(lane_of), value);
    math::set_lane(o.other[at(mode)], static_cast<int>(lane_of), 0.0);
  }
  template <typename S>
  static void set(Operator<S>& o, std::size_t lane_of, int mode, std::complex<double> value) {  // z = x₀ − i x₁
    const int k = static_cast<int>(lane_of);
    math::set_lane(o.own[at(mode)], k, value.real());
    math::set_lane(o.own[at(mode + 1)], k, value.real());
    math::set_lane(o.other[at(mode)], k, value.imag());
    math::set_lane(o.other[at(mode + 1)], k, -value.imag());
  }
  static constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }
  SPRING_WORKBENCH_INLINE static Modes at_node(std::size_t i, const NodeModes& x) {
    Modes r;
    for (int m = 0; m < 2 * n; ++m) r[m] = x[at(m)][i];
    return r;
  }

  void linearise(const HeldBody& body, const HandleForcing& handle, const Strain& q) {
    const LinearPart part = linear_part(body, handle, q);
    if (version_ == body.version() && !(part.to_modes.allFinite() && part.from_modes.allFinite())) return;
    linear_ = part;
    version_ = body.version();
    load_version_ = body.load_version();
    q_reference_ = q;
    stiffness_ = linear_.stiffness;
    damping_ = linear_.damping;
    to_modes_ = linear_.to_modes;
    force_to_modes_ = to_modes_.template rightCols<n>();
    from_modes_ = linear_.from_modes;
    h_ = 0.0;
    t_end_ = std::numeric_limits<double>::quiet_NaN();
    contraction_ = 1.0;
    slow_iterations_ = 0;
    squared_cubic_ = std::numeric_limits<double>::infinity();
  }

  /// The operators for a step of h.
  void prepare(double h) {
    if (std::abs(h - h_) <= same_length * h) return;
    h_ = h;
    for (int m = 0; m < 2 * n; ++m) {
      const double weight = 1.0 / std::max(1.0 / h, std::abs(linear_.rates[at(m)]));
      squared_weight_[m] = weight * weight;
    }
    const auto take = [this, h](int m, const auto& w) {
      for (std::size_t i = 0; i < nodes; ++i) {
        set(decay_, i, m, w.decay[i]);
        for (std::size_t j = 0; j < nodes; ++j) set(node_[j], i, m, h * w.node[i][j]);
      }
      set(error_, 0, m, h * w.error);
    };
    for (int m = 0; m < 2 * linear_.pairs; m += 2) take(m, math::Collocation::weights(h * linear_.rates[at(m)]));
    for (int m = 2 * linear_.pairs; m < 2 * n; ++m)
      take(m, math::Collocation::weights(h * linear_.rates[at(m)].real()));
  }

  SPRING_WORKBENCH_INLINE Modes modes_of(const State& s) const {
    Modes y;
    y << s.q - q_reference_, s.q_dot;
    return times(to_modes_, y);
  }
  SPRING_WORKBENCH_INLINE State state_of(const Modes& x) const {
    const Modes y = times(from_modes_, x);
    return {y.template head<n>() + q_reference_, y.template tail<n>()};
  }
  /// What the linear part leaves over of the acceleration, in modes.
  Modes nonlinear_residual(const HeldBody& body, const HandleForcing& handle, const State& s) const {
    const Strain r = body.template acceleration<n>(handle, s.q, s.q_dot) +
                     times(stiffness_, Strain(s.q - q_reference_)) + times(damping_, s.q_dot);
    return times(force_to_modes_, r);
  }
  /// The same at the nodes.
  SPRING_WORKBENCH_INLINE void nonlinear_residual(const HeldBody& body, const HandleForcings& handle,
                                                  const NodeModes& x, NodeModes& result) const {
    NodeStrains moved, rate, q, r;
    for (int i = 0; i < n; ++i) {
      moved[at(i)] = from_modes_(i, 0) * x[0];
      rate[at(i)] = from_modes_(n + i, 0) * x[0];
      for (int m = 1; m < 2 * n; ++m) {
        moved[at(i)] += from_modes_(i, m) * x[at(m)];
        rate[at(i)] += from_modes_(n + i, m) * x[at(m)];
      }
      q[at(i)] = moved[at(i)] + q_reference_[i];
    }
    body.template acceleration<n>(handle, q.data(), rate.data(), r.data());
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) r[at(i)] += stiffness_(i, j) * moved[at(j)] + damping_(i, j) * rate[at(j)];
    }
    for (int m = 0; m < 2 * n; ++m) {
      result[at(m)] = force_to_modes_(m, 0) * r[0];
      for (int i = 1; i < n; ++i) result[at(m)] += force_to_modes_(m, i) * r[at(i)];
    }
  }
  /// Modes `x` at the nodes under the cubic through these remainders; `start`: what they are without.
  SPRING_WORKBENCH_INLINE void drive(const NodeModes& start, const NodeModes& remainders, NodeModes& x) const {
    for (int m = 0; m < 2 * n; ++m) {
      const math::Pack own = remainders[at(m)], other = remainders[at(m ^ 1)];
      math::Pack sum = start[at(m)];
      for (std::size_t j = 0; j < nodes; ++j) {
        sum += node_[j].own[at(m)] * own[j] + node_[j].other[at(m)] * other[j];
      }
      x[at(m)] = sum;
    }
  }
  /// Squared size of what is in modes [m² kg]: displacements as they are, velocities times what is left of them over a
  /// step.
  SPRING_WORKBENCH_INLINE double squared_size(const Modes& x) const { return squared_weight_.dot(x.cwiseAbs2()); }
  SPRING_WORKBENCH_INLINE math::Pack squared_size(const NodeModes& x, const NodeModes& y) const {
    math::Pack sum{};
    for (int m = 0; m < 2 * n; ++m) sum += squared_weight_[m] * x[at(m)] * y[at(m)];
    return sum;
  }

  /// Whether a step from here goes on from the last one.
  bool goes_on(double t, const State& s) const {
    return std::abs(t - t_end_) <= same_time * last_h_ && s.q == end_.q && s.q_dot == end_.q_dot;
  }

  /// Remainders at the nodes from the cubic of the last step, moved to fit at the start.
  SPRING_WORKBENCH_INLINE void extrapolate_polynomial(double h) {
    const double ratio = last_h_ / h;
    if (ratio != continued_ratio_) {
      continued_ratio_ = ratio;
      const auto rows = math::Collocation::continued(ratio);
      for (std::size_t i = 0; i < nodes; ++i) {
        for (std::size_t j = 0; j < nodes; ++j) continued_[j][i] = i == 0 ? 0.0 : rows[i][j] - (j == last ? 1.0 : 0.0);
      }
    }
    for (int m = 0; m < 2 * n; ++m) {
      const math::Pack before = nonlinear_residual_[at(m)];
      math::Pack x = math::Pack{} + start_residual_[m];
      for (std::size_t j = 0; j < nodes; ++j) x += continued_[j] * before[j];
      nonlinear_residual_[at(m)] = x;
    }
  }

  /// Error of the cubic: its fourth difference, taken to follow on the second and third in a geometric series.
  SPRING_WORKBENCH_INLINE Modes cubic_error() const {
    const auto difference = [this](const math::Collocation::Row& row) {
      Modes d;
      for (int m = 0; m < 2 * n; ++m) {
        const math::Pack& x = nonlinear_residual_[at(m)];
        d[m] = row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + row[3] * x[3];
      }
      return d;
    };
    const Modes third = difference(math::Collocation::third_difference());
    const double second = difference(math::Collocation::second_difference()).squaredNorm();
    const double third_size = third.squaredNorm();
    const double ratio = third_size < second ? std::sqrt(third_size / second) : 1.0;
    Modes e;
    for (int m = 0; m < 2 * n; ++m) e[m] = ratio * error_.of([&](int k) { return third[k]; }, m);
    return e;
  }

  Estimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h, State& state,
                int halvings) {
    constexpr auto& c = math::Collocation::nodes;
    const HandleForcings forcing = body.forcing(handle, t + math::Pack{c[0], c[1], c[2], c[3]} * h);
    const State begin = state;
    if (version_ != body.version() || (slow_iterations_ > refactorisation_budget && state.q != q_reference_)) {
      linearise(body, forcing.at(0), state.q);
    }
    Estimate e = iterate(body, forcing, h, state);
    if (e.converged) return e;
    if (begin.q != q_reference_) {
      linearise(body, forcing.at(0), begin.q);
      state = begin;
      e = iterate(body, forcing, h, state);
    }
    if (e.converged || halvings == most_halvings) return e;
    state = begin;
    e = step(body, handle, t, 0.5 * h, state, halvings + 1);
    if (!state.q.allFinite() || !state.q_dot.allFinite()) return e;
    const Estimate second = step(body, handle, t + 0.5 * h, 0.5 * h, state, halvings + 1);
    e.error += second.error;
    e.converged = e.converged && second.converged;
    return e;
  }

  /// The remainders at the nodes, as far as they are known before the first sweep.
  SPRING_WORKBENCH_INLINE void predict(const HeldBody& body, const HandleForcings& forcing, double h,
                                       const State& state) {
    const bool follows = goes_on(forcing.t[0], state);
    const bool known = follows && load_version_ == body.load_version() &&
                       same(end_acceleration_, math::vector(forcing.of_H.a_B, 0)) &&
                       same(end_angular_acceleration_, math::vector(forcing.of_H.alpha_B, 0));
    start_residual_ = known ? at_node(last, nonlinear_residual_) : nonlinear_residual(body, forcing.at(0), state);
    if (follows && h < farthest_continued * last_h_) {
      extrapolate_polynomial(h);
    } else {
      for (int m = 0; m < 2 * n; ++m) nonlinear_residual_[at(m)] = math::Pack{} + start_residual_[m];
    }
  }

  /// Sweeps, from the second on continued along the way that they take (Anderson's acceleration of depth two).
  SPRING_WORKBENCH_WIDE Estimate iterate(const HeldBody& body, const HandleForcings& forcing, double h, State& state) {
    prepare(h);
    const Modes x0 = modes_of(state);
    predict(body, forcing, h, state);
    NodeModes start, x;
    for (int m = 0; m < 2 * n; ++m) start[at(m)] = decay_.of([&](int k) { return x0[k]; }, m);

    Estimate e;
    drive(start, nonlinear_residual_, x);
    const double squared_start = squared_size(x0);
    double all_before = 0.0;
    int iterations = 0;
    while (iterations < most_iterations && !e.converged) {
      ++iterations;
      Swept& now = swept_[iterations % 3];
      const Swept& before = swept_[(iterations + 2) % 3];
      nonlinear_residual(body, forcing, x, nonlinear_residual_);
      drive(start, nonlinear_residual_, now.x);
      for (int m = 0; m < 2 * n; ++m) now.moved[at(m)] = now.x[at(m)] - x[at(m)];
      const math::Pack squares = squared_size(now.moved, now.moved);
      const double squared_change = squares[last], all = squares[1] + squares[2] + squares[3];
      if (!(all < 1e300)) break;
      const double squared_rounding =
          share_of_strain * share_of_strain * std::max(squared_size(now.x, now.x)[last], squared_start);
      double contraction = std::min(1.0, contraction_ * forget_contraction);
      if (iterations > 1 && squared_change > squared_rounding) {
        contraction = std::sqrt(all / all_before);
        if (iterations == 2) contraction_ = contraction;
        if (iterations > iterations_to_judge && contraction > slow_contraction) break;
      } else if (iterations == 2) {
        contraction_ = std::sqrt(std::max(all, squared_rounding) / all_before);  // no more than this
      }
      const double left = contraction < 1.0 ? contraction / (1.0 - contraction) : 1e3;  // of the change
      const double squared_left = left * left * squared_change;
      e.converged = squared_change <= squared_rounding || squared_left <= squared_rounding;
      // Where the last step's cubic tells that this is not the last sweep, this one's is not asked.
      if (e.converged || iterations == most_iterations || squared_left < far_from_done * squared_cubic_) {
        const Modes polynomial = cubic_error();
        squared_cubic_ = squared_size(polynomial);
        e.converged = e.converged || squared_left <= share_of_error * share_of_error * squared_cubic_;
        e.error = -(polynomial + left * at_node(last, now.moved));
      }
      if (iterations > 1) {
        continue_sweeps(now, before, iterations > 2 ? &swept_[(iterations + 1) % 3] : nullptr, x);
      } else {
        x = now.x;
      }
      all_before = all;
    }
    if (iterations == 1) contraction_ = std::min(1.0, contraction_ * forget_contraction);
    slow_iterations_ += std::max(0, iterations - few_iterations);
    e.error = times(from_modes_, e.error);
    state = state_of(at_node(last, x));
    last_h_ = h;
    t_end_ = forcing.t[last];
    end_ = state;
    load_version_ = body.load_version();
    end_acceleration_ = math::vector(forcing.of_H.a_B, static_cast<int>(last));
    end_angular_acceleration_ = math::vector(forcing.of_H.alpha_B, static_cast<int>(last));
    return e;
  }

  /// What comes out of a sweep, and by how much it differs from what went in.
  struct Swept {
    NodeModes x, moved;
  };
  /// From three sweeps, or two where `first` is null, where the next one is to start.
  SPRING_WORKBENCH_INLINE void continue_sweeps(const Swept& now, const Swept& before, const Swept* first,
                                               NodeModes& x) const {
    math::Pack dd{}, dn{}, de{}, ee{}, en{};  // of d = moved less the last, e = the last less the one before, n = moved
    for (int m = 0; m < 2 * n; ++m) {
      const math::Pack w = squared_weight_[m] + math::Pack{}, moved = now.moved[at(m)], d = moved - before.moved[at(m)];
      dd += w * d * d;
      dn += w * d * moved;
      if (first == nullptr) continue;
      const math::Pack e = before.moved[at(m)] - first->moved[at(m)];
      de += w * d * e;
      ee += w * e * e;
      en += w * e * moved;
    }
    const auto sum = [](const math::Pack& p) { return p[1] + p[2] + p[3]; };
    const double determinant = sum(dd) * sum(ee) - sum(de) * sum(de);
    const bool both = determinant > least_independence * sum(dd) * sum(ee);
    double last_share = sum(dn) / sum(dd), first_share = 0.0;
    if (both) {
      last_share = (sum(dn) * sum(ee) - sum(en) * sum(de)) / determinant;
      first_share = (sum(en) * sum(dd) - sum(dn) * sum(de)) / determinant;
    }
    if (!(std::abs(last_share) + std::abs(first_share) < most_continued)) last_share = first_share = 0.0;
    for (int m = 0; m < 2 * n; ++m) x[at(m)] = now.x[at(m)] - last_share * (now.x[at(m)] - before.x[at(m)]);
    if (first_share == 0.0) return;
    for (int m = 0; m < 2 * n; ++m) x[at(m)] -= first_share * (before.x[at(m)] - first->x[at(m)]);
  }

  LinearPart linear_;
  long version_ = -1;
  Strain q_reference_;
  Square stiffness_, damping_;
  Eigen::Matrix<double, 2 * n, 2 * n> to_modes_, from_modes_;
  Eigen::Matrix<double, 2 * n, n> force_to_modes_;

  double h_ = 0.0;  ///< what the operators are for
  Modes squared_weight_ = Modes::Zero();
  Operator<math::Pack> decay_;                      ///< to the nodes
  std::array<Operator<math::Pack>, nodes> node_{};  ///< of the remainder at each node
  Operator<double> error_;

  Swept swept_[3];                  ///< the last sweeps, in turns
  NodeModes nonlinear_residual_{};  ///< at the nodes of this step, or the last one
  Modes start_residual_;
  double contraction_ = 1.0;    ///< of the first sweep's change by the second
  double squared_cubic_ = 0.0;  ///< size of the cubic's error in the last step
  int slow_iterations_ = 0;     ///< beyond few_iterations, with this linear part
  double last_h_ = 0.0, t_end_ = 0.0;
  State end_;
  long load_version_ = -1;
  Vector3d end_acceleration_ = Vector3d::Zero(), end_angular_acceleration_ = Vector3d::Zero();
  double continued_ratio_ = 0.0;
  std::array<math::Pack, nodes> continued_{};
};

Exponential::Exponential() = default;
Exponential::~Exponential() = default;

Exponential::Core& Exponential::core(int n) {
  if (n != n_) {
    n_ = n;
    switch (n) {
      case 1:
        core_ = std::make_unique<CoreOf<1>>();
        break;
      case 2:
        core_ = std::make_unique<CoreOf<2>>();
        break;
      case 3:
        core_ = std::make_unique<CoreOf<3>>();
        break;
      case 4:
        core_ = std::make_unique<CoreOf<4>>();
        break;
      case 5:
        core_ = std::make_unique<CoreOf<5>>();
        break;
      default:
        core_ = std::make_unique<CoreOf<6>>();
        break;
    }
  }
  return *core_;
}

StepEstimate Exponential::step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                               StrainState& state) {
  if (body.size() == 0) return {rod::StrainVector::Zero(0), 0.0};
  return core(body.size()).step(body, handle, t, h, state);
}

void Exponential::exchange(math::StateArchive& state) {
  int n = n_;
  state(n);
  if (n == 0) {
    core_.reset();
    n_ = 0;
  } else {
    core(n).exchange(state);
  }
}

Integrator::Response Exponential::response(const HeldBody& body, double t, double h, const StrainState& state) {
  Response r;
  if (body.size() > 0 && body.size() == n_ && core_->response(body, h, r)) return r;
  return Integrator::response(body, t, h, state);
}

}  // namespace spring_workbench::dynamics
