#include "spring_workbench/dynamics/step_control.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "energy_limit.h"
#include "implicit_integrators.h"
#include "spring_workbench/math/spatial.h"
#include "strain_limit.h"

namespace spring_workbench::dynamics {
namespace {

/// A guarded step with a larger estimate of its error is taken again in halves.
constexpr double large_error = 0.05;  ///< of the fork's length; of a radian
constexpr int most_halvings = 6;
/// How much closer than a whole step two halves are, where an estimate is made of the two: 32 where the motion is
/// smooth, 2 to 4 where a jump of the handle's acceleration sets off a fast mode.
constexpr double halves_are_closer = 4.0;
constexpr int halvings_to_stop =
    2;  ///< a piece of a step that is no longer than this may end at the end of the fork's way
constexpr double most_strain = 1e12;  ///< in the coordinates' own units; no state to go on from has more

constexpr double safety = 0.9;
constexpr double most_growth = 3.0, least_growth = 0.1;
constexpr double longest_swing = 1.0;   ///< [s]; over this a rate that no spring stops becomes a strain
constexpr double smallest_step = 1e-4;  ///< of the span; one shorter than two of these is taken whatever its error
constexpr double shortest_step = 2e-6;  ///< [s]; the same where it is longer: pieces between contacts may be short

struct Sizes {
  double position, angle;  ///< [m], [rad]
};

/// An error of the strain as one of the object's pose.
Sizes sizes(const HeldBody& body, double t, const rod::StrainVector& q, const rod::StrainVector& error) {
  const auto J = body.object_jacobian(t, q);
  return {(J.topRows<3>() * error).norm(), (J.bottomRows<3>() * error).norm()};
}

/// From rates to the strain that they swing to, mode by mode.
rod::StrainMatrix swing_of(const LinearisedMotion& motion) {
  const rod::StrainMatrix K = 0.5 * (motion.K + motion.K.transpose());
  const Eigen::GeneralizedSelfAdjointEigenSolver<rod::StrainMatrix> modes(K, motion.M);
  const rod::StrainVector period =
      modes.eigenvalues().cwiseAbs().cwiseMax(1.0 / (longest_swing * longest_swing)).cwiseSqrt();
  return modes.eigenvectors() * period.cwiseInverse().asDiagonal() * modes.eigenvectors().transpose() * motion.M;
}

double stiffest_omega(const HeldBody& body, double t, const rod::StrainVector& q) {
  const rod::StrainMatrix K = body.stiffness().asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<rod::StrainMatrix> modes(K, body.mass_matrix(t, q),
                                                                          Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, modes.eigenvalues().maxCoeff()));
}

}  // namespace

struct StepControl::Span {
  const HeldBody& body;
  const motion::FrameMotion& handle;
  Memory& memory;
  ControlledStep report;
  double longest_to_stop;  ///< [s]; a step up to this may end at the end of the fork's way

  /// An error of the strain as one length.
  double length(double t, const rod::StrainVector& q, const rod::StrainVector& error) const {
    const Sizes s = sizes(body, t, q, error);
    return std::hypot(s.position, radius_of_gyration(body.body().mass, body.body().inertia_O) * s.angle);
  }
};

StepControl::StepControl(std::unique_ptr<Integrator> integrator, double tolerance)
    : integrator_(std::move(integrator)), tolerance_(tolerance) {}

ControlledStep StepControl::advance(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                                    StrainState& state, Memory& memory) const {
  Span span{body, handle, memory, {}, (1.0 + 1e-9) * std::ldexp(h, -halvings_to_stop)};
  const Memory before = memory;
  StrainState next = state;
  span.report.accepted = tolerance_ > 0.0                ? steps_to_tolerance(span, t, h, next)
                         : integrator_->stiffly_stable() ? step_in_halves(span, t, h, 0, next)
                                                         : [&] {
                                                             StepEstimate estimate;
                                                             return try_step(span, t, h, next, estimate);
                                                           }();
  if (span.report.accepted) {
    state = next;
  } else {
    memory = before;
  }
  return span.report;
}

StepEstimate StepControl::step_with_estimate(const Span& span, double t, double h, StrainState& state) const {
  const auto step = [&](double from, double length, StrainState& s) {
    return integrator_->step(span.body, span.handle, from, length, s);
  };
  if (tolerance_ == 0.0 || integrator_->estimates_after_jumps()) return step(t, h, state);
  StrainState whole = state;
  StepEstimate estimate = step(t, h, whole);
  step(t, 0.5 * h, state);
  step(t + 0.5 * h, 0.5 * h, state);
  estimate.q_error = (whole.q - state.q) / halves_are_closer;
  estimate.q_dot_error = (whole.q_dot - state.q_dot) / halves_are_closer;
  return estimate;
}

