#pragma once

#include <array>

#include "spring_workbench/math/spatial.h"
#include "spring_workbench/rod/shape_model.h"

namespace spring_workbench::rod {

/// Strain of a fork in equilibrium under a load, and its derivative with respect to the generalised force.
struct EquilibriumStrain {
  StrainVector q;
  StrainMatrix compliance;  ///< symmetric, ≥ 0; zero for coordinates without stiffness
  StrainVector
      imbalance;  ///< residual: elastic force minus that of the load; zero for coordinates at the end of their range
};

/// Static equilibrium of the fork under a load at the object's centre of mass whose direction is fixed in the handle
/// frame H (paper, sections 3.3 and 4). Coordinates without stiffness have no equilibrium and stay at zero.
class StaticDeformation {
 public:
  using Active = std::array<bool, max_strain_coordinates>;
  /// Keeps a reference to `shape`. `stiffness`: diagonal of K; coordinates that are not `active` stay constant. `p_EO`:
  /// the object's centre of mass in the tip frame [m]; `load_H`: load there, in H axes [N, N·m].
  StaticDeformation(const ShapeModel& shape, const StrainVector& stiffness, const Active& active, const Vector3d& p_EO,
                    const Wrench& load_H)
      : shape_(shape), K_(stiffness), active_(active), p_EO_(p_EO), load_H_(load_H) {}

  /// Solves in the paper's order (section 5): first bend and stretch with the twist of `from`, then the twist with the
  /// bend and stretch found.
  /// Repeated calls under a constant load therefore converge to the equilibrium of all coordinates. Newton's method
  /// with a line search, starting at `from`; stops at the end of the rod's range.
  EquilibriumStrain under_load(const StrainVector& from) const;

  /// Generalised force of the load, or of another load [force; moment] at the same point.
  StrainVector force(const StrainVector& q) const { return force(q, to_vector(load_H_)); }
  StrainVector force(const StrainVector& q, const Vector6d& load_H) const;

 private:
  /// Active coordinates that are solved for together.
  struct Block {
    int count = 0;
    int index[max_strain_coordinates] = {};
  };
  struct Slope;
  Block block(bool torsion) const;
  TipKinematics tip_at(const StrainVector& q) const;  ///< at rest
  StrainVector force(const TipKinematics& tip, const Vector6d& load_H) const;
  /// Generalised force of the load at several strains, of all coordinates.
  using Forces = std::array<math::Pack, max_strain_coordinates>;
  Forces forces(const math::Pack* q) const;
  /// Elastic force minus that of the load, with the tip at the strain `q`.
  StrainVector imbalance(const StrainVector& q, const TipKinematics& tip) const;
  /// Derivative of the imbalance with respect to the block's coordinates, and the tip's displacement per unit of each,
  /// as a fraction of the fork's length or in radians.
  Slope slope(const StrainVector& q, const TipKinematics& tip, const Block& block) const;
  /// Equilibrium of the block's coordinates; returns those that are not at the end of the rod's range.
  Block find(Block block, StrainVector& q) const;
  /// Moves the coordinates that `change` would take out of the range to its end, and removes them from the block.
  bool stop(const StrainVector& change, Block& block, StrainVector& q) const;

  const ShapeModel& shape_;
  StrainVector K_;
  Active active_;
  Vector3d p_EO_;
  Wrench load_H_;
};

}  // namespace spring_workbench::rod
