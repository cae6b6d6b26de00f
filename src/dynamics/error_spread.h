#pragma once

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "held_body_equation.h"
#include "spring_workbench/dynamics/integrator.h"
#include "spring_workbench/exponential/collocation_step.h"

namespace spring_workbench::dynamics {

/// Follows the error of a run over steps of exponential collocation: estimate and spread of RunError.
template <int n>
class ErrorSpread {
 public:
  using Equation = HeldBodyEquation<n>;
  using Steps = exponential::CollocationStep<n, Equation>;
  using Propagator = typename Steps::Propagator;
  using Modes = typename Steps::Modes;
  using NodeModes = typename Steps::NodeModes;
  using NodeStrains = typename Steps::NodeStrains;

  /// Propagates the run's error over the last step, and adds that step's own. The estimate goes along the equation of
  /// motion, by its linear part and one iteration; the spread grows by the uncertainty of the step's estimate.
  SPRING_WORKBENCH_INLINE void propagate(const Equation& equation, const Steps& steps, RunError& run) {
    const Propagator& propagator = steps.propagator();
    const typename Steps::Done& done = steps.done();
    if (revision_ != propagator.revision()) set(propagator);
    Modes begin;
    begin << run.estimate.q, run.estimate.q_dot;
    const NodeModes missed_at_nodes = propagator.effect(done.defect);
    NodeModes guess = propagator.carried_in_modes(propagator.part().deviation_in_modes(begin)), e, x;
    for (int m = 0; m < 2 * n; ++m) {
      guess[at(m)] -= missed_at_nodes[at(m)];
      x[at(m)] = done.x[at(m)] - guess[at(m)];
    }
    const exponential::Residual<n, Equation> residual(equation, propagator.part(), done.q0, done.q_dot0);
    NodeStrains r = residual.at(done.forcing, x);
    for (int i = 0; i < n; ++i) r[at(i)] = done.residual[at(i)] - r[at(i)];
    propagator.drive(guess, propagator.part().in_modes(r), e);
    const Modes end = propagator.part().deviation(Propagator::at_end(e));
    run.estimate = {end.template head<n>(), end.template tail<n>()};
    for (int m = 0; m < 2 * n; ++m) e[at(m)] -= guess[at(m)];
    constexpr std::size_t last = exponential::Collocation::count - 1;
    const double missed = amplitude(propagator, missed_at_nodes)[last], changed = amplitude(propagator, e)[last];
    run.uncertainty = missed + math::largest(amplitude(propagator, propagator.effect_of_highest_degree(done.defect))) +
                      fraction_of_iterations * steps.convergence().left_after_first() * (missed + changed);
    carry(run);
  }

 private:
  using Square = typename Propagator::Square;
  using StateMatrix = Eigen::Matrix<double, 2 * n, 2 * n>;
  static constexpr std::size_t at(int i) { return Propagator::at(i); }

  /// Derives from the linear part and the step.
  void set(const Propagator& propagator) {
    revision_ = propagator.revision();
    const ModalDecomposition& modes = propagator.modes();
    amplitude_rates_ = modes.amplitude_rates;
    mass_ = modes.mass;
    to_undamped_ = modes.to_undamped;
    const Square back = modes.inverse_mass * modes.to_undamped.transpose();
    ball_.setZero();
    ball_.template topLeftCorner<n, n>() = back * back.transpose();
    ball_.template bottomRightCorner<n, n>() = back * amplitude_rates_.cwiseAbs2().asDiagonal() * back.transpose();
    for (int m = 0; m < 2 * n; ++m) transition_.col(m) = propagator.carried(Modes::Unit(m));
  }

  /// Amplitude at which deviations, one in each lane, swing or run out, all modes together [m √kg].
  SPRING_WORKBENCH_INLINE math::Pack amplitude(const Propagator& propagator, const NodeModes& x) const {
    NodeStrains q, q_dot;
    propagator.part().deviation(x, q, q_dot);
    math::Pack squared{};
    for (int i = 0; i < n; ++i) {
      math::Pack displacement{}, velocity{};
      for (int j = 0; j < n; ++j) {
        displacement += to_undamped_(i, j) * q[at(j)];
        velocity += to_undamped_(i, j) * q_dot[at(j)];
      }
      squared += displacement * displacement + velocity * velocity / (amplitude_rates_[i] * amplitude_rates_[i]);
    }
    for (int k = 0; k < math::pack_size; ++k) squared[k] = std::sqrt(squared[k]);
    return squared;
  }

  /// Carries the spread over the step, and adds `run.uncertainty` in all directions: the ellipsoid of least trace.
  SPRING_WORKBENCH_INLINE void carry(RunError& run) {
    StateMatrix spread = transition_ * StateMatrix(run.spread) * transition_.transpose();
    const double size = std::sqrt(std::max(0.0, mass_.dot(spread.diagonal().template head<n>())) /
                                  mass_.dot(ball_.diagonal().template head<n>()));
    if (size > 0.0) spread *= 1.0 + run.uncertainty / size;
    run.spread = spread + run.uncertainty * (run.uncertainty + size) * ball_;
  }

  typename Propagator::Strain amplitude_rates_, mass_;
  Square to_undamped_;
  StateMatrix ball_;        ///< of deviations of amplitude 1
  StateMatrix transition_;  ///< over the step
  long revision_ = 0;       ///< of the propagator that all this is of
};

}  // namespace spring_workbench::dynamics
