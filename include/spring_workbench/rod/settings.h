#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::rod {

/// One number per degree of freedom (DOF) of the fork. As in the paper (section 4), a DOF is a group of strain
/// coordinates that are switched on and off together.
struct PerDof {
  double stretch = 0.0;  ///< value for the extension along the rod
  double bend = 0.0;     ///< value for the deflection of the tip across the rod
  double torsion = 0.0;  ///< value for the torsion about the rod

  /// Whether all three numbers are the same.
  bool uniform() const { return stretch == bend && bend == torsion; }
  void archive(math::StateArchive& state) { state(stretch, bend, torsion); }  ///< saves or restores all three
};

/// Whether all three numbers are equal.
inline bool operator==(const PerDof& a, const PerDof& b) {
  return a.stretch == b.stretch && a.bend == b.bend && a.torsion == b.torsion;
}

/// The DOFs that are switched on (deformation DOFs of the paper, section 4). The fork is rigid in all other DOFs.
struct ForkDofs {
  bool stretch = true;  ///< whether the rod can change its length
  bool bend = true;     ///< whether the rod can bend
  bool torsion = true;  ///< whether the rod can twist

  void archive(math::StateArchive& state) { state(stretch, bend, torsion); }  ///< saves or restores all three
  /// Whether the same DOFs are on.
  bool operator==(const ForkDofs& o) const { return stretch == o.stretch && bend == o.bend && torsion == o.torsion; }
};

/// A change of some values of a PerDof (`T` double) or of ForkDofs (`T` bool). Absent values are not changed.
template <typename T>
struct PerDofChange {
  std::optional<T> stretch;  ///< new value for stretch
  std::optional<T> bend;     ///< new value for bend
  std::optional<T> torsion;  ///< new value for torsion

  bool empty() const { return !stretch && !bend && !torsion; }  ///< whether it changes nothing
  /// Returns `all` with this change.
  template <typename All>
  All applied_to(const All& all) const {
    return {stretch.value_or(all.stretch), bend.value_or(all.bend), torsion.value_or(all.torsion)};
  }
  void archive(math::StateArchive& state) { state(stretch, bend, torsion); }  ///< saves or restores all three
};

/// Shape models of the fork (doc/model.md, "Shape models").
enum class ShapeKind {
  constant,  ///< a rod whose curvature is constant along it: four coordinates
  linear,    ///< a rod whose curvature is linear along it: six coordinates, the default
  bushing,   ///< springs at the tip instead of a rod: six coordinates
};
const std::vector<std::string>& names_of(ShapeKind);  ///< words for the shape models in settings

/// Meaning of the damping values.
enum class DampingLaw {
  per_dof,       ///< one ratio per DOF (Kelvin–Voigt)
  modal,         ///< one ratio for all modes of the held body
  coefficients,  ///< one coefficient per DOF
};
const std::vector<std::string>& names_of(DampingLaw);  ///< words for the damping laws in settings

/// Settings of the spring-fork's elastic part (doc/model.md, "The rod").
struct ForkSettings {
  ShapeKind shape = ShapeKind::linear;  ///< shape model (key `shape`)
  double length = 0.2;                  ///< key `fork.length` [m], 1e-4 … 1e3: rest length L
  /// Keys `fork.stiffness.…` [N/m, N/m, N·m/rad], 0 … 1e16: force at the tip per displacement of the tip, along and
  /// across the rod, and moment per angle. These are not the EA and EI of the rod's section.
  PerDof stiffness{2000.0, 500.0, 5.0};
  /// Key `fork.stiffness.slope` [N·m/rad], 1e-12 … 1e16: stiffness of the end slope of the shape `bushing`, for a bend
  /// stiffness > 0. Absent: k_bend L² / 3, as for a rod.
  std::optional<double> slope_stiffness;
  PerDof damping_ratio{1.0, 1.0, 1.0};  ///< keys `fork.damping.…`: ζ, 0 … 10; 1 is critical
  /// Keys `fork.damping_coefficient.…` [N·s/m, N·s/m, N·m·s/rad], 0 … 1e12: used by the law `coefficients`.
  PerDof damping_coefficient;
  DampingLaw damping_law = DampingLaw::per_dof;  ///< meaning of the damping values (key `fork.damping_law`)
  ForkDofs dofs;                                 ///< deformations that are possible (keys `fork.dofs.…`)
  /// Key `fork.switch_off_time` [s], 1e-6 … 1e3: time constant of the return to zero of a DOF that is switched off
  /// while strained. From rest, its strain falls to 1 % in 6.6 time constants.
  double switch_off_time = 0.05;

  /// The values that can be changed while an object is held.
  auto changeable() const { return std::tie(dofs, stiffness, damping_ratio, damping_coefficient, damping_law); }
  /// The damping values in force: the ratios or the coefficients, as `damping_law` says.
  PerDof& damping() { return damping_law == DampingLaw::coefficients ? damping_coefficient : damping_ratio; }
  /// The damping values in force: the ratios or the coefficients, as `damping_law` says.
  const PerDof& damping() const {
    return damping_law == DampingLaw::coefficients ? damping_coefficient : damping_ratio;
  }
};

/// A change of the fork while running. Absent values are not changed. Ranges are as in ForkSettings.
struct ForkChange {
  PerDofChange<bool> dofs;                   ///< true: the DOF is on; false: it is rigid
  PerDofChange<double> stiffness;            ///< stiffness [N/m, N/m, N·m/rad]
  PerDofChange<double> damping_ratio;        ///< damping ratios ζ; 1 is critical
  PerDofChange<double> damping_coefficient;  ///< damping coefficients [N·s/m, N·s/m, N·m·s/rad]
  std::optional<DampingLaw> damping_law;     ///< the damping law
  /// Damping values for the law in force after the change: coefficients with the law `coefficients`, otherwise ratios.
  /// Example: {0.2, 0.2, 0.2} sets all ratios of a fork with the law `per_dof`. Ratios that are not all equal change
  /// the law `modal` to `per_dof`, unless `damping_law` asks for `modal`.
  PerDofChange<double> damping;

  bool empty() const { return dofs.empty() && !changes_springs(); }  ///< whether it changes nothing
  bool changes_springs() const;                                      ///< whether it changes stiffness or damping
  /// Returns the fork with this change.
  ForkSettings applied_to(ForkSettings fork) const;
};

/// Returns the change that gives any fork the springs, dampers and DOFs of `fork`. Shape and length are not changed.
ForkChange change_to(const ForkSettings& fork);

/// Returns springs, damping values in force and active DOFs as a text: "stiffness 2000 N/m, 500 N/m, 5 N m/rad; …".
std::string in_words(const ForkSettings& fork);

/// Returns the coefficient [N·s/m] of the damper in parallel with the fork's stretch spring, for a body of `mass` [kg]
/// that this fork alone holds.
double stretch_damping(const ForkSettings& fork, double mass);

}  // namespace spring_workbench::rod
