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
#include "spring_workbench/math/quintic.h"
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

void Integrator::propagate_deviation(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                                     const StrainState& begin, const StrainState& end, StrainState& deviation) {
  StrainState other{begin.q + deviation.q, begin.q_dot + deviation.q_dot};
  step(body, handle, t, h, other);
  deviation = {other.q - end.q, other.q_dot - end.q_dot};
}

Integrator::Response Integrator::response(const HeldBody& body, const HandleState& handle, double h,
                                          const StrainState& state) {
  Response r;
  const rod::StrainMatrix unit = rod::StrainMatrix::Identity(body.size(), body.size());
  r.q_dot = h * LinearisedMotion(body, handle, state.q).implicit(h).solve(unit);
  r.q = h * r.q_dot;
  return r;
}

StepEstimate SemiImplicitEuler::step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                                     StrainState& state) {
  const rod::StrainVector a = body.acceleration(body.state_at(handle, t), state.q, state.q_dot);
  state.q_dot += h * a;
  state.q += h * state.q_dot;
  const rod::StrainVector a_end = body.acceleration(body.state_at(handle, t + h), state.q, state.q_dot);
  // h² a against h² (2 a + a_end) / 6, and h a against h (a + a_end) / 2.
  return {h * h / 6.0 * (4.0 * a - a_end), 0.0, 0.5 * h * (a - a_end)};
}

void SemiImplicitEuler::propagate_deviation(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                                            const StrainState& begin, const StrainState& end, StrainState& deviation) {
  const rod::StrainVector q = begin.q + deviation.q, q_dot = begin.q_dot + deviation.q_dot;
  deviation.q_dot = q_dot + h * body.acceleration(body.state_at(handle, t), q, q_dot) - end.q_dot;
  deviation.q = q + h * (end.q_dot + deviation.q_dot) - end.q;
}

namespace {

using Point = math::CurvePoint<rod::StrainVector>;

/// The state and the acceleration that belongs to it.
Point point(const HeldBody& body, const HandleState& handle, const StrainState& state) {
  return {state.q, state.q_dot, body.acceleration(handle, state.q, state.q_dot)};
}

/// The state after a step by the classical method.
StrainState classical_step(const HeldBody& body, const HandleState& middle, const HandleState& end, double h,
                           const Point& begin) {
  const auto& [q, v, a] = begin;
  const rod::StrainVector v2 = v + 0.5 * h * a;
  const rod::StrainVector a2 = body.acceleration(middle, q + 0.5 * h * v, v2);
  const rod::StrainVector v3 = v + 0.5 * h * a2;
  const rod::StrainVector a3 = body.acceleration(middle, q + 0.5 * h * v2, v3);
  const rod::StrainVector v4 = v + h * a3;
  const rod::StrainVector a4 = body.acceleration(end, q + h * v3, v4);
  return {q + h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4), v + h / 6.0 * (a + 2.0 * a2 + 2.0 * a3 + a4)};
}

/// Estimates the error of a step of order up to four from the defect of the quintic at a quarter and three quarters.
StepEstimate end_error(const HeldBody& body, const motion::Trajectory& handle, double t, double h, const Point& begin,
                       const Point& end) {
  // The quintic's second derivative by an end that is off by (e, h ė = g): (H'' e + G'' g) / h², H and G its shapes.
  const auto defect = [&](double u) {
    const Point p = math::quintic(begin, end, h, u);
    return rod::StrainVector(h * h * (p.x_ddot - body.acceleration(body.state_at(handle, t + u * h), p.x, p.x_dot)));
  };
  const rod::StrainVector d1 = defect(0.25), d3 = defect(0.75);
  const rod::StrainVector g = (d1 + d3) / 2.25;  // H''(¼) = −H''(¾) = 5.625, G''(¼) = −1.6875, G''(¾) = 3.9375
  return {(d1 + 1.6875 * g) / 5.625, 0.0, g / h};
}

}  // namespace

StepEstimate RungeKutta4::step(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                               StrainState& state) {
  const Point begin = point(body, body.state_at(handle, t), state);
  const HandleState end = body.state_at(handle, t + h);
  state = classical_step(body, body.state_at(handle, t + 0.5 * h), end, h, begin);
  return end_error(body, handle, t, h, begin, point(body, end, state));
}

void RungeKutta4::propagate_deviation(const HeldBody& body, const motion::Trajectory& handle, double t, double h,
                                      const StrainState& begin, const StrainState& end, StrainState& deviation) {
  const StrainState other{begin.q + deviation.q, begin.q_dot + deviation.q_dot};
  const auto [q, q_dot] = classical_step(body, body.state_at(handle, t + 0.5 * h), body.state_at(handle, t + h), h,
                                         point(body, body.state_at(handle, t), other));
  deviation = {q - end.q, q_dot - end.q_dot};
}

}  // namespace spring_workbench::dynamics
