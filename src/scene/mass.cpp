#include "mass.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <sstream>

#include "constants.h"
#include "mesh_file.h"
#include "spring_workbench/geometry/shape_queries.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::scene {
namespace {

/// Inertia about the origin of a point mass `mass` at `p`.
Matrix3d point_inertia(double mass, const Vector3d& p) {
  return mass * (p.squaredNorm() * Matrix3d::Identity() - p * p.transpose());
}

RigidMass shape_mass(const geometry::Shape& shape, double density, const std::string& where,
                     std::vector<std::string>& warnings) {
  geometry::VolumeProperties volume = geometry::volume_properties(shape.geometry);
  const geometry::MeshPtr* mesh = std::get_if<geometry::MeshPtr>(&shape.geometry);
  if (mesh != nullptr && !is_closed(**mesh)) {
    const Eigen::AlignedBox3d box = geometry::bounding_box(shape.geometry);
    volume = geometry::volume_properties(geometry::Box{box.sizes()});
    volume.centre = box.center();
    warnings.push_back(where + ": mesh " + (*mesh)->uri + " is not closed: the volume of its bounding box is used");
  }
  return transformed(shape.X_OS, {density * volume.volume, volume.centre, density * volume.inertia_per_density});
}

/// Largest distance of a point of the shapes from `centre`.
double farthest_point(const std::vector<geometry::Shape>& shapes, const Vector3d& centre) {
  std::vector<geometry::Shape> about_centre = shapes;
  for (geometry::Shape& shape : about_centre) shape.X_OS.pretranslate(-centre);
  return geometry::bounding_radius(about_centre);
}

std::string number(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

}  // namespace

RigidMass transformed(const RigidTransform& X_AB, const RigidMass& mass_B) {
  const Matrix3d R = X_AB.linear();
  return {mass_B.mass, X_AB * mass_B.centre, R * mass_B.inertia * R.transpose()};
}

RigidMass sum(const RigidMass& a, const RigidMass& b) {
  const double mass = a.mass + b.mass;
  if (!(mass > 0.0)) return {};
  const Vector3d centre = (a.mass * a.centre + b.mass * b.centre) / mass;
  return {mass, centre,
          a.inertia + b.inertia + point_inertia(a.mass, a.centre - centre) + point_inertia(b.mass, b.centre - centre)};
}

RigidMass solid_mass(const std::vector<geometry::Shape>& shapes, double density, const std::string& where,
                     std::vector<std::string>& warnings) {
  RigidMass total;
  for (const geometry::Shape& shape : shapes) total = sum(total, shape_mass(shape, density, where, warnings));
  return total;
}

std::string inertia_defect(const RigidMass& mass, const std::vector<geometry::Shape>& shapes) {
  const Vector3d moments = Eigen::SelfAdjointEigenSolver<Matrix3d>(mass.inertia, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(moments[0] > 1e-9 * moments[2])) return "is not positive definite";
  if (moments[0] + moments[1] < (1.0 - inertia_rounding) * moments[2]) return "violates the triangle inequality";
  const double largest_gyration = std::sqrt(moments[2] / mass.mass);
  const double size = farthest_point(shapes, mass.centre);
  if (!shapes.empty() && largest_gyration > (1.0 + inertia_rounding) * size) {
    return "is implausible (its radius of gyration is " + number(largest_gyration) + " m, but the shape reaches only " +
           number(size) + " m from the centre of mass)";
  }
  return "";
}

RigidMass repaired_mass(const RigidMass& given, const std::vector<geometry::Shape>& shapes, double density,
                        const std::string& where, std::vector<std::string>& warnings) {
  if (!(given.mass > 0.0)) {
    const RigidMass solid = solid_mass(shapes, density, where, warnings);
    if (!(solid.mass > 0.0))
      validation::refuse(where, "mass",
                         "a number > 0 kg, since the movable body has no solid shape to compute it from");
    return solid;
  }
  const std::string defect = inertia_defect(given, shapes);
  if (defect.empty()) return given;
  const RigidMass solid = solid_mass(shapes, density, where, warnings);
  if (!(solid.mass > 0.0))
    validation::refuse_because(
        where, "inertia",
        defect + ", and the body has no shape from which to compute another: correct it or add a shape");
  warnings.push_back(where + ": inertia " + defect + "; the inertia of its shape is used instead");
  return {given.mass, given.centre, solid.inertia * (given.mass / solid.mass)};
}

}  // namespace spring_workbench::scene
