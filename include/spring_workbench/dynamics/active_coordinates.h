#pragma once

#include <array>
#include <cmath>

#include "spring_workbench/math/state_archive.h"
#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::dynamics {

/// Strain state of the held body, in the active coordinates or (`full`) in all. Units: rod::ShapeModel.
struct StrainState {
  rod::StrainVector q;      ///< strain coordinates
  rod::StrainVector q_dot;  ///< rates of the coordinates, each in the unit of its coordinate per second

  void archive(math::StateArchive& state) { state(q, q_dot); }  ///< saves or restores both
};

/// The active coordinates: the strain coordinates of a shape model that take part in an equation of motion. The
/// coordinates of a DOF that is off are zero. The coordinates of a DOF that is being switched off return to zero in a
/// prescribed, critically damped motion (paper, section 3.3).
class ActiveCoordinates {
 public:
  /// Starts with all `count` coordinates active, 1 … max_strain_coordinates.
  explicit ActiveCoordinates(int count);

  int count() const { return count_; }  ///< number of coordinates of the shape model
  int size() const { return size_; }    ///< number of active coordinates
  /// Returns the coordinate of the shape model that is the `i`-th active one.
  int operator[](int i) const { return active_[static_cast<std::size_t>(i)]; }
  bool returning() const { return returning_ > 0; }  ///< whether a DOF that was switched off still returns to zero
  /// Returns whether a DOF is off and no DOF returns to zero. `range`: the coordinates of the DOF.
  bool is_off(const rod::CoordinateRange& range) const {
    return !returning() && mode_[static_cast<std::size_t>(range.begin)] == Mode::off;
  }

  /// Switches the coordinates of a DOF on or off. If they are switched off while strained in the state `full`, they
  /// return to zero from time `t` [s] on with the time constant `return_time` [s].
  void set(const rod::CoordinateRange& range, bool on, double t, double return_time, const StrainState& full);
  /// Ends the returns that have reached zero by time `t` [s]. Returns whether one ended.
  bool drop_finished_returns(double t);

  /// Returns the active coordinates out of all.
  rod::StrainVector gather(const rod::StrainVector& all) const;
  /// Writes count() coordinates to `all`: the active ones from `active`, and zero for the others.
  template <typename S>
  void scatter(const S* active, S* all) const {
    for (int c = 0; c < count_; ++c) all[c] = S{};
    for (int i = 0; i < size_; ++i) all[(*this)[i]] = active[i];
  }
  /// Returns all coordinates at time `t` [s], including the prescribed ones.
  StrainState full_state(double t, const StrainState& active) const;
  /// Sets lane `k` of the coordinates that return to zero, at time `t` [s]. All other coordinates are left as they are.
  template <typename S>
  void prescribe(double t, int k, S* q, S* q_dot, S* q_ddot) const {
    for (int c = 0; c < count_; ++c) {
      if (mode_[static_cast<std::size_t>(c)] != Mode::returning) continue;
      // (B + A τ) e^{−τ/T}: the paper's critically damped closed form (section 3.3).
      const Return& r = return_[static_cast<std::size_t>(c)];
      const double rate = 1.0 / r.time_constant;
      const double tau = t - r.t0;
      const double decay = std::exp(-rate * tau);
      const double A = r.rate0 + rate * r.q0;
      const double x = (r.q0 + A * tau) * decay, v = A * decay - rate * x;
      math::set_lane(q[c], k, x);
      math::set_lane(q_dot[c], k, v);
      math::set_lane(q_ddot[c], k, -rate * A * decay - rate * v);
    }
  }

  void archive(math::StateArchive& state);  ///< saves or restores which coordinates are active or return

 private:
  enum class Mode { active, off, returning };
  struct Return {
    double t0 = 0.0, time_constant = 1.0, q0 = 0.0, rate0 = 0.0;
    void archive(math::StateArchive& state) { state(t0, time_constant, q0, rate0); }
  };
  void take_modes();

  int count_;
  std::array<Mode, rod::max_strain_coordinates> mode_{};
  std::array<Return, rod::max_strain_coordinates> return_;
  std::array<int, rod::max_strain_coordinates> active_{};
  int size_ = 0;
  int returning_ = 0;
};

}  // namespace spring_workbench::dynamics
