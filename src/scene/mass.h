#pragma once

#include <string>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::scene {

/// Mass [kg], centre of mass [m] and inertia about it [kg·m²] of a rigid body, in one frame.
struct RigidMass {
  double mass = 0.0;
  Vector3d centre = Vector3d::Zero();
  Matrix3d inertia = Matrix3d::Zero();
};

/// Transforms a mass from its frame B to the frame A; `X_AB`: pose of B in A.
RigidMass transformed(const RigidTransform& X_AB, const RigidMass& mass_B);

/// Both masses as one rigid body (parallel axis theorem).
RigidMass sum(const RigidMass& a, const RigidMass& b);

/// Mass of shapes of uniform density [kg/m³]; overlaps count twice. A mesh that is not closed is replaced by its
/// bounding box, with a warning. Zero if there are no shapes.
RigidMass solid_mass(const std::vector<geometry::Shape>& shapes, double density, const std::string& where,
                     std::vector<std::string>& warnings);

/// Why an inertia is impossible for a body with these shapes, or an empty string: it must be positive definite, its
/// principal moments must satisfy the triangle inequality, and no radius of gyration may exceed the shapes.
std::string inertia_defect(const RigidMass& mass, const std::vector<geometry::Shape>& shapes);

/// The mass of a movable body: as in the URDF if that is possible, otherwise repaired from the shapes, with a warning.
/// Throws InputError naming `where` if it cannot be repaired.
RigidMass repaired_mass(const RigidMass& given, const std::vector<geometry::Shape>& shapes, double density,
                        const std::string& where, std::vector<std::string>& warnings);

}  // namespace spring_workbench::scene
