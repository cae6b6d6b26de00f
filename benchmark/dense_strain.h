#pragma once

#include <array>

#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::benchmark {

/// The strain of a run between the ends of its steps: of each step by the polynomial of degree eleven through strain
/// and strain rate at six ends, its own two and those of the two steps before and after (Hermite, in Newton's form). So
/// it is known up to the last end but two.
class DenseStrain {
 public:
  DenseStrain();

  /// The next end of a step, later than the last one; always with as many coordinates.
  void push(double t, const dynamics::StrainState& state);
  /// Up to when at() holds [s]: from the first end on; minus infinity before there are six of them.
  double known_until() const;
  /// The strain at four times: a pack for each coordinate.
  void at(const math::Pack& t, math::Pack* q) const;

 private:
  static constexpr std::size_t ends = 6, terms = 2 * ends;
  static constexpr std::size_t packs = (rod::max_strain_coordinates + math::pack_size - 1) / math::pack_size;
  using Coordinates = std::array<math::Pack, packs>;

  std::size_t size_ = 0, count_ = 0;  ///< coordinates; ends that were pushed
  std::array<double, terms> t_;       ///< the ends, each twice, the last one first
  /// f[t₀], f[t₀, t₁], …: of equal times they are derivatives.
  std::array<Coordinates, terms> divided_differences_{};
};

}  // namespace spring_workbench::benchmark
