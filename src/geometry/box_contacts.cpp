#include "spring_workbench/geometry/box_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "constants.h"

namespace spring_workbench::geometry {
namespace {

struct Axis {
  double gap = -std::numeric_limits<double>::infinity();
  Vector3d n_W = Vector3d::UnitZ();  ///< from `b` towards `a`
  int of_a = -1, of_b = -1;          ///< the axes of the boxes that define it
};

void look(const OutlineBox& a, const OutlineBox& b, const Vector3d& axis, int of_a, int of_b, Axis& best) {
  const double size = axis.norm();
  if (size < 1e-6) return;
  const double apart = axis.dot(a.X.translation() - b.X.translation());
  const double gap = (std::abs(apart) - reach(a, axis) - reach(b, axis)) / size;
  if (gap > best.gap) best = {gap, axis / (apart < 0.0 ? -size : size), of_a, of_b};
}

/// Clips the polygon to the half-space `n · x ≤ limit`.
void clip(std::vector<Vector3d>& polygon, const Vector3d& n_W, double limit) {
  std::vector<Vector3d> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d& p = polygon[i];
    const Vector3d& q = polygon[(i + 1) % polygon.size()];
    const double over_p = n_W.dot(p) - limit, over_q = n_W.dot(q) - limit;
    if (over_p <= 0.0) kept.push_back(p);
    if ((over_p < 0.0 && over_q > 0.0) || (over_p > 0.0 && over_q < 0.0)) {
      kept.push_back(p + over_p / (over_p - over_q) * (q - p));
    }
  }
  polygon = std::move(kept);
}

/// Corners, in order, of the box face whose normal is closest to `n`.
std::vector<Vector3d> face_towards(const OutlineBox& box, const Vector3d& n_W) {
  const Vector3d n = box.X.linear().transpose() * n_W;
  Eigen::Index i;
  n.cwiseAbs().maxCoeff(&i);
  const Eigen::Index u = (i + 1) % 3, v = (i + 2) % 3;
  std::vector<Vector3d> corners;
  for (const auto& [su, sv] : {std::pair(1, 1), std::pair(-1, 1), std::pair(-1, -1), std::pair(1, -1)}) {
    Vector3d p;
    p[i] = n[i] < 0.0 ? -box.half[i] : box.half[i];
    p[u] = su * box.half[u];
    p[v] = sv * box.half[v];
    corners.push_back(box.X * p);
  }
  return corners;
}

/// Reduces the contacts to four that span nearly the same area; includes the deepest one if it is significantly deeper.
std::vector<BoxContact> reduced(const std::vector<BoxContact>& all, const Vector3d& u_W, const Vector3d& v_W) {
  std::vector<std::size_t> kept;
  for (const Vector3d& outwards :
       {Vector3d(u_W + v_W), Vector3d(v_W - u_W), Vector3d(-u_W - v_W), Vector3d(u_W - v_W)}) {
    const auto furthest = std::max_element(all.begin(), all.end(), [&](const BoxContact& x, const BoxContact& y) {
      return outwards.dot(x.p_W) < outwards.dot(y.p_W);
    });
    const auto i = static_cast<std::size_t>(furthest - all.begin());
    if (std::find(kept.begin(), kept.end(), i) == kept.end()) kept.push_back(i);
  }
  const auto higher = [&](std::size_t i, std::size_t k) { return all[i].gap > all[k].gap; };
  const auto deepest = static_cast<std::size_t>(
      std::min_element(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.gap < y.gap; }) -
      all.begin());
  std::sort(kept.begin(), kept.end(), higher);
  if (all[deepest].gap < all[kept.back()].gap - depth_advantage) kept.front() = deepest;
  std::vector<BoxContact> four;
  for (const std::size_t i : kept) four.push_back(all[i]);
  return four;
}

