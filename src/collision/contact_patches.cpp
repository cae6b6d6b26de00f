#include "contact_patches.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "triangle_contacts.h"

namespace spring_workbench::collision {
namespace {

/// Which patch each pair belongs to: pairs whose triangles are neighbours on one side and equal on the other go
/// together.
class Patches {
 public:
  Patches(const geometry::Surface& own, const geometry::Surface& other,
          const std::vector<std::pair<int, int>>& sorted_pairs)
      : pairs_(sorted_pairs), parent_(sorted_pairs.size()) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const auto [a, b] = pairs_[i];
      for (const int next : own.neighbours[static_cast<std::size_t>(a)]) join(i, {next, b});
      for (const int next : other.neighbours[static_cast<std::size_t>(b)]) join(i, {a, next});
    }
  }

  std::size_t patch_of(std::size_t pair) {
    while (parent_[pair] != pair) pair = parent_[pair] = parent_[parent_[pair]];
    return pair;
  }

 private:
  void join(std::size_t i, const std::pair<int, int>& neighbour) {
    const auto found = std::lower_bound(pairs_.begin(), pairs_.end(), neighbour);
    if (found == pairs_.end() || *found != neighbour) return;
    parent_[patch_of(static_cast<std::size_t>(found - pairs_.begin()))] = patch_of(i);
  }

  const std::vector<std::pair<int, int>>& pairs_;
  std::vector<std::size_t> parent_;
};

struct Pair {
  Triangle own, other;
  Crossing crossing;
  std::size_t patch;
};

/// The curve's area vector, and the reference point that it is summed about.
struct Patch {
  std::optional<Vector3d> reference;
  Vector3d area = Vector3d::Zero();
  bool met = false;  // some pair is in contact along the area vector
};

}  // namespace

void append_surface_contacts(const PlacedSurface& own, const PlacedSurface& other,
                             const std::vector<std::pair<int, int>>& pairs, double tolerance,
                             std::vector<ContactPoint>& contacts) {
  std::vector<std::pair<int, int>> sorted = pairs;
  std::sort(sorted.begin(), sorted.end());
  Patches grouping(own.surface, other.surface, sorted);
  std::vector<Pair> placed;
  std::vector<Patch> patches(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    placed.push_back({place(own, sorted[i].first), place(other, sorted[i].second), {}, grouping.patch_of(i)});
    Pair& pair = placed.back();
    pair.crossing = crossing(pair.own, pair.other);
    Patch& patch = patches[pair.patch];
    if (!patch.reference) patch.reference = pair.crossing.begin;
    patch.area += 0.5 * (pair.crossing.begin - *patch.reference).cross(pair.crossing.end - pair.crossing.begin);
  }
  for (const Pair& pair : placed) {
    Patch& patch = patches[pair.patch];
    patch.met |= append_triangle_contacts(pair.own, pair.other, patch.area.normalized(), tolerance, contacts);
  }
  for (const Pair& pair : placed) {  // a patch that pushes nowhere on the whole, such as a wedge: each pair by itself
    if (patches[pair.patch].met) continue;
    append_triangle_contacts(pair.own, pair.other, std::nullopt, tolerance, contacts);
  }
}

}  // namespace spring_workbench::collision
