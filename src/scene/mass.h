#pragma once

#include <string>
#include <vector>

#include "spring_workbench/scene/scene.h"

namespace spring_workbench::scene {

/// Mass [kg], centre of mass [m] and inertia about it [kg·m²] of something rigid, in the axes of one frame.
struct RigidMass {
  double mass = 0.0;
  Vector3d centre = Vector3d::Zero();
  Matrix3d inertia = Matrix3d::Zero();
};

/// The same mass seen from the frame A that `X_AB` places its frame B in.
RigidMass transformed(const RigidTransform& X_AB, const RigidMass& mass_B);

/// Both as one rigid thing, by the parallel axis theorem.
RigidMass sum(const RigidMass& a, const RigidMass& b);

/// Mass of shapes of uniform density [kg/m³]; where shapes overlap they count twice. A mesh that is not closed has no
/// volume: its bounding box counts, with a warning. Zero without shapes.
RigidMass solid_mass(const std::vector<geometry::Shape>& shapes, double density, const std::string& where,
                     std::vector<std::string>& warnings);

/// Why an inertia cannot be that of a thing with these shapes, or an empty string: it must be positive definite, its
/// principal moments must obey the triangle inequality, and the radius of gyration must not reach beyond the shapes.
std::string inertia_defect(const RigidMass& mass, const std::vector<geometry::Shape>& shapes);

/// The mass of a movable body: as the URDF has it where that is possible, otherwise mended from the shapes, with a
/// warning. Throws InputError naming `where` when it cannot be mended.
RigidMass repaired_mass(const RigidMass& given, const std::vector<geometry::Shape>& shapes, double density,
                        const std::string& where, std::vector<std::string>& warnings);

}  // namespace spring_workbench::scene
