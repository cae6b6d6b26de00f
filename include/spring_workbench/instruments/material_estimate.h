#pragma once

#include <deque>
#include <limits>
#include <optional>
#include <vector>

namespace spring_workbench::instruments {

/// A value with its 95 % confidence interval.
struct Estimate {
  double value = 0.0;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// Material properties estimated from one touch of the probe.
struct MaterialReading {
  Estimate touch;     ///< [N/m]
  Estimate material;  ///< stiffness of the material alone [N/m]; `high` is infinite if the interval of the compliance
                      ///< contains 0
  double material_deviation = 0.0;  ///< its standard deviation, to first order [N/m]
  Estimate damping;                 ///< damping of the material: of the touch without the probe's own damper [N·s/m]
};

/// Identifies stiffness and damping from one touch of the probe by least squares, with confidence intervals from
/// Student's t distribution (doc/model.md, "The probe"). Its input is the tracked position of the hand, whose noise it
/// estimates from the residuals, and the probe's force, which is taken as exact. It knows neither the position of the
/// surface nor anything about the material.
///
/// A spring K with a damper C in parallel obeys F = K d + C ḋ, so the depth is d = Φ(F) / K, where Φ is the low-pass
/// filter with the time constant C / K. Since the force is known and the depth noisy, the depth is fitted:
/// path = b + Φ(F) / K, linear in b and 1 / K, with Gauss–Newton iterations for the time constant.
class MaterialEstimate {
 public:
  /// `probe_stiffness` [N/m], > 0, of the probe's own spring; `probe_damping` [N·s/m], ≥ 0, of its own damper.
  explicit MaterialEstimate(double probe_stiffness, double probe_damping = 0.0)
      : probe_stiffness_(probe_stiffness), probe_damping_(probe_damping) {}

  /// Adds a sample at time `t` [s], later than the last: the hand's position `path` along the probe's axis [m], from
  /// any origin and positive into the surface, and the force with which the probe pushes [N]. The oldest samples are
  /// dropped.
  void add(double t, double path, double force);
  /// Returns the estimate; none until the forces of the touch vary enough.
  std::optional<MaterialReading> reading() const;

  /// A point of the force–depth curve.
  struct CurvePoint {
    double depth, force;  ///< depth of the hand beyond the estimated surface [m]; force [N]
  };
  /// The samples as a force–depth curve; empty until there is a reading.
  std::vector<CurvePoint> curve() const;

 private:
  struct Sample {
    double t, path, force;
  };
  struct Fit {
    double surface = 0.0, compliance = 0.0, lag = 0.0;       ///< b [m], 1 / K [m/N], C / K [s]
    double compliance_deviation = 0.0, lag_deviation = 0.0;  ///< standard deviations
    double quantile = 0.0;                                   ///< quantile of Student's t for 95 %
  };
  std::optional<Fit> fit() const;
  std::optional<Fit> fit_near(double lag) const;  ///< linearised about this time constant

  double probe_stiffness_, probe_damping_;
  std::deque<Sample> samples_;
};

}  // namespace spring_workbench::instruments
