#pragma once

#include <array>
#include <cmath>

#include "spring_workbench/math/pack.h"

namespace spring_workbench::exponential {

/// Anderson acceleration of depth two for a fixed-point iteration x ← g(x) (Walker and Ni, SIAM J. Numer. Anal. 49,
/// 2011): the next x is the affine combination of the last images g that has the smallest combined change g − x in a
/// weighted norm, over all lanes. A point has `size` packs.
template <std::size_t size>
class AndersonMixer {
 public:
  using Point = std::array<math::Pack, size>;
  /// Result of an iteration: x = g(x₀), and the change g(x₀) − x₀.
  struct Image {
    Point x, change;
  };

  void restart() { count_ = 0; }
  /// Begins the next iteration. Returns its x, which the caller has to set.
  Point& next() { return images_[++count_ % 3].x; }
  /// Computes the change of this iteration, which began at `from`. Returns its squared size, over all lanes; one
  /// `squared_weight` per pack.
  template <typename Weight>
  SPRING_WORKBENCH_INLINE double take_change(const Point& from, const Weight& squared_weight) {
    Image& now = images_[count_ % 3];
    double all = 0.0;
    for (std::size_t m = 0; m < size; ++m) {
      now.change[m] = now.x[m] - from[m];
      all += squared_weight[static_cast<Eigen::Index>(m)] * math::sum(now.change[m] * now.change[m]);
    }
    return all;
  }
  /// Returns the image of this iteration.
  const Image& last() const { return images_[count_ % 3]; }
  /// Computes the point at which the next iteration begins from the images so far.
  template <typename Weight>
  SPRING_WORKBENCH_INLINE void mix(const Weight& squared_weight, Point& x) const {
    const Image& now = images_[count_ % 3];
    x = now.x;
    if (count_ < 2) return;
    const Image& before = images_[(count_ + 2) % 3];
    const Image* first = count_ > 2 ? &images_[(count_ + 1) % 3] : nullptr;
    math::Pack dd{}, dn{}, de{}, ee{}, en{};  // of n = change, d = n − the last one, e = the last one − that before
    for (std::size_t m = 0; m < size; ++m) {
      const math::Pack w = squared_weight[static_cast<Eigen::Index>(m)] + math::Pack{}, n = now.change[m],
                       d = n - before.change[m];
      dd += w * d * d;
      dn += w * d * n;
      if (first == nullptr) continue;
      const math::Pack e = before.change[m] - first->change[m];
      de += w * d * e;
      ee += w * e * e;
      en += w * e * n;
    }
    const double d2 = math::sum(dd), e2 = math::sum(ee), cross = math::sum(de);
    const double determinant = d2 * e2 - cross * cross;
    double last_share = math::sum(dn) / d2, first_share = 0.0;
    if (determinant > min_independence * d2 * e2) {
      last_share = (math::sum(dn) * e2 - math::sum(en) * cross) / determinant;
      first_share = (math::sum(en) * d2 - math::sum(dn) * cross) / determinant;
    }
    if (!(std::abs(last_share) + std::abs(first_share) < max_coefficients)) return;
    for (std::size_t m = 0; m < size; ++m) x[m] -= last_share * (now.x[m] - before.x[m]);
    if (first_share == 0.0) return;
    for (std::size_t m = 0; m < size; ++m) x[m] -= first_share * (before.x[m] - first->x[m]);
  }

 private:
  /// Smallest ratio of the determinant of the normal equations to its largest possible value; below it, the two
  /// differences are parallel, and only the last one is used.
  static constexpr double min_independence = 1e-3;
  /// Largest sum of the coefficients; beyond it the combination is an extrapolation from noise, and the image is taken.
  static constexpr double max_coefficients = 3.0;

  Image images_[3]{};
  std::size_t count_ = 0;
};

}  // namespace spring_workbench::exponential
