#pragma once

#include "spring_workbench/exponential/anderson_mixer.h"
#include "spring_workbench/exponential/convergence.h"
#include "spring_workbench/exponential/exponential_collocation.h"
#include "spring_workbench/exponential/residual.h"
#include "spring_workbench/exponential/residual_history.h"

namespace spring_workbench::exponential {

/// Steps of exponential collocation for `n` coordinates along one linear part: the nonlinear residual at the nodes by
/// fixed-point iteration, then the defect of its collocation polynomial at the samples.
///
/// `Equation` is the equation of motion q̈ = f(input, t, q, q̇):
/// - `Forcing forcing(input, Pack t)`: what f depends on besides q and q̇, which may jump from step to step;
/// - `acceleration(forcing, q, q_dot, q_ddot)` in packs, and `Strain acceleration(input, t, q, q_dot)`;
/// - `NodeStrains by_forcing(forcing, modes)`: the acceleration due to the forcing alone, to first order;
/// - `double squared_rounding(forcing, modes, h, q, q_dot)`: squared size of the rounding errors of a state;
/// - `Strain cancelling(part, q, q_dot)`: upper bound of the terms that cancel in the acceleration;
/// - `ModalDecomposition`: see LinearPart.
template <int n, typename Equation>
class CollocationStep {
 public:
  using Input = typename Equation::Input;
  using Forcing = typename Equation::Forcing;
  using Propagator = ExponentialCollocation<n, typename Equation::ModalDecomposition>;
  using Strain = typename Propagator::Strain;
  using Modes = typename Propagator::Modes;
  using NodeModes = typename Propagator::NodeModes;
  using NodeStrains = typename Propagator::NodeStrains;

  /// Intermediate results of the last step. They have no effect on the next one.
  struct Done {
    Forcing forcing;         ///< forcing at the nodes
    Strain q0, q_dot0;       ///< strain and rate at the start
    NodeStrains residual{};  ///< residual at the nodes
    NodeModes x{};           ///< modes at the nodes
    NodeModes defect{};      ///< defect of the residual at the samples, in modes
  };
  const Done& done() const { return done_; }

  /// Strain and rate at the nodes of the last step.
  SPRING_WORKBENCH_INLINE void path(NodeStrains& q, NodeStrains& q_dot) const {
    part().deviation(done_.x, q, q_dot);
    Residual<n, Equation>::add(done_.q0, q, q);
    Residual<n, Equation>::add(done_.q_dot0, q_dot, q_dot);
  }

  /// Replaces the linear part.
  void set(const typename Equation::ModalDecomposition& modes) {
    propagator_.set(modes);
    history_.clear();
  }
  void prepare(double h) { propagator_.prepare(h); }
  const Propagator& propagator() const { return propagator_; }
  const Convergence& convergence() const { return convergence_; }
  /// Whether the next step begins with the residual of the last one.
  bool has_history() const { return !history_.empty(); }

  struct Result {
    bool solved = false;  ///< otherwise the state must not be used
    Modes error;          ///< estimate of the local error: strain and rate
  };
  /// Carries the state over a step of `h` from `t` [s].
  SPRING_WORKBENCH_INLINE Result step(const Equation& equation, const Input& input, double t, double h, Strain& q,
                                      Strain& q_dot) {
    propagator_.prepare(h);
    const Strain q0 = q, q_dot0 = q_dot, linear = part().force(q0, q_dot0);
    const Forcing forcing = equation.forcing(input, t + h * math::pack(Collocation::nodes));
    const NodeStrains by_forcing = equation.by_forcing(forcing, modes());
    const Residual<n, Equation> residual(equation, part(), q0, q_dot0);
    NodeStrains r = first_residual(equation, input, t, h, q0, q_dot0, linear, by_forcing);
    NodeModes begin, begin_samples, in_modes = part().in_modes(r), x;
    propagator_.begin(q_dot0, begin, begin_samples);
    propagator_.drive(begin, in_modes, x);

    const Forcing at_samples = equation.forcing(input, t + h * math::pack(Collocation::samples));
    const double squared_rounding = equation.squared_rounding(forcing, modes(), h, q0, q_dot0);
    const auto cancelled = [&] {
      return rounding * rounding *
             norm().squared_effect(part().bound_in_modes(equation.cancelling(part(), q0, q_dot0)));
    };
    mixer_.restart();
    convergence_.begin_step();
    Modes reached, change, missed = Modes::Zero();
    do {
      r = residual.at(forcing, x);
      in_modes = part().in_modes(r);
      propagator_.drive(begin, in_modes, mixer_.next());
      const double squared_change = mixer_.take_change(x, norm().squared_weight());
      if (!(squared_change < 1e300)) return {false, Modes::Zero()};
      reached = Propagator::at_end(mixer_.last().x);
      change = Propagator::at_end(mixer_.last().change);
      convergence_.add(squared_change, norm().squared_size(change),
                       rounding * rounding * (norm().squared_size(reached) + squared_rounding), cancelled);
      if (convergence_.may_end()) {
        propagator_.drive_samples(begin_samples, in_modes, done_.x);
        done_.defect = part().in_modes(residual.defect(residual.at(at_samples, done_.x), r));
        missed = propagator_.end_effect(done_.defect);
        convergence_.set_error(norm().squared_size(missed));
      }
      if (!convergence_.ended()) mixer_.mix(norm().squared_weight(), x);
    } while (!convergence_.ended());

    const Modes end = part().deviation(reached);
    const double left = convergence_.left();
    const Modes error = -part().deviation(Modes((1.0 + left) * missed + left * change));
    q = q0 + end.template head<n>();
    q_dot = q_dot0 + end.template tail<n>();
    done_.forcing = forcing;
    done_.q0 = q0;
    done_.q_dot0 = q_dot0;
    done_.residual = r;
    done_.x = mixer_.last().x;
    const bool solved = convergence_.converged() && end.allFinite();
    solved ? history_.keep(t, h, linear, by_forcing, r) : history_.clear();
    return {solved, error};
  }

  void archive(math::StateArchive& state) { state(propagator_, convergence_, history_); }

 private:
  static constexpr double rounding = 1e-15;  ///< relative rounding error of a step
  static constexpr std::size_t at(int i) { return Propagator::at(i); }
  const typename Propagator::Part& part() const { return propagator_.part(); }
  const ModeNorm<2 * n>& norm() const { return propagator_.norm(); }
  const typename Equation::ModalDecomposition& modes() const { return propagator_.modes(); }

  /// The residual at the nodes before the first iteration: continued from the last step, or constant as at the start.
  SPRING_WORKBENCH_INLINE NodeStrains first_residual(const Equation& equation, const Input& input, double t, double h,
                                                     const Strain& q, const Strain& q_dot, const Strain& linear,
                                                     const NodeStrains& by_forcing) {
    NodeStrains r;
    if (history_.extrapolate(t, h, linear, by_forcing, r)) return r;
    convergence_.restart();
    const Strain a = equation.acceleration(input, t, q, q_dot);
    const NodeStrains start = equation.by_forcing(equation.forcing(input, t + math::Pack{}), modes());
    for (int i = 0; i < n; ++i) r[at(i)] = a[i] - start[at(i)] + by_forcing[at(i)];
    return r;
  }

  Propagator propagator_;
  Convergence convergence_;
  AndersonMixer<static_cast<std::size_t>(2 * n)> mixer_;
  ResidualHistory<n> history_;
  Done done_;
};

}  // namespace spring_workbench::exponential
