#include "exponential.h"

#include "error_spread.h"
#include "held_body_equation.h"
#include "modal_decomposition.h"
#include "spring_workbench/exponential/collocation_step.h"
#include "spring_workbench/exponential/refactorisation.h"
#include "spring_workbench/math/by_size.h"

namespace spring_workbench::dynamics {

class Exponential::Core {
 public:
  virtual ~Core() = default;
  virtual StepEstimate step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                            StrainState& state) = 0;
  /// Returns nullptr if the linear part is that of other equations.
  virtual const Response* response(const HeldBody& body, double h) = 0;
  virtual void propagate_deviation(StrainState& deviation) const = 0;
  virtual void propagate_run_error(const HeldBody& body, RunError& error) = 0;
  virtual StepWork work(const HeldBody& body) const = 0;
  virtual void archive(math::StateArchive& state) = 0;
};

template <int n>
class Exponential::CoreOf final : public Core {
 public:
  StepEstimate step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                    StrainState& state) override {
    if (version_ != body.version() || refactorisation_.is_due(state.q, modes().q_reference, modes().mass)) {
      linearise(body, body.state_at(handle, t), state.q);
    }
    const StrainState begin = state;
    const bool predicted = steps_.has_history();
    StepEstimate e = iterate(body, handle, t, h, state);
    if (!e.converged && (predicted || begin.q != modes().q_reference)) {
      linearise(body, body.state_at(handle, t), begin.q);
      state = begin;
      e = iterate(body, handle, t, h, state);
    }
    return e;
  }

  const Response* response(const HeldBody& body, double h) override {
    if (version_ != body.version()) return nullptr;
    steps_.prepare(h);
    if (response_revision_ != steps_.propagator().revision()) {
      const Eigen::Matrix<double, 2 * n, n> end = steps_.propagator().response(modes().inverse_mass);
      response_ = {end.template topRows<n>(), end.template bottomRows<n>()};
      response_revision_ = steps_.propagator().revision();
    }
    return &response_;
  }

  void propagate_deviation(StrainState& deviation) const override {
    Modes y;
    y << deviation.q, deviation.q_dot;
    y = steps_.propagator().carried(y);
    deviation = {y.template head<n>(), y.template tail<n>()};
  }

  void propagate_run_error(const HeldBody& body, RunError& run) override { follow_error(body, run); }
  StepWork work(const HeldBody& body) const override { return work_of(body, steps_); }

  void archive(math::StateArchive& state) override {
    state(version_);
    if (version_ >= 0) state(steps_, refactorisation_);  // otherwise nothing has been derived from the equations yet
  }

 private:
  using Equation = HeldBodyEquation<n>;
  using Steps = exponential::CollocationStep<n, Equation>;
  using Strain = typename Steps::Strain;
  using Modes = typename Steps::Modes;

  const ModalDecomposition& modes() const { return steps_.propagator().modes(); }

  void linearise(const HeldBody& body, const HandleState& handle, const rod::StrainVector& q) {
    refactorisation_.restart(q);
    steps_.set(modal_decomposition(body, handle, q));
    version_ = body.version();
  }

  SPRING_WORKBENCH_WIDE StepEstimate iterate(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                                             StrainState& state) {
    Strain q = state.q, q_dot = state.q_dot;
    const typename Steps::Result result = steps_.step(Equation(body), handle, t, h, q, q_dot);
    refactorisation_.add(steps_.convergence().iterations());
    state.q = q;
    state.q_dot = q_dot;
    return {result.error.template head<n>(), modes().fastest * h, result.error.template tail<n>(), result.solved};
  }
  SPRING_WORKBENCH_WIDE void follow_error(const HeldBody& body, RunError& run) {
    spread_.propagate(Equation(body), steps_, run);
  }

  long version_ = -1;  ///< of the equations that the linear part belongs to
  Steps steps_;
  exponential::Refactorisation<n> refactorisation_;
  ErrorSpread<n> spread_;
  Response response_;           ///< of the linear part to constant forces over a step
  long response_revision_ = 0;  ///< of the propagator that it is of
};

Exponential::Exponential() = default;
Exponential::~Exponential() = default;

Exponential::Core& Exponential::core(int n) {
  if (n == n_) return *core_;
  n_ = n;
  core_ = math::by_size(
      n, [](auto size) -> std::unique_ptr<Core> { return std::unique_ptr<Core>(new CoreOf<decltype(size)::value>); });
  return *core_;
}

StepEstimate Exponential::step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                               StrainState& state) {
  if (body.size() == 0) return {rod::StrainVector::Zero(0), 0.0, rod::StrainVector::Zero(0), true};
  return core(body.size()).step(body, handle, t, h, state);
}

void Exponential::propagate_deviation(const HeldBody&, const motion::Trajectory&, double, double, const StrainState&,
                                      const StrainState&, StrainState& deviation) {
  if (deviation.q.size() > 0) core_->propagate_deviation(deviation);  // of the last step
}

void Exponential::propagate_run_error(const HeldBody& body, RunError& error) {
  if (body.size() > 0) core_->propagate_run_error(body, error);  // of the last step
}

std::optional<StepWork> Exponential::work(const HeldBody& body) const {
  return body.size() > 0 ? std::optional(core_->work(body)) : std::nullopt;
}

void Exponential::archive(math::StateArchive& state) {
  int n = n_;
  state(n);
  if (n > 0) return core(n).archive(state);
  core_.reset();
  n_ = 0;
}

Integrator::Response Exponential::response(const HeldBody& body, const HandleState& handle, double h,
                                           const StrainState& state) {
  const Response* known = body.size() > 0 && body.size() == n_ ? core_->response(body, h) : nullptr;
  return known != nullptr ? *known : Integrator::response(body, handle, h, state);
}

}  // namespace spring_workbench::dynamics
