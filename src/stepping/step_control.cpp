#include "spring_workbench/stepping/step_control.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "constants.h"
#include "energy_account.h"
#include "fallback_step.h"
#include "range_stop.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/math/spatial.h"
#include "spring_workbench/math/symmetric_modes.h"

namespace spring_workbench::stepping {
namespace {

bool usable(const dynamics::StrainState& state) {
  return (state.q.array().abs() < most_strain).all() && (state.q_dot.array().abs() < most_strain).all();
}

/// Errors of the strain as one length: of the object's position, and of its attitude by its radius of gyration.
class ErrorLength {
 public:
  ErrorLength(const dynamics::HeldBody& body, double t, const dynamics::StrainState& state)
      : J_(body.object_jacobian(t, state.q)), gyration_(radius_of_gyration(body.body().mass, body.body().inertia_O)) {}
  double operator()(const rod::StrainVector& error) const {
    return std::hypot((J_.topRows<3>() * error).norm(), gyration_ * (J_.bottomRows<3>() * error).norm());
  }

 private:
  rod::TwistJacobian J_;
  double gyration_;
};

/// From rates to the strain that they swing to, mode by mode, and the frequency of the stiffest mode.
void set_modes(const dynamics::HeldBody& body, const dynamics::HandleState& handle, const rod::StrainVector& q,
               StepControl::Memory& memory) {
  const rod::StrainMatrix M = body.mass_matrix(handle.t, q);
  const math::SymmetricModes modes = math::symmetric_modes(body.springs(handle, q).K, M);
  const rod::StrainVector omega = modes.values.cwiseMax(0.0).cwiseSqrt();
  memory.stiffest_omega = omega.maxCoeff();
  memory.swing =
      modes.vectors * omega.cwiseMax(1.0 / longest_swing).cwiseInverse().asDiagonal() * modes.vectors.transpose() * M;
}

void begin_bound(const dynamics::HeldBody& body, double t, const dynamics::StrainState& state,
                 StepControl::Memory& memory) {
  const Eigen::Index n = state.q.size();
  const bool free = !body.loaded();
  const bool goes_on = memory.spread.rows() == 2 * n && memory.t == t && memory.end.q == state.q &&
                       memory.end.q_dot == state.q_dot && (memory.bounded || !free);
  memory.bounded = free;
  if (goes_on) return;
  memory.exact = state;
  memory.spread = dynamics::RunError::Spread::Zero(2 * n, 2 * n);
}

/// Restarts the bound at this state; in this span there is none.
void forget_error(const dynamics::StrainState& state, StepControl::Memory& memory) {
  memory.exact = state;
  memory.spread.setZero();
  memory.bounded = false;
}

}  // namespace

struct StepControl::Span {
  const dynamics::HeldBody& body;
  const motion::Trajectory& handle;
  Memory& memory;
  ControlledStep report;
};

struct StepControl::Tried {
  dynamics::StrainState state;
  dynamics::StepEstimate estimate{};
  bool solved = false, in_range = false;           ///< in_range: of the rod
  double energy_error = 0.0, energy = 0.0;         ///< estimate of the error; what there is [J]
  std::optional<double> energy_added{};            ///< energy_added() [J], where it was asked for
  double position_error = 0.0, angle_error = 0.0;  ///< [m], [rad]
};

StepControl::StepControl(std::unique_ptr<dynamics::Integrator> integrator, double tolerance, bool error_bound)
    : integrator_(std::move(integrator)), tolerance_(tolerance), error_bound_(error_bound) {
  if (error_bound_ && !integrator_->tracks_run_error()) {
    companion_ = dynamics::make_integrator(dynamics::IntegratorKind::exponential);
  }
}

void StepControl::archive(math::StateArchive& state) {
  state(*integrator_);
  if (companion_ != nullptr) state(*companion_);
}

ControlledStep StepControl::advance(const dynamics::HeldBody& body, const motion::Trajectory& handle, double t,
                                    double h, dynamics::StrainState& state, Memory& memory) const {
  Span span{body, handle, memory, {}};
  const Memory before = memory;
  dynamics::StrainState next = state;
  span.report.accepted = usable(next) && body.shape().admissible(body.full_state(t, next).q);
  if (!span.report.accepted) return span.report;
  if (error_bound_) begin_bound(body, t, next, memory);
  if (memory.version != body.version() || memory.t != t || memory.error.q.size() != body.size()) {
    if (memory.version != body.version() || memory.swing.rows() != body.size())
      set_modes(body, body.state_at(handle, t), next.q, memory);
    memory.error = body.zero_state();
    memory.next_h = h;
    memory.version = body.version();
  }
  if (tolerance_ > 0.0) {
    steps_to_tolerance(span, t, h, next);
  } else {
    const int level = std::max(0, std::exchange(memory.level, 0) - 1);
    bool taken = true;
    for (int i = 0, count = 1 << level; i < count; ++i) {
      taken = step_in_halves(span, t + i * h / count, h / count, level, !taken, next);
    }
  }
  span.report.accepted = usable(next);
  if (span.report.accepted) {
    state = next;
    memory.t = t + h;
    if (error_bound_) end_bound(span, t + h, state);
    memory.bounded = memory.bounded && error_bound_;
    if (!memory.bounded) span.report.bounds.unbounded = span.report.steps;
  } else {
    memory = before;
  }
  return span.report;
}

StepControl::Tried StepControl::try_step(const Span& span, double t, double h,
                                         const dynamics::StrainState& state) const {
  const dynamics::HeldBody& body = span.body;
  Tried tried{state};
  tried.estimate = integrator_->step(body, span.handle, t, h, tried.state);
  if (!tried.estimate.converged || !usable(tried.state)) return tried;
  const dynamics::HandleState end = body.state_at(span.handle, t + h);
  const dynamics::StrainState corrected{tried.state.q - tried.estimate.q_error,
                                        tried.state.q_dot - tried.estimate.q_dot_error};
  const Difference error = difference(body, end, tried.state, corrected);
  tried.position_error = error.position;
  tried.angle_error = error.angle;
  tried.energy_error = std::abs(error.energy);
  tried.energy = error.present;
  tried.solved = std::isfinite(tried.position_error + tried.angle_error + tried.energy_error);
  tried.in_range = body.shape().admissible(body.full_state(t + h, tried.state).q);
  return tried;
}

void StepControl::weigh(const Span& span, double t, double h, const dynamics::StrainState& state, Tried& tried) const {
  const dynamics::HeldBody& body = span.body;
  if (body.returning() || !tried.in_range) return;
  tried.energy_added = energy_added(body, span.handle, t, h, state, tried.state, *integrator_);
  // An energy gain of the motion is an error, whatever the estimate of the method.
  if (!body.loaded() && !body.coupled()) tried.energy_error = std::max(tried.energy_error, *tried.energy_added);
}

void StepControl::take(Span& span, double t, double h, const Tried& tried, dynamics::StrainState& state) const {
  const dynamics::HeldBody& body = span.body;
  dynamics::StrainState next = tried.state;
  double present = tried.energy;
  if (!tried.in_range) {
    stop_at_range(body, over_step(body, span.handle, t, h), h, state, next);
    present = difference(body, body.state_at(span.handle, t + h), next, next).present;
    ++span.report.stops;
  }
  if (error_bound_) follow_error(span, t, h, tried, state);
  if (!body.returning()) {
    span.report.energy_added +=
        tried.energy_added ? *tried.energy_added : slow_down(body, span.handle, t, h, state, next);
  }
  if (body.rechart(next)) ++span.report.stops;
  state = next;
  ++span.report.steps;
  span.report.position_error = std::max(span.report.position_error, tried.position_error);
  span.report.angle_error = std::max(span.report.angle_error, tried.angle_error);
  span.report.energy_error += tried.energy_error;
  const double energy = std::max(present, std::exchange(span.memory.energy, present));
  const double spent = tried.energy_error / std::max(energy_drift_rate * energy, 1e-300);
  span.memory.energy_saved = std::clamp(span.memory.energy_saved + h - spent, -energy_reserve, energy_reserve);
  const double known = tried.estimate.omega_dt;
  span.report.omega_dt = std::max(span.report.omega_dt, known > 0.0 ? known : span.memory.stiffest_omega * h);
}

void StepControl::follow_error(Span& span, double t, double h, const Tried& tried,
                               const dynamics::StrainState& begin) const {
  const dynamics::HeldBody& body = span.body;
  Memory& memory = span.memory;
  dynamics::StrainState& exact = memory.exact;
  bool known = tried.solved;
  std::optional<double> local;
  dynamics::RunError run{body.zero_state(), memory.spread};
  if (companion_ != nullptr) {
    known = companion_->step(body, span.handle, t, h, exact).converged;
    if (known) companion_->propagate_run_error(body, run);
    exact.q -= run.estimate.q;
    exact.q_dot -= run.estimate.q_dot;
  } else if (known) {
    run.estimate = {begin.q - exact.q, begin.q_dot - exact.q_dot};
    integrator_->propagate_run_error(body, run);
    exact = {tried.state.q - run.estimate.q, tried.state.q_dot - run.estimate.q_dot};
    const double directions = std::min<double>(3.0, static_cast<double>(body.size()));
    local = tried.position_error + local_margin * run.uncertainty * std::sqrt(directions / body.body().mass);
  }
  memory.spread = run.spread;
  // Of the motion itself, a stop and another chart are not followed.
  known =
      known && usable(exact) && memory.spread.allFinite() && body.shape().admissible(body.full_state(t + h, exact).q);
  if (known) known = !body.rechart(exact);
  if (!known) return forget_error(tried.state, memory);
  span.report.bounds.add({local, std::nullopt, std::nullopt, 0});
}

void StepControl::end_bound(Span& span, double t, const dynamics::StrainState& state) const {
  const dynamics::HeldBody& body = span.body;
  Memory& memory = span.memory;
  memory.end = state;
  const dynamics::HandleState end = body.state_at(span.handle, t);
  const RigidTransform as_should_be = body.object(end, memory.exact).X, as_is = body.object(end, state).X;
  const auto J = body.object_jacobian(t, state.q);
  const rod::StrainMatrix spread = memory.spread.topLeftCorner(body.size(), body.size());
  const Eigen::Matrix<double, 6, 1> squared = (J * spread).cwiseProduct(J).rowwise().sum().cwiseMax(0.0);
  const double extent = std::sqrt(squared.head<3>().sum());
  memory.error_bound = (as_is.translation() - as_should_be.translation()).norm() + extent;
  memory.angle_bound = math::turn_between(as_should_be, as_is).norm() + std::sqrt(squared.tail<3>().sum());
  // Further out than the rod is long, what holds to first order says nothing.
  if (!(extent < body.shape().length() && std::isfinite(memory.error_bound + memory.angle_bound))) {
    forget_error(state, memory);
    memory.error_bound = memory.angle_bound = 0.0;
  }
  if (memory.bounded) span.report.bounds.add({std::nullopt, memory.error_bound, memory.angle_bound, 0});
}

void StepControl::fall_back(Span& span, double t, double h, dynamics::StrainState& state) const {
  Tried tried{state};
  fallback_step(span.body, span.handle, t, h, tried.state);
  tried.in_range = span.body.shape().admissible(span.body.full_state(t + h, tried.state).q);
  ++span.report.fallback;
  take(span, t, h, tried, state);
}

bool StepControl::step_in_halves(Span& span, double t, double h, int level, bool failed,
                                 dynamics::StrainState& state) const {
  Tried tried = try_step(span, t, h, state);
  const bool last = failed || level == most_halvings || !integrator_->stiffly_stable();
  const double energy = std::max(span.memory.energy, tried.energy);
  // The last may run into debt, which later ones pay: what comes in its place errs by far more.
  const double saved = span.memory.energy_saved, debt = saved + energy_reserve;
  const auto share = [&](double credit) { return energy_drift_rate * (h + credit) * energy; };
  const double allowed = share(last ? debt : std::max(saved, 0.0));
  const dynamics::Integrator::Energy kind = integrator_->energy();
  const bool conserved = kind == dynamics::Integrator::Energy::conserved;
  double found = tried.solved && conserved ? tried.energy_error : 0.0;
  if (tried.solved && kind == dynamics::Integrator::Energy::dissipated) {
    found = EnergyGain(span.body, span.body.state_at(span.handle, t + h), state)(tried.state);
  }
  bool good = tried.solved && found <= allowed;
  if (good) {
    weigh(span, t, h, state, tried);
    if (conserved) found = tried.energy_error;
    good = found <= allowed;
  }
  // A gain falls with the length of the steps to the order of the method. An estimate may be far from its error.
  const auto hopeless = [&] {
    return !conserved && std::ldexp(found, -integrator_->order() * (most_halvings - level)) > share(debt);
  };
  if (!good && !last && !hopeless()) {
    ++span.report.substeps;
    good = step_in_halves(span, t, 0.5 * h, level + 1, false, state);
    return step_in_halves(span, t + 0.5 * h, 0.5 * h, level + 1, !good, state) || good;
  }
  if (good) span.memory.level = std::max(span.memory.level, level);
  good ? take(span, t, h, tried, state) : fall_back(span, t, h, state);
  return good;
}

void StepControl::steps_to_tolerance(Span& span, double t, double h, dynamics::StrainState& state) const {
  Memory& memory = span.memory;
  const double end = t + h, shortest = std::max(smallest_step * h, shortest_step), order = integrator_->order();
  int tries = 0;
  while (end - t > 1e-9 * h) {
    const double left = end - t;
    // Of equal parts the lengths are few: a method may keep what it has computed for one.
    const double dt = left / std::max(1.0, std::ceil(left / memory.next_h - stretch));
    const bool smallest = dt < 2.0 * shortest;
    Tried tried = try_step(span, t, dt, state);
    dynamics::StrainState error = memory.error;
    double growth = least_growth;
    bool good = false;
    if (tried.solved) {
      integrator_->propagate_deviation(span.body, span.handle, t, dt, state, tried.state, error);
      const ErrorLength length(span.body, t + dt, tried.state);
      const auto amplitude = [&](const rod::StrainVector& q, const rod::StrainVector& q_dot) {
        return std::hypot(length(q), length(memory.swing * q_dot));
      };
      const double allowed = std::max(tolerance_ * dt / undamped_horizon, tolerance_ - amplitude(error.q, error.q_dot));
      const double local = amplitude(tried.estimate.q_error, tried.estimate.q_dot_error);
      error.q += tried.estimate.q_error;
      error.q_dot += tried.estimate.q_dot_error;
      const double size = amplitude(error.q, error.q_dot);
      good = local <= allowed || size <= tolerance_;
      if (!std::isfinite(size)) {  // it cannot be carried on: the maximum above leaves it out
        error = span.body.zero_state();
      } else if (size > tolerance_) {  // short steps take no error back: more than this need not be known
        error.q *= tolerance_ / size;
        error.q_dot *= tolerance_ / size;
      }
      const double power = tries > 0 ? 0.5 : 1.0 / (order + 1.0);  // a stiff step may behave as one of low order
      growth = local > 0.0 ? safety * std::pow(allowed / local, power) : most_growth;
    }
    growth = std::clamp(growth, least_growth, tries > 0 ? 1.0 : most_growth);
    if (good || smallest) {  // which says nothing against a longer step: the span's end may have cut it short
      memory.next_h = std::max({memory.next_h, dt * growth, shortest});
      if (tried.solved) weigh(span, t, dt, state, tried);
      tried.solved ? take(span, t, dt, tried, state) : fall_back(span, t, dt, state);
      memory.error = error;
      t += dt;
      tries = 0;
    } else {
      memory.next_h = std::max(dt * std::min(growth, 0.8), shortest);
      ++span.report.substeps;
      ++tries;
    }
  }
}

}  // namespace spring_workbench::stepping