std::vector<BoxContact> of_faces(const OutlineBox& a, const OutlineBox& b, const Axis& axis, double margin) {
  const bool face_of_b = axis.of_b >= 0;
  const OutlineBox& face = face_of_b ? b : a;
  const Vector3d out = face_of_b ? axis.n_W : Vector3d(-axis.n_W);  // outward normal of the face
  const int normal = face_of_b ? axis.of_b : axis.of_a;
  std::vector<Vector3d> polygon = face_towards(face_of_b ? a : b, -out);
  for (int i = 0; i < 3; ++i) {
    if (i == normal) continue;
    const Vector3d side = face.X.linear().col(i);
    const double middle = side.dot(face.X.translation());
    clip(polygon, side, middle + face.half[i]);
    clip(polygon, -side, face.half[i] - middle);
  }
  std::vector<BoxContact> contacts;
  for (const Vector3d& p : polygon) {
    const double gap = out.dot(p - face.X.translation()) - face.half[normal];
    if (gap < margin) contacts.push_back({face_of_b ? Vector3d(p - gap * out) : p, axis.n_W, gap});
  }
  if (contacts.size() > 4) {
    return reduced(contacts, face.X.linear().col((normal + 1) % 3), face.X.linear().col((normal + 2) % 3));
  }
  return contacts;
}

/// Midpoint of the edge parallel to `axis` that is furthest along `n`.
Vector3d edge_towards(const OutlineBox& box, int axis, const Vector3d& n_W) {
  Vector3d p = (box.X.linear().transpose() * n_W).cwiseSign().cwiseProduct(box.half);
  p[axis] = 0.0;
  return box.X * p;
}

BoxContact of_edges(const OutlineBox& a, const OutlineBox& b, const Axis& axis) {
  const Vector3d along_a = a.X.linear().col(axis.of_a), along_b = b.X.linear().col(axis.of_b);
  const Vector3d on_a = edge_towards(a, axis.of_a, -axis.n_W), on_b = edge_towards(b, axis.of_b, axis.n_W);
  const double c = along_a.dot(along_b);
  const Vector3d between = on_a - on_b;
  const double s = (along_b.dot(between) - c * along_a.dot(between)) / (1.0 - c * c);
  const double reach_b = b.half[axis.of_b];
  return {on_b + std::clamp(s, -reach_b, reach_b) * along_b, axis.n_W, axis.gap};
}

/// Returns whether the other box has a face that is nearly parallel to that of the axis.
bool flush(const OutlineBox& a, const OutlineBox& b, const Axis& face) {
  const OutlineBox& other = face.of_b >= 0 ? a : b;
  return (other.X.linear().transpose() * face.n_W).cwiseAbs().maxCoeff() > 1.0 - 0.5 * slope_of_flush * slope_of_flush;
}

}  // namespace

std::vector<BoxContact> box_contacts(const OutlineBox& a, const OutlineBox& b, double margin) {
  Axis faces, edges;
  for (int i = 0; i < 3; ++i) {
    look(a, b, a.X.linear().col(i), i, -1, faces);
    look(a, b, b.X.linear().col(i), -1, i, faces);
  }
  if (faces.gap > margin) return {};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) look(a, b, a.X.linear().col(i).cross(b.X.linear().col(k)), i, k, edges);
  }
  if (edges.gap > margin) return {};
  std::vector<BoxContact> contacts = of_faces(a, b, faces, margin);
  const bool edges_first = edges.gap > faces.gap + edge_margin + edge_margin_fraction * std::abs(faces.gap);
  if (edges_first && (contacts.empty() || !flush(a, b, faces))) return {of_edges(a, b, edges)};
  return contacts;
}

std::vector<BoxContact> box_contacts(const OutlineBox& a, const Vector3d& n_W, double height, double margin) {
  std::vector<BoxContact> contacts;
  for (const Vector3d& p : face_towards(a, -n_W)) {
    const double gap = n_W.dot(p) - height;
    if (gap < margin) contacts.push_back({p - gap * n_W, n_W, gap});
  }
  return contacts;
}

}  // namespace spring_workbench::geometry
