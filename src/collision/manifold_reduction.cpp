#include "manifold_reduction.h"

#include <algorithm>
#include <cmath>

#include "constants.h"
#include "spring_workbench/scene/constants.h"

namespace spring_workbench::collision {
namespace {

/// Keeps a point of each group that lies furthest in a direction.
void keep_extremes(const std::vector<ContactPoint>& group, std::vector<ContactPoint>& kept) {
  const Vector3d n = group.front().n_W;
  const Vector3d u = n.unitOrthogonal(), v = n.cross(u);
  const std::size_t first = kept.size();
  const auto keep = [&](const ContactPoint& contact) {
    const bool known = std::any_of(kept.begin() + static_cast<std::ptrdiff_t>(first), kept.end(),
                                   [&](const auto& k) { return (k.p_W - contact.p_W).norm() < same_place; });
    if (!known) kept.push_back(contact);
  };
  keep(*std::max_element(group.begin(), group.end(), [](const auto& a, const auto& b) { return a.depth < b.depth; }));
  for (int i = 0; i < 8; ++i) {
    const double angle = 2.0 * M_PI * (i + 0.31) / 8.0;  // off the axes, along which points often tie
    const Vector3d direction = std::cos(angle) * u + std::sin(angle) * v;
    keep(*std::max_element(group.begin(), group.end(),
                           [&](const auto& a, const auto& b) { return direction.dot(a.p_W) < direction.dot(b.p_W); }));
  }
}

}  // namespace

void reduce_manifold(std::size_t first, std::vector<ContactPoint>& contacts) {
  std::vector<std::vector<ContactPoint>> groups;
  for (std::size_t i = first; i < contacts.size(); ++i) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& g) {
      return g.front().n_W.dot(contacts[i].n_W) > scene::same_face;
    });
    if (group != groups.end()) {
      group->push_back(contacts[i]);
    } else {
      groups.push_back({contacts[i]});
    }
  }
  contacts.resize(first);
  for (const std::vector<ContactPoint>& group : groups) keep_extremes(group, contacts);
}

}  // namespace spring_workbench::collision
