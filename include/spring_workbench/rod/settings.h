#pragma once

#include <string>

namespace spring_workbench::rod {

/// One number per degree of freedom (DOF) of the fork.
struct PerDof {
  double stretch = 0.0;
  double bend = 0.0;
  double torsion = 0.0;
};

inline bool operator==(const PerDof& a, const PerDof& b) {
  return a.stretch == b.stretch && a.bend == b.bend && a.torsion == b.torsion;
}

/// The DOFs that are switched on (the paper's deformation DOFs, section 4). Off means rigid.
struct ForkDofs {
  bool stretch = true;
  bool bend = true;
  bool torsion = true;
  bool operator==(const ForkDofs& o) const { return stretch == o.stretch && bend == o.bend && torsion == o.torsion; }
};

/// The spring-fork's elastic part (doc/model.md, "The spring-fork is a rod").
struct ForkSettings {
  std::string shape = "linear";          ///< key `shape`: the shape model's name
  double length = 0.2;                   ///< key `fork.length` [m], > 0: rest length L
  PerDof stiffness{2000.0, 500.0, 5.0};  ///< keys `fork.stiffness.*` [N/m, N/m, N·m/rad], ≥ 0
  PerDof damping_ratio{1.0, 1.0, 1.0};   ///< keys `fork.damping.*`: ζ, 0 … 10; 1 is critical
  std::string damping_law = "per_dof";   ///< key `fork.damping_law`: per_dof, or modal: the same ζ in every mode
                                         ///< of the held body, for one ζ of all families
  ForkDofs dofs;                         ///< keys `fork.dofs.*`
  double switch_off_time = 0.05;         ///< key `fork.switch_off_time` [s], > 0: time constant on which a family that
                                         ///< is switched off while strained goes back to zero strain
};

}  // namespace spring_workbench::rod
