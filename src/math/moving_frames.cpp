#include "spring_workbench/math/moving_frames.h"

#include <algorithm>
#include <cmath>

#include "constants.h"

namespace spring_workbench::math {

Matrix3d shortest_rotation(const Vector3d& from, const Vector3d& to) {
  return Quaterniond::FromTwoVectors(from, to).toRotationMatrix();  // includes a decomposition, compiled only here
}

Vector3d aligned_rate(const Matrix3d& R, const Vector3d& w, const Vector3d& n, const Vector3d& n_dot) {
  // The quaternion (q, v) from z to u, which is n in the axes of R: q² = (1 + u_z) / 2, 2 q v = z × u.
  const Vector3d u = R.transpose() * n, u_dot = R.transpose() * (n_dot - w.cross(n)), z = Vector3d::UnitZ();
  const double q = std::sqrt(0.5 * std::max(1.0 + u.z(), 0.0));
  if (q < min_half_angle_cosine) return w;
  const Vector3d v = z.cross(u) / (2.0 * q);
  const double q_dot = u_dot.z() / (4.0 * q);
  const Vector3d v_dot = z.cross(u_dot) / (2.0 * q) - (q_dot / q) * v;
  return w + R * (2.0 * (q * v_dot - q_dot * v + v.cross(v_dot)));
}

}  // namespace spring_workbench::math
