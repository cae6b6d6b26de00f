#pragma once

#include <array>
#include <cmath>

#include "spring_workbench/math/pack.h"

namespace spring_workbench::math {

/// Anderson's acceleration of depth two for a fixed-point iteration x ← g(x) (Walker and Ni, SIAM J. Numer. Anal. 49,
/// 2011): the next x is the combination of the last images g whose combined change g − x is least in a weighted norm,
/// summed over all lanes. `size` packs make a point.
template <std::size_t size>
class AndersonMixer {
 public:
  using Point = std::array<Pack, size>;
  /// Result of an iteration: x = g(x₀), and the change g(x₀) − x₀.
  struct Image {
    Point x, change;
  };

  void restart() { count_ = 0; }
  /// Returns the image of the next iteration, for the caller to fill.
  Image& next() { return images_[++count_ % 3]; }
  /// Returns the image of the last iteration.
  const Image& last() const { return images_[count_ % 3]; }
  /// Computes the point at which the next iteration begins, from the images so far; `squared_weight` of each pack.
  template <typename Weight>
  SPRING_WORKBENCH_INLINE void mix(const Weight& squared_weight, Point& x) const {
    const Image& now = images_[count_ % 3];
    x = now.x;
    if (count_ < 2) return;
    const Image& before = images_[(count_ + 2) % 3];
    const Image* first = count_ > 2 ? &images_[(count_ + 1) % 3] : nullptr;
    Pack dd{}, dn{}, de{}, ee{}, en{};  // of d = change less the last, e = the last less the one before, n = change
    for (std::size_t m = 0; m < size; ++m) {
      const Pack w = squared_weight[static_cast<Eigen::Index>(m)] + Pack{}, n = now.change[m], d = n - before.change[m];
      dd += w * d * d;
      dn += w * d * n;
      if (first == nullptr) continue;
      const Pack e = before.change[m] - first->change[m];
      de += w * d * e;
      ee += w * e * e;
      en += w * e * n;
    }
    const double d2 = sum(dd), e2 = sum(ee), cross = sum(de);
    const double determinant = d2 * e2 - cross * cross;
    double last_share = sum(dn) / d2, first_share = 0.0;
    if (determinant > least_independence * d2 * e2) {
      last_share = (sum(dn) * e2 - sum(en) * cross) / determinant;
      first_share = (sum(en) * d2 - sum(dn) * cross) / determinant;
    }
    if (!(std::abs(last_share) + std::abs(first_share) < most_continued)) return;
    for (std::size_t m = 0; m < size; ++m) x[m] -= last_share * (now.x[m] - before.x[m]);
    if (first_share == 0.0) return;
    for (std::size_t m = 0; m < size; ++m) x[m] -= first_share * (before.x[m] - first->x[m]);
  }

 private:
  /// Smallest ratio of the determinant of the normal equations to its largest possible value; below it, the two
  /// differences are parallel, and only the last one is used.
  static constexpr double least_independence = 1e-3;
  /// Largest sum of the coefficients; beyond it the combination is an extrapolation from noise, and the image is taken.
  static constexpr double most_continued = 3.0;

  Image images_[3]{};
  std::size_t count_ = 0;
};

}  // namespace spring_workbench::math
