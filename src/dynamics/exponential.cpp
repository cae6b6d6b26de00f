#include "exponential.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "error_spread.h"
#include "modal_decomposition.h"
#include "spring_workbench/math/anderson_mixer.h"
#include "spring_workbench/math/by_size.h"
#include "spring_workbench/math/exponential_collocation.h"
#include "spring_workbench/math/spatial.h"

namespace spring_workbench::dynamics {
namespace {

constexpr auto& c = math::Collocation::nodes;
constexpr auto& s = math::Collocation::samples;
constexpr std::size_t nodes = math::Collocation::count;
constexpr std::size_t last = nodes - 1;

constexpr int most_iterations = 12;
/// A step that takes no more iterations than this is at its best. When the others' iterations beyond it have cost what
/// a linear part costs, it is taken again (CVODE's msbp, by cost).
constexpr int few_iterations = 3;
constexpr int refactorisation_budget = 150;
/// A new linear part is also worth its cost if it will be the nearer one for so many steps, of the average length so
/// far.
constexpr double steps_worth_it = 50.0;
/// The iteration ends when what it would still change is below this share of the last step's collocation error, and
/// has converged if that is below most_of_error of this one's, or below the rounding of the step's own change.
constexpr double share_of_error = 0.02, most_of_error = 0.1;
constexpr double share_of_change = 1e-15;
/// From this iteration on, one that leaves more than slow_convergence of the last one's change is given up.
constexpr int iterations_to_judge = 5;
constexpr double slow_convergence = 0.7;
/// From one step to the next the rate of convergence, where it is not measured, is taken to get worse by this factor.
constexpr double forget_rate = 1.3;
/// The last step's polynomial is extrapolated to a step of this many times its length, and no further.
constexpr double farthest_extrapolated = 1.5;
/// Of the bound: what it allows for of what further iterations would change; how much that is, at an unknown rate.
constexpr double share_of_iterations = 0.5, not_known = 1e3;
/// Of the step: what rounding makes of the same moment.
constexpr double same_time = 1e-9;
constexpr double not_a_time = std::numeric_limits<double>::quiet_NaN();

math::Pack pack(const std::array<double, nodes>& x) { return math::Pack{x[0], x[1], x[2], x[3]}; }

}  // namespace

class Exponential::Core {
 public:
  virtual ~Core() = default;
  virtual StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                            StrainState& state) = 0;
  virtual const Response* response(const HeldBody& body, double h) = 0;  ///< nullptr: of other equations
  virtual void carry(StrainState& deviation) const = 0;
  virtual void follow(const HeldBody& body, RunError& error) = 0;
  virtual void exchange(math::StateArchive& state) = 0;
};

