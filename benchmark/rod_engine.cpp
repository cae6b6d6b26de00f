#include "benchmark/rod_engine.h"

#include <chrono>
#include <cmath>

#include "spring_workbench/math/so3.h"
#include "spring_workbench/math/spatial.h"
#include "spring_workbench/rod/tip_fit.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kReached = 1e-6;  // of the length, or rad; what is left where the rod does reach the tip is rounding

/// The body after a step of semi-implicit Euler without the rod.
BodyState flown(const dynamics::HeldBody& held, BodyState body, double h) {
  const Matrix3d& I = held.body().inertia_O;
  body.v_WO_W -= h * held.gravity() * Vector3d::UnitZ();
  body.w_WO_O -= h * I.llt().solve(body.w_WO_O.cross(I * body.w_WO_O));
  body.p_WO += h * body.v_WO_W;
  body.R_WO = body.R_WO * Quaterniond(math::exp_so3(h * body.w_WO_O));
  return body;
}

/// The motion of the tip, at `p_OE` in the body and with its axes.
motion::MotionState tip_of(const BodyState& body, const Vector3d& p_OE) {
  motion::MotionState tip;
  tip.X.linear() = body.R_WO.toRotationMatrix();
  const Vector3d r = tip.X.linear() * p_OE;
  tip.X.translation() = body.p_WO + r;
  tip.velocity.angular = tip.X.linear() * body.w_WO_O;
  tip.velocity.linear = body.v_WO_W + tip.velocity.angular.cross(r);
  return tip;
}

/// The body's inertia for strain rates, as HeldBody::mass_matrix(), from the Jacobian that the fit has already.
Matrix6d mass_matrix(const dynamics::HeldBody& held, const rod::TipFit<double>& fit, const Vector3d& p_OE) {
  const Matrix3d R_HO = math::matrix(fit.tip.R_HE, 0);
  const Vector3d p_EO = -(R_HO * p_OE);
  Matrix6d J;  // velocity in H axes, and angular velocity in the body's
  for (int j = 0; j < rod::max_strain_coordinates; ++j) {
    const Vector3d w = math::vector(fit.tip.angular[j]);
    J.col(j) << math::vector(fit.tip.linear[j]) + w.cross(p_EO), R_HO.transpose() * w;
  }
  return J.transpose() * spatial_matrix(held.body().mass, held.body().inertia_O) * J;
}

bool reaches(const rod::TipFit<double>& fit, const dynamics::RelativeMotion<double>& H_E, double length) {
  const Matrix3d turn = math::matrix(H_E.R_AB, 0).transpose() * math::matrix(fit.tip.R_HE, 0);
  return math::vector(H_E.p_AB - fit.tip.p_HE).norm() < kReached * length && math::log_so3(turn).norm() < kReached;
}

}  // namespace

RodForce::RodForce(const RodCase& one, const std::string& shape, When when)
    : held_(held_body(one, shape)),
      stiffness_(held_.stiffness().asDiagonal()),
      damping_(held_.damping()),
      samples_(one.hand, one.fork.length),
      when_(when),
      hand_(samples_.handle(0.0).body_rate_state(0.0)) {}

bool RodForce::can_push(const RodCase& one, const std::string& shape) {
  return held_body(one, shape).size() == rod::max_strain_coordinates;
}

FreeBody RodForce::body() const {
  const motion::MotionState O = held_.object(held_.state_at(samples_.handle(0.0), 0.0), held_.zero_state());
  const Vector3d w_WO_O = O.X.linear().transpose() * O.velocity.angular;
  return {held_.body().mass,
          held_.body().inertia_O.diagonal(),
          held_.gravity(),
          {O.X.translation(), Quaterniond(O.X.linear()), O.velocity.linear, w_WO_O}};
}

void RodForce::move_hand(double t) {
  if (t == t_) return;
  const RigidTransform before = hand_.X;
  hand_ = samples_.handle(t).body_rate_state(t);
  if (when_ == When::each_stage) return;
  hand_.v_W = (hand_.X.translation() - before.translation()) / (t - t_);
  hand_.w_B = math::log_so3(before.linear().transpose() * hand_.X.linear()) / (t - t_);
}

Wrench RodForce::load(double t, double h, const BodyState& body) {
  if (lost_) return {};
  const bool ahead = when_ == When::end_of_step;
  if (ahead) t += h;
  const Vector3d& p_OE = held_.body().X_OE.translation();
  const motion::MotionState tip = tip_of(ahead ? flown(held_, body, h) : body, p_OE);
  move_hand(t);
  const dynamics::RelativeMotion<double> H_E = dynamics::relative_motion(hand_, tip);
  const Vector6d start = q_ + (t - t_) * q_dot_;
  const rod::TipFit<double> fit(held_.shape(), H_E.R_AB, H_E.p_AB, H_E.v_AB, H_E.w_AB, start.data());
  lost_ = !reaches(fit, H_E, held_.shape().length());
  if (lost_) return {};
  q_ = Eigen::Map<const Vector6d>(fit.q);
  q_dot_ = Eigen::Map<const Vector6d>(fit.q_dot);
  t_ = t;
  Vector6d pull = -(stiffness_ * q_ + damping_ * q_dot_);
  if (ahead) {
    // The load changes rate and strain by h M⁻¹ pull and h² M⁻¹ pull.
    const Matrix6d M = mass_matrix(held_, fit, p_OE);
    pull = M * (M + h * (damping_ + h * stiffness_)).llt().solve(pull);
  }
  math::Vec3<double> force{}, moment{};
  double generalised[rod::max_strain_coordinates];
  Eigen::Map<Vector6d>{generalised} = pull;
  fit.wrench(generalised, force, moment);
  const Matrix3d& R_WH = hand_.X.linear();
  Wrench load{R_WH * math::vector(force), R_WH * math::vector(moment)};
  load.moment += (tip.X.linear() * p_OE).cross(load.force);
  return load;
}

RodRun run_engine(const RodCase& one, const std::string& shape, const RodEngine& engine, double step) {
  using Clock = std::chrono::steady_clock;
  RodForce force(one, shape, engine.when);
  const auto body =
      engine.make(force.body(), [&force](double t, double h, const BodyState& now) { return force.load(t, h, now); });
  const std::vector<double> times = output_times(one), ends = step_ends(one);
  RodRun run;
  run.X_WO.reserve(times.size());
  const auto keep_pose = [&] {
    const BodyState now = body->state();
    run.X_WO.push_back(make_transform(now.p_WO, now.R_WO));
    return !force.lost() && is_bounded(now.p_WO) && now.R_WO.coeffs().allFinite();
  };
  const Clock::time_point begun = Clock::now();
  keep_pose();
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double from = ends[i - 1], span = ends[i] - from;
    const int count = static_cast<int>(std::ceil(span / step * (1.0 - 1e-9)));
    for (int j = 0; j < count && !force.lost(); ++j) body->step(from + j * (span / count), span / count);
    run.steps += count;
    if (ends[i] > times[run.X_WO.size()] - kSameTime && !keep_pose()) return run;
  }
  run.wall_seconds = std::chrono::duration<double>(Clock::now() - begun).count();
  run.finite = true;
  return run;
}

}  // namespace spring_workbench::benchmark
