#include "benchmark/energy_watch.h"

#include <algorithm>
#include <cmath>

namespace spring_workbench::benchmark {
namespace {

constexpr double kGravity = 9.81;  // m/s²

}  // namespace

EnergyWatch::EnergyWatch(double mass, double length) : mass_(mass), largest_(mass * kGravity * length) {}

void EnergyWatch::look(const EnergyLook& now, const motion::MotionSegment& handle) {
  deflection_ = std::max(deflection_, now.from_rigid.norm());
  if (any_) {
    const double h = now.t - last_.t;
    const motion::BodyRateState begin = handle.body_rate_state(last_.t),
                                middle = handle.body_rate_state(last_.t + 0.5 * h), end = handle.body_rate_state(now.t);
    const Vector3d &u0 = begin.v_W, u1 = (4.0 * middle.v_W - 3.0 * begin.v_W - end.v_W) / h,
                   u2 = 2.0 * (begin.v_W - 2.0 * middle.v_W + end.v_W) / (h * h);
    const Vector3d displacement = now.p_WO - last_.p_WO, velocity_change = now.v_WO_W - last_.v_WO_W;
    // ∫(p − p_0) dt for the handle, which moves along a cubic, and for the body relative to it, from the cubic through
    // both ends or, if it oscillates too fast for that, a straight line.
    const Vector3d handle_displacement = end.X.translation() - begin.X.translation(),
                   handle_area =
                       h / 6.0 * (4.0 * (middle.X.translation() - begin.X.translation()) + handle_displacement);
    const Vector3d chord_deviation = -h * h / 12.0 * (velocity_change - (end.v_W - begin.v_W));
    const double widest = 2.0 * h * deflection_;
    const Vector3d area = handle_area + 0.5 * h * (displacement - handle_displacement) +
                          (chord_deviation.norm() <= widest ? chord_deviation : Vector3d(Vector3d::Zero()));
    work_ +=
        mass_ * (u0.dot(velocity_change) + u1.dot(h * now.v_WO_W - displacement) +
                 u2.dot(h * h * now.v_WO_W - 2.0 * h * displacement + 2.0 * area) + kGravity * handle_displacement.z());
    work_squares_ += std::pow(2.0 * mass_ * u2.norm() * std::min(chord_deviation.norm(), widest), 2);
    // Between the calls the body is no farther from the handle than the largest deflection and what the handle moves,
    // to either side, and so is what it is taken for.
    const double sway = 8.0 * mass_ * u2.norm() * h;
    work_per_deflection_ += sway;
    work_per_passage_ +=
        sway * h * std::sqrt(std::max({u0.squaredNorm(), middle.v_W.squaredNorm(), end.v_W.squaredNorm()}));
    estimated_ += now.estimated;
    all_estimated_ += now.estimated;
  }
  any_ = true;
  last_ = now;
  largest_ = std::max(largest_, now.moving);
  const double balance = now.moving + mass_ * kGravity * now.p_WO.z() - work_;
  growth_ = std::max(growth_, balance - lowest_ - std::min(estimated_, max_share * largest_));
  whole_growth_ = std::max(whole_growth_, balance - lowest_);
  growth_beyond_all_ = std::max(growth_beyond_all_, balance - lowest_ - 2.0 * estimated_);
  if (balance > lowest_) return;
  lowest_ = balance;
  estimated_ = 0.0;
}

double EnergyWatch::uncertainty() const { return 3.0 * std::sqrt(work_squares_); }

double EnergyWatch::growth() const { return std::max(0.0, growth_ - uncertainty()) / largest_; }

double EnergyWatch::whole_growth() const { return std::max(0.0, whole_growth_ - uncertainty()) / largest_; }

double EnergyWatch::excess() const {
  return std::max(0.0, growth_beyond_all_ - work_per_deflection_ * deflection_ - work_per_passage_) / largest_;
}

}  // namespace spring_workbench::benchmark