template <int n>
class Exponential::CoreOf final : public Core {
 public:
  StepEstimate step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                    StrainState& state) override {
    if (version_ != body.version() || has_moved_on(state.q)) linearise(body, body.forcing(handle, t), state.q);
    const StrainState begin = state;
    const bool predicted = !std::isnan(t_begin_);
    StepEstimate e = iterate(body, handle, t, h, state);
    if (!e.converged && (predicted || begin.q != modes().q_reference)) {
      linearise(body, body.forcing(handle, t), begin.q);
      state = begin;
      e = iterate(body, handle, t, h, state);
    }
    return e;
  }

  const Response* response(const HeldBody& body, double h) override {
    if (version_ != body.version()) return nullptr;
    collocation_.prepare(h);
    if (response_h_ != collocation_.h()) {
      const Eigen::Matrix<double, 2 * n, n> end = collocation_.response(modes().inverse_mass);
      response_ = {end.template topRows<n>(), end.template bottomRows<n>()};
      response_h_ = collocation_.h();
    }
    return &response_;
  }

  void carry(StrainState& deviation) const override {
    Modes y;
    y << deviation.q, deviation.q_dot;
    y = collocation_.carried(y);
    deviation = {y.template head<n>(), y.template tail<n>()};
  }

  void follow(const HeldBody& body, RunError& run) override { follow_error(body, run); }
  /// The estimate goes along the equation, linear part and one iteration; the spread grows by what is left out.
  SPRING_WORKBENCH_WIDE void follow_error(const HeldBody& body, RunError& run) {
    Modes begin;
    begin << run.estimate.q, run.estimate.q_dot;
    const NodeModes missed_at_nodes = collocation_.effect(defect_);
    NodeModes guess = collocation_.carried_in_modes(collocation_.in_modes(begin)), e, x;
    for (int m = 0; m < 2 * n; ++m) {
      guess[at(m)] -= missed_at_nodes[at(m)];
      x[at(m)] = done_.x[at(m)] - guess[at(m)];
    }
    NodeStrains r = residual(body, done_.forcing, done_.q0, done_.q_dot0, x);
    for (int i = 0; i < n; ++i) r[at(i)] = done_.residual[at(i)] - r[at(i)];
    collocation_.drive(guess, collocation_.in_modes(r), e);
    const Modes end = collocation_.deviation(Collocation::at_end(e));
    run.estimate = {end.template head<n>(), end.template tail<n>()};
    for (int m = 0; m < 2 * n; ++m) e[at(m)] -= guess[at(m)];
    const double left = rate_ < 1.0 ? rate_ / (1.0 - rate_) : not_known;
    const double missed = spread_.amplitude(collocation_, missed_at_nodes)[last],
                 changed = spread_.amplitude(collocation_, e)[last];
    run.unsure = missed +
                 math::largest(spread_.amplitude(collocation_, collocation_.effect_of_highest_degree(defect_))) +
                 share_of_iterations * left * (missed + changed);
    spread_.carry(collocation_, run);
  }

  void exchange(math::StateArchive& state) override {
    state(version_);
    if (version_ < 0) return;  // nothing derived yet
    state(collocation_, model_, rate_, squared_error_, begin_, way_, steps_, slow_iterations_, last_h_, t_begin_);
    if (state.sets()) spread_.set(collocation_.modes());
    response_h_ = 0.0;
  }

 private:
  using Collocation = math::ExponentialCollocation<n, ModalDecomposition>;
  using Strain = typename Collocation::Strain;
  using Modes = typename Collocation::Modes;
  using NodeModes = typename Collocation::NodeModes;
  using NodeStrains = typename Collocation::NodeStrains;
  static constexpr std::size_t at(int i) { return static_cast<std::size_t>(i); }

  const ModalDecomposition& modes() const { return collocation_.modes(); }

  /// Whether a new linear part is worth its cost; of the strain at the start of each step.
  bool has_moved_on(const Strain& q) {
    const auto length = [this](const Strain& way) { return std::sqrt(Strain(modes().mass).dot(way.cwiseAbs2())); };
    way_ += length(q - std::exchange(begin_, q));
    const double from_reference = length(q - Strain(modes().q_reference));
    return from_reference * ++steps_ > steps_worth_it * way_ ||
           (slow_iterations_ > refactorisation_budget && from_reference > 0.0);
  }

  void linearise(const HeldBody& body, const HandleForcing& handle, const rod::StrainVector& q) {
    begin_ = q;
    way_ = 0.0;
    steps_ = slow_iterations_ = 0;
    const ModalDecomposition found = modal_decomposition(body, handle, q);
    if (version_ == body.version() && !(found.to_modes.allFinite() && found.from_modes.allFinite())) return;
    collocation_.set(found);
    spread_.set(found);
    version_ = body.version();
    t_begin_ = not_a_time;
    rate_ = 1.0;
    response_h_ = 0.0;
  }

  /// The acceleration under the handle's acceleration and the loads alone, to first order.
  SPRING_WORKBENCH_INLINE NodeStrains forced(const HeldBody& body,
                                             const motion::FrameForcing<math::Pack>& handle) const {
    const Wrench& load = body.external_wrench();
    const auto force = math::transposed(handle.R_WB, math::three(load.force)),
               moment = math::transposed(handle.R_WB, math::three(load.moment));
    const auto& A = modes().by_handle;
    const auto& B = modes().by_wrench;
    NodeStrains a;
    for (int i = 0; i < n; ++i) {
      a[at(i)] = A(i, 0) * handle.a_B.x + A(i, 1) * handle.a_B.y + A(i, 2) * handle.a_B.z + A(i, 3) * handle.alpha_B.x +
                 A(i, 4) * handle.alpha_B.y + A(i, 5) * handle.alpha_B.z;
      a[at(i)] += B(i, 0) * force.x + B(i, 1) * force.y + B(i, 2) * force.z + B(i, 3) * moment.x + B(i, 4) * moment.y +
                  B(i, 5) * moment.z;
    }
    return a;
  }

  /// The residual before the first iteration. What is left of the acceleration without the linear part and what the
  /// handle and the loads do to first order goes on smoothly where a sampled handle's acceleration jumps: it is
  /// extrapolated from the last step, or taken as at the start.
  SPRING_WORKBENCH_INLINE NodeStrains predict(const HeldBody& body, const motion::FrameMotion& handle, double t,
                                              double h, const NodeStrains& forcing, const Strain& q,
                                              const Strain& q_dot) {
    const Strain linear = collocation_.stiffness() * q + collocation_.damping() * q_dot;
    // In steps of the last one's length, from its start: a step may follow it, or be taken instead of it.
    const double begin = (t - t_begin_) / last_h_, length = h / last_h_;
    const bool known = begin > -same_time && begin + length < 1.0 + farthest_extrapolated;
    NodeStrains r;
    if (known) {
      for (std::size_t k = 0; k < nodes; ++k) {
        const auto w = math::Collocation::interpolated(begin + c[k] * length);
        const math::Pack weights{w[0], w[1], w[2], w[3]};
        for (int i = 0; i < n; ++i) r[at(i)][k] = math::sum(weights * model_[at(i)]) - linear[i];
      }
    } else {
      rate_ = 1.0;
      squared_error_ = 0.0;
      const Strain a = body.template acceleration<n>(body.forcing(handle, t), q, q_dot);
      const NodeStrains start = forced(body, body.forcing(handle, t + math::Pack{}).of_H);
      for (int i = 0; i < n; ++i) r[at(i)] = a[i] - start[at(i)];
    }
    for (int i = 0; i < n; ++i) r[at(i)] += forcing[at(i)];
    return r;
  }

  /// The squared size of what is rounded in a step: of the state, and where couplings pull, whose strains are
  /// differences of places so far from the origin, of these, as far as the step feels it.
  double rounded(const HeldBody& body, double distance, double h, const Strain& q, const Strain& q_dot) const {
    const double felt = distance * std::min(1.0, modes().fastest * h * modes().fastest * h);
    return modes().mass.dot(rod::StrainVector(q.cwiseAbs2() + h * h * q_dot.cwiseAbs2())) +
           body.body().mass * felt * felt;
  }
  /// The same, at most, where springs, dampers and a load cancel: the acceleration is a small difference of large ones.
  double rounded_where_loads_cancel(const HeldBody& body, const Strain& q, const Strain& q_dot) const {
    const Wrench& load = body.external_wrench();
    const Wrench all{Vector3d::Constant(load.force.norm()), Vector3d::Constant(load.moment.norm())};
    return share_of_change * share_of_change *
           collocation_.squared_effect(collocation_.stiffness().cwiseAbs() * q.cwiseAbs() +
                                       collocation_.damping().cwiseAbs() * q_dot.cwiseAbs() +
                                       modes().by_wrench.cwiseAbs() * to_vector(all));
  }

  /// The residual at the modes `x`.
  SPRING_WORKBENCH_INLINE NodeStrains residual(const HeldBody& body, const HandleForcings& forcing, const Strain& q0,
                                               const Strain& q_dot0, const NodeModes& x) const {
    NodeStrains dq, dv, q, q_dot, r;
    collocation_.deviation(x, dq, dv);
    for (int i = 0; i < n; ++i) {
      q[at(i)] = q0[i] + dq[at(i)];
      q_dot[at(i)] = q_dot0[i] + dv[at(i)];
    }
    body.template acceleration<n>(forcing, q.data(), q_dot.data(), r.data());
    collocation_.take_linear_part(dq, dv, r);
    return r;
  }

  /// What the defect of the interpolant through the residual `r` does to the modes at the end; `from` begin().
  SPRING_WORKBENCH_INLINE Modes defect_effect(const HeldBody& body, const HandleForcings& forcing, const Strain& q0,
                                              const Strain& q_dot0, const NodeModes& from, const NodeStrains& r,
                                              const NodeModes& in_modes) {
    NodeModes x;
    collocation_.drive_samples(from, in_modes, x);
    NodeStrains defect = residual(body, forcing, q0, q_dot0, x);
    for (int i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < nodes; ++j) defect[at(i)] -= math::Collocation::at_samples()[j] * r[at(i)][j];
    }
    defect_ = collocation_.in_modes(defect);
    const Modes missed = collocation_.end_effect(defect_);
    squared_error_ = collocation_.squared_size(missed);
    return missed;
  }

  /// What an iteration changed, from where it began, and its squared size.
  template <typename Image>
  SPRING_WORKBENCH_INLINE double take_change(const NodeModes& from, Image& image) const {
    double all = 0.0;
    for (int m = 0; m < 2 * n; ++m) {
      image.change[at(m)] = image.x[at(m)] - from[at(m)];
      all += collocation_.squared_weight()[m] * math::sum(image.change[at(m)] * image.change[at(m)]);
    }
    return all;
  }

  /// Fixed-point iteration on the residual at the nodes, then the defect of the polynomial through it at the samples.
  SPRING_WORKBENCH_WIDE StepEstimate iterate(const HeldBody& body, const motion::FrameMotion& handle, double t,
                                             double h, StrainState& state) {
    collocation_.prepare(h);
    const Strain q0 = state.q, q_dot0 = state.q_dot;
    const HandleForcings forcing = body.forcing(handle, t + h * pack(c));
    const NodeStrains by_forcing = forced(body, forcing.of_H);
    NodeStrains r = predict(body, handle, t, h, by_forcing, q0, q_dot0);
    NodeModes begin, begin_samples, in_modes = collocation_.in_modes(r), x;
    collocation_.begin(q_dot0, begin, begin_samples);
    collocation_.drive(begin, in_modes, x);

    const HandleForcings at_samples = body.forcing(handle, t + h * pack(s));
    const double squared_state = rounded(body, forcing.seen.distance, h, q0, q_dot0);
    mixer_.restart();
    double all_before = 0.0, rate = std::min(1.0, rate_ * forget_rate), left = 0.0;
    bool converged = false, ends = false;
    int iterations = 0;
    Modes reached, change, missed = Modes::Zero();
    while (!converged && !ends) {
      ++iterations;
      auto& image = mixer_.next();
      r = residual(body, forcing, q0, q_dot0, x);
      in_modes = collocation_.in_modes(r);
      collocation_.drive(begin, in_modes, image.x);
      const double all = take_change(x, image);
      if (!(all < 1e300)) return {rod::StrainVector(), 0.0, rod::StrainVector(), false};
      reached = Collocation::at_end(image.x);
      change = Collocation::at_end(image.change);
      const double rounding = share_of_change * share_of_change * (collocation_.squared_size(reached) + squared_state);
      if (iterations > 1) rate = std::sqrt(all / all_before);
      if (iterations == 2) rate_ = rate;
      const bool slow = iterations > 2 && rate > slow_convergence && all > rounding;
      const bool cancels = slow && all <= rounded_where_loads_cancel(body, q0, q_dot0);
      ends = cancels || (slow && iterations > iterations_to_judge) || iterations == most_iterations;
      left = cancels ? 1.0 : rate < 1.0 ? rate / (1.0 - rate) : not_known;  // 1: the next changes as much again
      const double squared_left = left * left * collocation_.squared_size(change);
      const auto below = [&](double most) { return squared_left <= std::max(most * most * squared_error_, rounding); };
      if (ends || below(share_of_error)) {
        missed = defect_effect(body, at_samples, q0, q_dot0, begin_samples, r, in_modes);
        converged = cancels || below(most_of_error);
      }
      all_before = all;
      mixer_.mix(collocation_.squared_weight(), x);
    }
    slow_iterations_ += std::max(0, iterations - few_iterations);

    const Modes end = collocation_.deviation(reached),
                error = -collocation_.deviation(Modes((1.0 + left) * missed + left * change));
    state.q = q0 + end.template head<n>();
    state.q_dot = q_dot0 + end.template tail<n>();
    const Strain linear = collocation_.stiffness() * q0 + collocation_.damping() * q_dot0;
    for (int i = 0; i < n; ++i) model_[at(i)] = r[at(i)] - by_forcing[at(i)] + linear[i];
    last_h_ = h;
    t_begin_ = converged && end.allFinite() ? t : not_a_time;
    done_ = {forcing, q0, q_dot0, r, mixer_.last().x};
    return {error.template head<n>(), modes().fastest * h, error.template tail<n>(), !std::isnan(t_begin_)};
  }

  Collocation collocation_;
  long version_ = -1;
  math::AndersonMixer<static_cast<std::size_t>(2 * n)> mixer_;
  NodeStrains model_{};            ///< the last step's acceleration at its nodes, without linear part and forcing
  double rate_ = 1.0;              ///< of convergence, from the first to the second iteration
  double squared_error_ = 0.0;     ///< of the last step's collocation
  Strain begin_ = Strain::Zero();  ///< of the last step
  double way_ = 0.0;               ///< of the strain from step to step, with this linear part [m √kg]
  int steps_ = 0;                  ///< with this linear part
  int slow_iterations_ = 0;        ///< beyond few_iterations, with this linear part
  double last_h_ = 0.0, t_begin_ = not_a_time;  ///< of the last step; NaN: nothing to predict from
  Response response_;                           ///< of the linear part
  double response_h_ = 0.0;                     ///< the step that it is for [s]; 0: none
  ErrorSpread<n, Collocation> spread_;
  // Of the last step, for follow(); nothing of it goes on to the next.
  struct {
    HandleForcings forcing;
    Strain q0, q_dot0;
    NodeStrains residual{};
    NodeModes x{};
  } done_;
  NodeModes defect_{};
};

