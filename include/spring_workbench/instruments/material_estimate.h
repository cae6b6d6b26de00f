#pragma once

#include <deque>
#include <limits>
#include <optional>
#include <vector>

namespace spring_workbench::instruments {

/// A value with its interval of 95 % confidence.
struct Estimate {
  double value = 0.0;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// What one touch of the probe shows of the material. `touch` is the stiffness of material and probe in series, and
/// `material` that of the material alone.
struct MaterialReading {
  Estimate touch;                   ///< [N/m]
  Estimate material;                ///< [N/m]; where the interval of its compliance contains 0, `high` is infinite
  double material_deviation = 0.0;  ///< its standard deviation, to first order [N/m]
  Estimate damping;                 ///< of the touch, parallel to both springs [N·s/m]
};

/// Identifies stiffness and damping from one touch of the probe, by least squares with Student's intervals
/// (doc/model.md, "The probe"). It is given the tracked position of the hand, whose noise it estimates from residuals,
/// and the probe's force, which counts as exact; neither the place of the surface nor anything about the material.
///
/// A spring K with a damper C in parallel obeys F = K d + C ḋ, so the depth is d = Φ(F) / K, where Φ is the low-pass
/// filter with the time constant C / K. Since the force is known and the depth noisy, the depth is fitted:
/// path = b + Φ(F) / K, linear in b and 1 / K, with Gauss–Newton iterations for the time constant.
class MaterialEstimate {
 public:
  /// `probe_stiffness` [N/m], > 0, of the probe's own spring.
  explicit MaterialEstimate(double probe_stiffness) : probe_stiffness_(probe_stiffness) {}

  /// A sample of the tracker at time `t` [s], later than the last: the hand's `path` along the probe's axis, from
  /// anywhere, growing into the surface [m], and the force with which the probe pushes [N]. The oldest are forgotten.
  void add(double t, double path, double force);
  /// None until the forces of the touch differ enough.
  std::optional<MaterialReading> reading() const;

  /// A point of the curve of force over depth.
  struct CurvePoint {
    double depth, force;  ///< of the hand beyond the estimated surface [m], [N]
  };
  /// The samples, once there is a reading.
  std::vector<CurvePoint> curve() const;

 private:
  struct Sample {
    double t, path, force;
  };
  struct Fit {
    double surface = 0.0, compliance = 0.0, lag = 0.0;       ///< b [m], 1 / K [m/N], C / K [s]
    double compliance_deviation = 0.0, lag_deviation = 0.0;  ///< standard deviations
    double quantile = 0.0;                                   ///< of Student's t, for 95 %
  };
  std::optional<Fit> fit() const;
  std::optional<Fit> fit_near(double lag) const;  ///< linearised about this time constant

  double probe_stiffness_;
  std::deque<Sample> samples_;
};

}  // namespace spring_workbench::instruments
