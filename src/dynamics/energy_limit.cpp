#include "energy_limit.h"

#include <algorithm>
#include <cmath>

namespace spring_workbench::dynamics {
namespace {

/// Of the energy that moves to and fro: what may come back above the lowest value since the handle rests.
constexpr double allowance = 1e-11;
constexpr double same_time = 1e-9;  ///< of the step: the end of the last half of a step and of the step
constexpr int halvings = 40;        ///< of the way back to where the step began

struct Energy {
  double kinetic, potential;  ///< [J]
};

/// With the weight's zero where the fork is straight.
Energy energy_of(const HeldBody& body, const HandleForcing& handle, const StrainState& state) {
  const motion::MotionState o = body.object(handle, state);
  const double height = o.X.translation().z() - body.object(handle, body.zero_state()).X.translation().z();
  return {body.kinetic_energy(o.velocity, o.X.linear()),
          body.elastic_energy(handle.t, state) + body.body().mass * body.gravity() * height};
}

bool at_rest(const HandleForcing& handle) {
  return handle.v_WH_W.isZero(0.0) && handle.angular_velocity.isZero(0.0) && handle.angular_acceleration.isZero(0.0);
}

bool applies(const HeldBody& body, const HandleForcing& begin, const HandleForcing& end) {
  const Wrench& load = body.external_wrench();
  return at_rest(begin) && at_rest(end) && begin.X_WH.matrix() == end.X_WH.matrix() && load.force.isZero(0.0) &&
         load.moment.isZero(0.0) && !body.returning();
}

}  // namespace

bool hold_energy(const HeldBody& body, const motion::FrameMotion& handle, double t, double h, const StrainState& begin,
                 StrainState& end, StepControl::Memory& memory) {
  const HandleForcing from = body.forcing(handle, t), to = body.forcing(handle, t + h);
  if (!applies(body, from, to)) {
    memory.rests = false;
    return false;
  }
  const bool goes_on = memory.rests && memory.version == body.version() && std::abs(memory.t - t) <= same_time * h &&
                       memory.X_WH.matrix() == from.X_WH.matrix();
  if (!goes_on) {
    const Energy e = energy_of(body, from, begin);
    memory.lowest_energy = e.kinetic + e.potential;
    memory.energy_scale = e.kinetic + std::abs(e.potential);
    memory.X_WH = from.X_WH;
    memory.rests = true;
  }
  Energy e = energy_of(body, to, end);
  const double limit = memory.lowest_energy + allowance * memory.energy_scale;
  const bool too_much = e.kinetic + e.potential > limit;
  if (too_much) {
    if (e.potential > limit) {
      // The part of the way that the energy allows; none of it is always allowed.
      double shortest = 0.0, longest = 1.0;
      const rod::StrainVector way = end.q - begin.q;
      for (int i = 0; i < halvings; ++i) {
        const double part = 0.5 * (shortest + longest);
        const bool allowed = energy_of(body, to, {begin.q + part * way, 0.0 * way}).potential <= limit;
        (allowed ? shortest : longest) = part;
      }
      end.q = begin.q + shortest * way;
      e = energy_of(body, to, end);
    }
    const double left = std::max(0.0, limit - e.potential);
    if (e.kinetic > left) end.q_dot *= std::sqrt(left / e.kinetic);
    e = energy_of(body, to, end);
  }
  memory.lowest_energy = std::min(memory.lowest_energy, e.kinetic + e.potential);
  return too_much;
}

}  // namespace spring_workbench::dynamics
