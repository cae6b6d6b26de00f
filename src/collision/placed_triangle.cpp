#include "placed_triangle.h"

#include <limits>

namespace spring_workbench::collision {

Triangle place(const PlacedSurface& placed, int index) {
  Triangle t;
  t.n = placed.X_WS.linear() * placed.surface.normal(index);
  for (int k = 0; k < 3; ++k) {
    const std::size_t at = static_cast<std::size_t>(k);
    t.corners[at] = placed.X_WS * placed.surface.corner(index, k);
    const int neighbour = placed.surface.neighbours[static_cast<std::size_t>(index)][at];
    t.neighbour_normals[at] = neighbour < 0 ? t.n : Vector3d(placed.X_WS.linear() * placed.surface.normal(neighbour));
  }
  return t;
}

Polygon::Polygon(const std::array<Vector3d, 3>& triangle) : size_(3) {
  std::copy(triangle.begin(), triangle.end(), points_.begin());
}

void Polygon::cut(const Vector3d& n, const Vector3d& p) {
  std::array<Vector3d, 8> kept;
  std::size_t count = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    const Vector3d& a = points_[i];
    const Vector3d& b = points_[(i + 1) % size_];
    const double da = n.dot(a - p), db = n.dot(b - p);
    if (da <= 0.0 && count < kept.size()) kept[count++] = a;
    if (((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) && count < kept.size()) {
      kept[count++] = a + da / (da - db) * (b - a);
    }
  }
  points_ = kept;
  size_ = count;
}

Polygon part_behind(const Triangle& cut, const Triangle& face) {
  Polygon polygon(cut.corners);
  polygon.cut(face.n, face.corners[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& a = face.corners[k];
    polygon.cut((face.corners[(k + 1) % 3] - a).cross(face.n), a);
  }
  return polygon;
}

namespace {

/// Shrinks the range of `along` over which start + s·direction is in the triangle; the line lies in its plane.
void clip_to_triangle(const Triangle& t, const Vector3d& start, const Vector3d& direction, double& low, double& high) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d outward = (t.corners[(k + 1) % 3] - t.corners[k]).cross(t.n);
    const double distance = outward.dot(start - t.corners[k]);
    const double slope = outward.dot(direction);
    if (slope > 0.0) {
      high = std::min(high, -distance / slope);
    } else if (slope < 0.0) {
      low = std::max(low, -distance / slope);
    }
  }
}

}  // namespace

Crossing crossing(const Triangle& own, const Triangle& other) {
  const Vector3d direction = other.n.cross(own.n);
  const double sine_squared = direction.squaredNorm();
  if (sine_squared < 1e-20) return {};  // parallel
  // The point of both planes that is nearest to a corner of `own`, seen from there.
  const double height = other.n.dot(other.corners[0] - own.corners[0]);
  const Vector3d start = own.corners[0] + height / sine_squared * (other.n - own.n.dot(other.n) * own.n);
  double low = -std::numeric_limits<double>::max(), high = std::numeric_limits<double>::max();
  clip_to_triangle(own, start, direction, low, high);
  clip_to_triangle(other, start, direction, low, high);
  if (!(low < high)) return {};
  return {start + low * direction, start + high * direction};
}

}  // namespace spring_workbench::collision