Exponential::Exponential() = default;
Exponential::~Exponential() = default;

Exponential::Core& Exponential::core(int n) {
  if (n == n_) return *core_;
  n_ = n;
  core_ = math::by_size(
      n, [](auto size) -> std::unique_ptr<Core> { return std::make_unique<CoreOf<decltype(size)::value>>(); });
  return *core_;
}

StepEstimate Exponential::step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                               StrainState& state) {
  if (body.size() == 0) return {rod::StrainVector::Zero(0), 0.0, rod::StrainVector::Zero(0), true};
  return core(body.size()).step(body, handle, t, h, state);
}

void Exponential::carry(const HeldBody&, const motion::FrameMotion&, double, double, const StrainState&,
                        const StrainState&, StrainState& deviation) {
  if (deviation.q.size() > 0) core_->carry(deviation);  // of the step just done
}

void Exponential::follow(const HeldBody& body, RunError& error) {
  if (body.size() > 0) core_->follow(body, error);  // of the step just done
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

Integrator::Response Exponential::response(const HeldBody& body, const HandleForcing& handle, double h,
                                           const StrainState& state) {
  const Response* known = body.size() > 0 && body.size() == n_ ? core_->response(body, h) : nullptr;
  if (known != nullptr) return *known;
  return Integrator::response(body, handle, h, state);
}

}  // namespace spring_workbench::dynamics
