#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

#include "spring_workbench/motion/motion_segment.h"

namespace spring_workbench::motion {

/// Predicts the motion of a tracked frame from its last samples: the weighted mean of the newest pose and of four
/// parabolas that fit the past, each with another forgetting time. The weights are those with which the predictions of
/// the last second would have had the smallest error (doc/tracker.md, "Error of the display").
class PosePredictor {
 public:
  static constexpr double farthest = 0.1;  ///< longest prediction [s]; beyond it, the frame is at rest

  /// Adds a sample, later than the last one.
  void push(const PoseSample& sample);
  /// Forgets everything, after a jump, a dropout or a loss. Nothing is predicted until the second new sample.
  void restart() { *this = PosePredictor(); }

  /// The predicted pose at time `t` [s], but at most `farthest` beyond the newest sample. Nothing if `t` is not later
  /// than the newest sample, or if there are fewer than two.
  std::optional<PoseSample> predict(double t) const;
  /// Predicted samples by which a PoseTrack with these samples follows the prediction, with its velocities, up to time
  /// `t` [s], but not beyond `farthest`. None if there are fewer than two samples.
  std::vector<PoseSample> continuation(double t) const;

 private:
  static constexpr int parabolas = 4, models = parabolas + 1;
  using Covariance = Eigen::Matrix<double, models, models>;
  /// Position and rotation vector relative to the newest pose, as a function of the time since it.
  struct Parabola {
    std::array<Vector6d, 3> c{Vector6d::Zero(), Vector6d::Zero(), Vector6d::Zero()};
    Vector6d at(double s) const { return c[0] + s * (c[1] + s * c[2]); }
  };
  struct Prediction {
    PoseSample newest;
    std::array<Parabola, models> of_model;  ///< the first stays at the newest pose
  };

  /// An earlier sample relative to the newest one.
  struct Earlier {
    double age;      ///< [s]
    Vector6d moved;  ///< position and rotation vector
  };

  void compare(const PoseSample& sample);
  static Parabola fit(const std::vector<Earlier>& past, double forgetting_time);
  Parabola mean(const Prediction& prediction) const;
  PoseSample at(double t) const;

  std::deque<PoseSample> samples_;                                              ///< that are fitted; the newest last
  double interval_ = 0.0;                                                       ///< between the last two samples [s]
  std::deque<Prediction> predictions_;                                          ///< not compared yet; the newest last
  Covariance positions_ = Covariance::Zero(), rotations_ = Covariance::Zero();  ///< sums of the errors' products
  Parabola mean_;
};

}  // namespace spring_workbench::motion
