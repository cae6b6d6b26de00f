#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::rod {

/// One number per degree of freedom (DOF) of the fork. A DOF is here what the paper calls one: a group of strain
/// coordinates that are switched together.
struct PerDof {
  double stretch = 0.0;  ///< of the extension along the rod
  double bend = 0.0;     ///< of the deflection of the tip across the rod
  double torsion = 0.0;  ///< of the twist about the rod

  /// Whether all three are the same.
  bool uniform() const { return stretch == bend && bend == torsion; }
  void exchange(math::StateArchive& state) { state(stretch, bend, torsion); }  ///< saves or restores all three
};

/// Whether all three numbers are equal.
inline bool operator==(const PerDof& a, const PerDof& b) {
  return a.stretch == b.stretch && a.bend == b.bend && a.torsion == b.torsion;
}

/// The DOFs that are switched on (the paper's deformation DOFs, section 4). Off means rigid.
struct ForkDofs {
  bool stretch = true;  ///< whether the rod can change its length
  bool bend = true;     ///< whether it can bend
  bool torsion = true;  ///< whether it can twist

  void exchange(math::StateArchive& state) { state(stretch, bend, torsion); }  ///< saves or restores all three
  /// Whether the same DOFs are on.
  bool operator==(const ForkDofs& o) const { return stretch == o.stretch && bend == o.bend && torsion == o.torsion; }
};

/// A change of some values of a PerDof (`T` = double) or of ForkDofs (bool); absent ones stay as they are.
template <typename T>
struct PerDofChange {
  std::optional<T> stretch;  ///< new value for stretching
  std::optional<T> bend;     ///< new value for bending
  std::optional<T> torsion;  ///< new value for torsion

  bool empty() const { return !stretch && !bend && !torsion; }  ///< whether it changes nothing
  /// Returns `all` with this change.
  template <typename All>
  All applied_to(const All& all) const {
    return {stretch.value_or(all.stretch), bend.value_or(all.bend), torsion.value_or(all.torsion)};
  }
  void exchange(math::StateArchive& state) { state(stretch, bend, torsion); }  ///< saves or restores all three
};

/// How the curvature of the rod varies along it (doc/model.md, "Shape models").
enum class ShapeKind { constant, linear, bushing };
const std::vector<std::string>& names_of(ShapeKind);  ///< their words in settings

/// Interpretation of the damping values: one ratio per DOF (Kelvin–Voigt), one ratio for all modes of the held body, or
/// the coefficients themselves.
enum class DampingLaw { per_dof, modal, coefficients };
const std::vector<std::string>& names_of(DampingLaw);  ///< their words in settings

/// The spring-fork's elastic part (doc/model.md, "The rod").
struct ForkSettings {
  ShapeKind shape = ShapeKind::linear;  ///< key `shape`
  double length = 0.2;                  ///< key `fork.length` [m], 1e-4 … 1e3: rest length L
  /// Keys "fork.stiffness.…" [N/m, N/m, N·m/rad], 0 … 1e16: force at the tip per displacement of the tip, along and
  /// across the rod (not the EA and EI of its section), and moment per angle.
  PerDof stiffness{2000.0, 500.0, 5.0};
  std::optional<double>
      slope_stiffness;  ///< key `fork.stiffness.slope` [N·m/rad], 1e-12 … 1e16: for the end slope of the `bushing`,
                        ///< for a bend stiffness > 0; by default k_bend L² / 3, as for a rod
  PerDof damping_ratio{1.0, 1.0, 1.0};  ///< keys `fork.damping.…`: ζ, 0 … 10; 1 is critical
  PerDof damping_coefficient;  ///< keys "fork.damping_coefficient.…" [N·s/m, N·s/m, N·m·s/rad], 0 … 1e12: for
                               ///< the law `coefficients`
  DampingLaw damping_law = DampingLaw::per_dof;  ///< key `fork.damping_law`; `modal` needs one ζ for all DOFs
  ForkDofs dofs;                                 ///< keys `fork.dofs.…`
  double switch_off_time = 0.05;  ///< key `fork.switch_off_time` [s], 1e-6 … 1e3: T of a DOF that is switched off while
                                  ///< strained; from rest its strain falls as (1 + t/T) exp(−t/T): to 1 % in 6.6 T

  /// What can be changed while an object is held.
  auto changeable() const { return std::tie(dofs, stiffness, damping_ratio, damping_coefficient, damping_law); }
  /// The damping values in force: those that `damping_law` uses.
  PerDof& damping() { return damping_law == DampingLaw::coefficients ? damping_coefficient : damping_ratio; }
  /// The damping values in force: those that `damping_law` uses.
  const PerDof& damping() const {
    return damping_law == DampingLaw::coefficients ? damping_coefficient : damping_ratio;
  }
};

/// A change of the fork while running; absent fields stay as they are.
struct ForkChange {
  PerDofChange<bool> dofs;                   ///< true: on; false: rigid
  PerDofChange<double> stiffness;            ///< [N/m, N/m, N·m/rad]
  PerDofChange<double> damping_ratio;        ///< ζ; 1 is critical
  PerDofChange<double> damping_coefficient;  ///< [N·s/m, N·s/m, N·m·s/rad]
  std::optional<DampingLaw> damping_law;     ///< which of these damping values act
  PerDofChange<double> damping;  ///< values of the law in force after the change; three different ones turn the
                                 ///< law `modal`, unless the change asks for it, into `per_dof`

  bool empty() const { return dofs.empty() && !changes_springs(); }  ///< whether it changes nothing
  bool changes_springs() const;                                      ///< whether it changes stiffness or damping
  /// Returns the fork with this change.
  ForkSettings applied_to(ForkSettings fork) const;
};

/// Returns the change that gives any fork the springs, dampers and DOFs of `fork`; shape and length are not changed.
ForkChange change_to(const ForkSettings& fork);

/// The springs, the damping values in force and the DOFs that are on: "stiffness 2000 N/m, 500 N/m, 5 N m/rad; …".
std::string in_words(const ForkSettings& fork);

/// Coefficient [N·s/m] of the damper in parallel with the fork's stretch spring, for a body of `mass` [kg] that is held
/// by this fork alone.
double stretch_damping(const ForkSettings& fork, double mass);

}  // namespace spring_workbench::rod