bool StepControl::try_step(Span& span, double t, double h, StrainState& state, StepEstimate& estimate) const {
  const HeldBody& body = span.body;
  const StrainState begin = state;
  estimate = step_with_estimate(span, t, h, state);
  if (!((state.q.norm() + state.q_dot.norm()) < most_strain)) return false;
  if (!body.shape().admissible(body.full_state(t + h, state).q)) {
    const bool stops =
        integrator_->stiffly_stable() && h <= span.longest_to_stop && stop_at_limit(body, t + h, begin, state);
    if (!stops) return false;
  }
  // The estimate is in the coordinates of the step.
  const Sizes s = sizes(body, t + h, state.q, estimate.q_error);
  body.rechart(state);
  ++span.report.steps;
  if (integrator_->stiffly_stable() && hold_energy(body, span.handle, t, h, begin, state, span.memory)) {
    ++span.report.energy_held;
  }
  span.report.position_error = std::max(span.report.position_error, s.position);
  span.report.angle_error = std::max(span.report.angle_error, s.angle);
  double omega_dt = estimate.omega_dt;
  if (!(omega_dt > 0.0)) {
    if (span.memory.omega_version != body.version()) {
      span.memory.stiffest_omega = stiffest_omega(body, t, begin.q);
      span.memory.omega_version = body.version();
    }
    omega_dt = span.memory.stiffest_omega * h;
  }
  span.report.omega_dt = std::max(span.report.omega_dt, omega_dt);
  span.memory.t = t + h;
  span.memory.version = body.version();
  return true;
}

bool StepControl::step_in_halves(Span& span, double t, double h, int level, StrainState& state) const {
  const Memory memory = span.memory;
  const ControlledStep report = span.report;
  StrainState whole = state;
  StepEstimate estimate;
  const bool accepted = try_step(span, t, h, whole, estimate);
  bool good = accepted;
  if (accepted) {
    const Sizes s = sizes(span.body, t + h, whole.q, estimate.q_error);
    good = s.position < large_error * span.body.shape().length() && s.angle < large_error;
  }
  if (good || level == most_halvings) {
    if (accepted) state = whole;
    return accepted;
  }
  span.memory = memory;
  span.report = report;
  ++span.report.rejected;
  return step_in_halves(span, t, 0.5 * h, level + 1, state) &&
         step_in_halves(span, t + 0.5 * h, 0.5 * h, level + 1, state);
}

bool StepControl::steps_to_tolerance(Span& span, double t, double h, StrainState& state) const {
  Memory& memory = span.memory;
  if (memory.version != span.body.version() || memory.t != t || memory.error.q.size() != span.body.size()) {
    memory.error = span.body.zero_state();
    memory.next_h = h;
  }
  const double end = t + h, shortest = std::max(smallest_step * h, shortest_step), order = integrator_->order();
  int rejected = 0;
  const HandleForcing begin = span.body.forcing(span.handle, t);
  const LinearisedMotion motion(span.body, begin, state, span.body.acceleration(begin, state.q, state.q_dot));
  const rod::StrainMatrix swing = swing_of(motion);
  while (end - t > 1e-9 * h) {
    const double left = end - t;
    const double dt = memory.next_h > 0.95 * left ? left : memory.next_h;
    const Memory memory_before = memory;
    const ControlledStep report_before = span.report;
    StrainState next = state;
    StepEstimate estimate;
    const bool accepted =
        try_step(span, t, dt, next, estimate) && estimate.q_error.allFinite() && estimate.q_dot_error.allFinite();
    const bool smallest = dt < 2.0 * shortest;
    if (smallest && !accepted) return false;
    StrainState error = memory.error;
    double growth = least_growth;
    bool good = false;
    if (accepted) {
      carry_deviation(motion, dt, error);
      const auto amplitude = [&](const rod::StrainVector& q, const rod::StrainVector& q_dot) {
        return std::hypot(span.length(t + dt, next.q, q), span.length(t + dt, next.q, swing * q_dot));
      };
      const double left_over = tolerance_ - amplitude(error.q, error.q_dot);
      const double allowed = std::max(left_over, tolerance_ * dt / undamped_horizon);
      const double local = amplitude(estimate.q_error, estimate.q_dot_error);
      error.q += estimate.q_error;
      error.q_dot += estimate.q_dot_error;
      const double size = amplitude(error.q, error.q_dot);
      good = local <= allowed || size <= tolerance_;
      if (!std::isfinite(size)) {
        error = span.body.zero_state();
      } else if (size > tolerance_) {  // short steps take no error back: more than this need not be known
        error.q *= tolerance_ / size;
        error.q_dot *= tolerance_ / size;
      }
      const double power = rejected > 0 ? 0.5 : 1.0 / (order + 1.0);  // a stiff step may behave as one of low order
      growth = local > 0.0 ? safety * std::pow(allowed / local, power) : most_growth;
    }
    growth = std::clamp(growth, least_growth, rejected > 0 ? 1.0 : most_growth);
    if (good || smallest) {
      memory.error = error;
      // A step that the span's end has cut short says nothing against a longer one.
      memory.next_h = std::max({dt < memory_before.next_h ? memory_before.next_h : 0.0, dt * growth, shortest});
      state = next;
      t += dt;
      rejected = 0;
    } else {
      memory = memory_before;
      span.report = report_before;
      memory.next_h = std::max(dt * std::min(growth, 0.8), shortest);
      ++span.report.rejected;
      ++rejected;
    }
  }
  memory.t = end;
  return true;
}

}  // namespace spring_workbench::dynamics
