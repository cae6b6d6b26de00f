#pragma once

#include <array>
#include <vector>

#include "spring_workbench/math/pack.h"

namespace spring_workbench::benchmark {

/// What a run gives at one moment, with two derivatives.
struct Moment {
  double t = 0.0;  ///< [s]
  Vector3d value = Vector3d::Zero(), rate = Vector3d::Zero(), acceleration = Vector3d::Zero();
};

/// The outputs of a run between the ends of its steps: of each step by the polynomial of degree eleven through value and two
/// derivatives at four ends, its own and those of the steps before and after (Hermite, in Newton's form). So outputs are
/// behind the steps by one.
class DenseOutput {
 public:
  DenseOutput();

  /// The next end of a step, later than the last one.
  void push(const Moment& end);
  /// Appends to `outputs` those at the next of `times` [s, ascending] that are known: from four ends on up to the last one
  /// but one.
  void append(const std::vector<double>& times, std::vector<Vector3d>& outputs) const;

 private:
  static constexpr std::size_t ends = 4, terms = 3 * ends;

  Three<Pack> at(const Pack& t) const;

  std::size_t count_ = 0;        ///< ends that were pushed
  std::array<double, terms> t_;  ///< the ends, each three times, the last one first
  /// f[t₀], f[t₀, t₁], …: of equal times they are derivatives.
  std::array<Pack, terms> divided_differences_{};
};

}  // namespace spring_workbench::benchmark
