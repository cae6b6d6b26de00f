#pragma once

#include <QWidget>
#include <deque>

namespace spring_workbench::rviz_plugin {

/// Local error estimate [m] against wall time [s] of the cycles of the last seconds, both logarithmic; newer is
/// brighter.
class ErrorPlot : public QWidget {
  Q_OBJECT
 public:
  explicit ErrorPlot(QWidget* parent = nullptr);

  /// `now` [s] on a clock that does not go back. What is not positive and finite has no place on the plot.
  void add(double now, double wall_time, double error);
  /// Forgets what is older than some seconds, and draws.
  void refresh(double now);
  QSize sizeHint() const override { return {220, 120}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  struct Point {
    double t, wall_time, error;
  };
  std::deque<Point> points_;
  double now_ = 0.0;
};

}  // namespace spring_workbench::rviz_plugin
