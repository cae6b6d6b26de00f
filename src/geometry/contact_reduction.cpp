#include "spring_workbench/geometry/contact_reduction.h"

#include <algorithm>

namespace spring_workbench::geometry {

std::vector<BoxContact> spanning(const std::vector<BoxContact>& all, double same_point) {
  const auto best_by = [&](const auto& score) {
    return *std::max_element(all.begin(), all.end(), [&](const auto& a, const auto& b) { return score(a) < score(b); });
  };
  if (all.empty()) return {};
  const BoxContact deepest = best_by([](const auto& c) { return -c.gap; });
  const auto from_deepest = [&](const BoxContact& c) { return Vector3d(c.p_W - deepest.p_W); };
  const BoxContact across = best_by([&](const auto& c) { return from_deepest(c).norm(); });
  const Vector3d aside_W = deepest.n_W.cross(from_deepest(across));
  std::vector<BoxContact> kept{deepest};
  if (from_deepest(across).norm() < same_point) return kept;
  kept.push_back(across);
  for (const double side : {1.0, -1.0}) {
    const auto aside = [&](const auto& c) { return side * aside_W.dot(from_deepest(c)) / aside_W.norm(); };
    const BoxContact widest = best_by(aside);
    if (aside(widest) > same_point) kept.push_back(widest);
  }
  return kept;
}

std::vector<std::vector<BoxContact>> by_normal(std::vector<BoxContact> contacts, double one_normal, double same_point) {
  std::stable_sort(contacts.begin(), contacts.end(), [](const auto& a, const auto& b) { return a.gap < b.gap; });
  std::vector<std::vector<BoxContact>> groups;
  for (const BoxContact& c : contacts) {
    const auto same = std::find_if(groups.begin(), groups.end(),
                                   [&](const auto& group) { return group.front().n_W.dot(c.n_W) > one_normal; });
    if (same != groups.end()) {
      same->push_back(c);
    } else {
      groups.push_back({c});
    }
  }
  for (std::vector<BoxContact>& group : groups) group = spanning(group, same_point);
  return groups;
}

}  // namespace spring_workbench::geometry
