#include "bench_contacts.h"

#include "spring_workbench/geometry/shape_queries.h"

namespace spring_workbench::collision {
namespace {

/// Collects the points below the plane.
class Below {
 public:
  Below(double height, double tolerance, std::vector<ContactPoint>& contacts)
      : height_(height), tolerance_(tolerance), contacts_(contacts) {}

  void add(const Vector3d& p_W) {
    const double depth = height_ - p_W.z();
    if (!(depth > tolerance_)) return;
    contacts_.push_back({CollisionWorld::bench, Vector3d(p_W.x(), p_W.y(), height_), Vector3d::UnitZ(), depth});
  }

 private:
  double height_, tolerance_;
  std::vector<ContactPoint>& contacts_;
};

/// Of each rim the lowest point, the highest and the two between: the lowest is exact, and a rim that lies flat has
/// four.
void add_rims(const geometry::Cylinder& cylinder, const RigidTransform& X_WS, Below& below) {
  const Vector3d axis = X_WS.linear().col(2);
  Vector3d down = axis.z() * axis - Vector3d::UnitZ();
  if (down.norm() < 1e-9) down = X_WS.linear().col(0);
  down.normalize();
  const Vector3d across = axis.cross(down);
  for (const double end : {-0.5, 0.5}) {
    const Vector3d centre = X_WS.translation() + end * cylinder.length * axis;
    for (const Vector3d& direction : {down, across, Vector3d(-across), Vector3d(-down)}) {
      below.add(centre + cylinder.radius * direction);
    }
  }
}

}  // namespace

void append_bench_contacts(const geometry::Geometry& geometry, const RigidTransform& X_WS, double height,
                           double tolerance, std::vector<ContactPoint>& contacts) {
  Below below(height, tolerance, contacts);
  if (const auto* box = std::get_if<geometry::Box>(&geometry)) {
    for (const Vector3d& corner : geometry::corners(0.5 * box->size)) below.add(X_WS * corner);
  } else if (const auto* sphere = std::get_if<geometry::Sphere>(&geometry)) {
    below.add(X_WS.translation() - Vector3d(0.0, 0.0, sphere->radius));
  } else if (const auto* cylinder = std::get_if<geometry::Cylinder>(&geometry)) {
    add_rims(*cylinder, X_WS, below);
  } else {
    for (const Vector3d& vertex : std::get<geometry::MeshPtr>(geometry)->vertices) below.add(X_WS * vertex);
  }
}

}  // namespace spring_workbench::collision
