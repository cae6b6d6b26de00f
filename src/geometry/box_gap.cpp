#include "spring_workbench/geometry/box_gap.h"

#include <limits>

#include "spring_workbench/geometry/shape_queries.h"

namespace spring_workbench::geometry {

std::vector<OutlineBox> outline(const std::vector<Shape>& shapes) {
  std::vector<OutlineBox> boxes;
  for (const Shape& shape : shapes) {
    const Eigen::AlignedBox3d around = bounding_box(shape.geometry);
    boxes.push_back({shape.X_OS * Eigen::Translation3d(around.center()), 0.5 * around.sizes(),
                     std::holds_alternative<Box>(shape.geometry)});
  }
  return boxes;
}

BoxGap gap_between(const OutlineBox& a, const OutlineBox& b) {
  const Matrix3d& A = a.X.linear();
  const Matrix3d& B = b.X.linear();
  const Vector3d between = a.X.translation() - b.X.translation();
  BoxGap best{-std::numeric_limits<double>::infinity(), Vector3d::UnitZ()};
  const auto look = [&](const Vector3d& axis) {
    const double size = axis.norm();
    if (size < 1e-6) return;  // parallel edges: the faces' axes cover it
    const double apart = between.dot(axis);
    const double gap = (std::abs(apart) - (reach(a, axis) + reach(b, axis))) / size;
    if (gap > best.gap) best = {gap, axis / (apart < 0.0 ? -size : size)};
  };
  for (int i = 0; i < 3; ++i) {
    look(A.col(i));
    look(B.col(i));
    for (int k = 0; k < 3; ++k) look(A.col(i).cross(B.col(k)));
  }
  return best;
}

BoxGap gap_above(const OutlineBox& box, double height) {
  const double reach = box.X.linear().row(2).cwiseAbs().dot(box.half);
  return {box.X.translation().z() - reach - height, Vector3d::UnitZ()};
}

}  // namespace spring_workbench::geometry
