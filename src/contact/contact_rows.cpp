#include "contact_rows.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "spring_workbench/friction/surfaces.h"
#include "spring_workbench/math/so3.h"

namespace spring_workbench::contact {

Vector3d moved(const RigidTransform& X0, const RigidTransform& X1, const Vector3d& p_W) {
  return X1 * (X0.inverse() * p_W);
}

double extent(const RigidTransform& X0, const RigidTransform& X1, double radius) {
  return (X1.translation() - X0.translation()).norm() + radius * math::turn_between(X0, X1).norm();
}

double motion_by(const Wrench& load, const Matrix6d& response, double radius) {
  const Vector6d motion = response * to_vector(load);
  return motion.head<3>().norm() + radius * motion.tail<3>().norm();
}

bool leave_room(const std::vector<ContactRow>& rows) {
  return std::all_of(rows.begin(), rows.end(), [&](const ContactRow& a) {
    return std::all_of(rows.begin(), rows.end(),
                       [&](const ContactRow& b) { return a.point.n_W.dot(b.point.n_W) >= 0.0; });
  });
}

bool is_round(const scene::Scene& scene, std::size_t body) {
  if (body == collision::CollisionWorld::bench) return false;
  const std::vector<geometry::Shape>& shapes = scene.bodies[body].collision;
  return std::any_of(shapes.begin(), shapes.end(), [](const geometry::Shape& shape) {
    return std::holds_alternative<geometry::Sphere>(shape.geometry) ||
           std::holds_alternative<geometry::Cylinder>(shape.geometry);
  });
}

bool is_same(const collision::ContactPoint& a, const collision::ContactPoint& b, double within) {
  return a.other == b.other && a.n_W.dot(b.n_W) > one_normal && (a.p_W - b.p_W).norm() < within;
}

bool is_of_indented(const ContactRow& row, const std::vector<ContactRow>& rows) {
  return row.compliance > 0.0 &&
         std::any_of(rows.begin(), rows.end(), [&](const ContactRow& r) { return r.point.other == row.point.other; });
}

void keep_met(const std::vector<ContactRow>& met, std::vector<ContactRow>& seen) {
  std::copy_if(met.begin(), met.end(), std::back_inserter(seen), [&](const ContactRow& one) {
    return std::none_of(seen.begin(), seen.end(), [&](const ContactRow& row) {
      return row.point.other == one.point.other && row.point.n_W.dot(one.point.n_W) >= one_side;
    });
  });
}

Matrix3d axes_of(const ContactRow& row) {
  const Vector3d& n = row.point.n_W;
  const Vector3d across = n.unitOrthogonal();
  return (Matrix3d() << n, across, n.cross(across)).finished();
}

Eigen::Matrix<double, 3, 6> jacobian(const Matrix3d& axes, const ContactRow& row) {
  return (Eigen::Matrix<double, 3, 6>() << axes.transpose(), -axes.transpose() * math::skew(row.lever_W)).finished();
}

std::vector<std::size_t> surfaces_of(const std::vector<ContactRow>& rows) {
  std::vector<std::size_t> surfaces;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::size_t first = 0;
    while (first < i && (surfaces[first] != first || rows[first].point.other != rows[i].point.other ||
                         !friction::Surfaces::is_one(rows[first].point.n_W, rows[i].point.n_W))) {
      ++first;
    }
    surfaces.push_back(first);
  }
  return surfaces;
}

std::vector<double> indentations(const std::vector<ContactRow>& rows) {
  const std::vector<std::size_t> surfaces = surfaces_of(rows);
  std::vector<Vector3d> loads(rows.size(), Vector3d::Zero());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Vector3d& n = rows[i].point.n_W;
    loads[surfaces[i]] += rows[i].load_W.dot(n) * n;
  }
  std::vector<double> depths;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    depths.push_back(rows[i].compliance * loads[surfaces[i]].dot(rows[i].point.n_W));
  }
  return depths;
}

void set_impulse_compliance(std::vector<ContactRow>& rows, const std::vector<bool>& hits, double h,
                            std::vector<double>& restitution) {
  std::set<std::size_t> loaded, hit;  // others
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].load_W != Vector3d::Zero() || has_impulse(rows[i])) loaded.insert(rows[i].point.other);
    if (hits[i]) hit.insert(rows[i].point.other);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t other = rows[i].point.other;
    if (loaded.count(other) == 0 && hit.count(other) > 0) rows[i].compliance = 0.0;
    if (rows[i].compliance > 0.0) restitution[i] = 0.0;
    rows[i].compliance /= h * h;
  }
}

collision::Tolerance admissible_depths(const std::vector<ContactRow>& at_start, const std::vector<ContactRow>& at_end,
                                       double chord_deviation) {
  collision::Tolerance tolerance = closed;
  std::map<std::size_t, double> deepest;
  for (const auto* rows : {&at_start, &at_end}) {
    for (const ContactRow& row : *rows) {
      if (row.compliance > 0.0) deepest[row.point.other] = std::max(deepest[row.point.other], -row.gap);
    }
  }
  for (const auto& [other, depth] : deepest) tolerance.set(other, closed + depth + chord_deviation);
  return tolerance;
}

}  // namespace spring_workbench::contact
