#include "spring_workbench/dynamics/integrator.h"

#include <algorithm>
#include <cmath>
#include <typeinfo>
#include <utility>

#include "exponential.h"
#include "implicit_integrators.h"
#include "integrators.h"
#include "paper.h"
#include "spring_workbench/dynamics/linearised_motion.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::dynamics {
namespace {

using MakeIntegrator = std::function<std::unique_ptr<Integrator>()>;

template <typename OurOwn>
std::unique_ptr<Integrator> make() {
  return std::make_unique<OurOwn>();
}

/// Names and makers by IntegratorKind: our own in its order, then those registered.
struct Known {
  std::vector<std::string> names = {"exponential", "rosenbrock",          "implicit_euler",
                                    "paper",       "semi_implicit_euler", "rk4"};
  std::vector<MakeIntegrator> makers = {make<Exponential>, make<Rosenbrock>,        make<ImplicitEuler>,
                                        make<Paper>,       make<SemiImplicitEuler>, make<RungeKutta4>};
};

Known& known() {
  static Known integrators;
  return integrators;
}

}  // namespace

const std::vector<std::string>& names_of(IntegratorKind) { return known().names; }

const std::vector<std::string>& names_of(Inertia) {
  static const std::vector<std::string> names = {"exact", "point_mass"};
  return names;
}

std::unique_ptr<Integrator> make_integrator(IntegratorKind kind) {
  return known().makers.at(static_cast<std::size_t>(kind))();
}

void swap_alike(std::unique_ptr<Integrator>& a, std::unique_ptr<Integrator>& b) {
  const Integrator &of_a = *a, &of_b = *b;
  if (typeid(of_a) == typeid(of_b) && of_a.restores_completely()) a.swap(b);
}

IntegratorKind register_integrator(const std::string& name, MakeIntegrator make) {
  auto& [names, makers] = known();
  if (name.empty() || std::find(names.begin(), names.end(), name) != names.end()) {
    validation::refuse("", "name", name, "a name other than " + validation::join(names));
  }
  names.push_back(name);
  makers.push_back(std::move(make));
  return static_cast<IntegratorKind>(names.size() - 1);
}

void Integrator::propagate_deviation(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                                     const StrainState& begin, const StrainState& end, StrainState& deviation) {
  StrainState other{begin.q + deviation.q, begin.q_dot + deviation.q_dot};
  step(body, handle, t, h, other);
  deviation = {other.q - end.q, other.q_dot - end.q_dot};
}

Integrator::Response Integrator::response(const HeldBody& body, const HandleForcing& handle, double h,
                                          const StrainState& state) {
  Response r;
  const rod::StrainMatrix unit = rod::StrainMatrix::Identity(body.size(), body.size());
  r.q_dot = h * LinearisedMotion(body, handle, state.q).implicit(h).solve(unit);
  r.q = h * r.q_dot;
  return r;
}

StepEstimate SemiImplicitEuler::step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                                     StrainState& state) {
  const rod::StrainVector a = body.acceleration(body.forcing(handle, t), state.q, state.q_dot);
  state.q_dot += h * a;
  state.q += h * state.q_dot;
  const rod::StrainVector a_end = body.acceleration(body.forcing(handle, t + h), state.q, state.q_dot);
  // h² a against h² (2 a + a_end) / 6, and h a against h (a + a_end) / 2.
  return {h * h / 6.0 * (4.0 * a - a_end), 0.0, 0.5 * h * (a - a_end)};
}

namespace {

struct QuinticPoint {
  rod::StrainVector q, q_dot, q_ddot;
};

/// The quintic through state and acceleration at both ends of a step of `h` [s], at its fraction `u`, 0 … 1.
QuinticPoint quintic(const StrainState& begin, const rod::StrainVector& a_begin, const StrainState& end,
                     const rod::StrainVector& a_end, double h, double u) {
  // q₀ + u (h v₀ + u (h² a₀ / 2 + u (c₃ + u (c₄ + u c₅)))).
  const rod::StrainVector rise = end.q - begin.q - h * begin.q_dot - 0.5 * h * h * a_begin;
  const rod::StrainVector slope = h * (end.q_dot - begin.q_dot) - h * h * a_begin;
  const rod::StrainVector bend = h * h * (a_end - a_begin);
  const rod::StrainVector c3 = 10.0 * rise - 4.0 * slope + 0.5 * bend;
  const rod::StrainVector c4 = -15.0 * rise + 7.0 * slope - bend;
  const rod::StrainVector c5 = 6.0 * rise - 3.0 * slope + 0.5 * bend;
  return {begin.q + u * (h * begin.q_dot + u * (0.5 * h * h * a_begin + u * (c3 + u * (c4 + u * c5)))),
          begin.q_dot + u * h * a_begin + u * u / h * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)),
          a_begin + u / (h * h) * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5))};
}

struct StepEnd {
  const StrainState& state;
  const rod::StrainVector& q_ddot;
};

/// Estimates the error of a step of order up to four from the defect of the quintic at a quarter and three quarters.
StepEstimate end_error(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                       const StepEnd& begin, const StepEnd& end) {
  // The quintic's second derivative by an end that is off by (e, h ė = g): (H'' e + G'' g) / h², H and G its shapes.
  const auto defect = [&](double u) {
    const QuinticPoint p = quintic(begin.state, begin.q_ddot, end.state, end.q_ddot, h, u);
    return rod::StrainVector(h * h * (p.q_ddot - body.acceleration(body.forcing(handle, t + u * h), p.q, p.q_dot)));
  };
  const rod::StrainVector d1 = defect(0.25), d3 = defect(0.75);
  const rod::StrainVector g = (d1 + d3) / 2.25;  // H''(¼) = −H''(¾) = 5.625, G''(¼) = −1.6875, G''(¾) = 3.9375
  return {(d1 + 1.6875 * g) / 5.625, 0.0, g / h};
}

}  // namespace

StepEstimate RungeKutta4::step(const HeldBody& body, const motion::FrameMotion& handle, double t, double h,
                               StrainState& state) {
  const StrainState s0 = state;
  const rod::StrainVector a1 = body.acceleration(body.forcing(handle, t), s0.q, s0.q_dot);
  const HandleForcing middle = body.forcing(handle, t + 0.5 * h);
  const HandleForcing end = body.forcing(handle, t + h);
  const rod::StrainVector v2 = s0.q_dot + 0.5 * h * a1;
  const rod::StrainVector a2 = body.acceleration(middle, s0.q + 0.5 * h * s0.q_dot, v2);
  const rod::StrainVector v3 = s0.q_dot + 0.5 * h * a2;
  const rod::StrainVector a3 = body.acceleration(middle, s0.q + 0.5 * h * v2, v3);
  const rod::StrainVector v4 = s0.q_dot + h * a3;
  const rod::StrainVector a4 = body.acceleration(end, s0.q + h * v3, v4);
  state.q = s0.q + h / 6.0 * (s0.q_dot + 2.0 * v2 + 2.0 * v3 + v4);
  state.q_dot = s0.q_dot + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  const rod::StrainVector a_end = body.acceleration(end, state.q, state.q_dot);
  return end_error(body, handle, t, h, {s0, a1}, {state, a_end});
}

}  // namespace spring_workbench::dynamics
