#pragma once

#include <QWidget>
#include <deque>

namespace spring_workbench::rviz_plugin {

/// Plot of local error estimate [m] against wall time [s] for the cycles of the last seconds, on logarithmic axes;
/// newer cycles are brighter.
class ErrorPlot : public QWidget {
  Q_OBJECT
 public:
  explicit ErrorPlot(QWidget* parent = nullptr);

  /// Adds a cycle. `now`: time of a monotonic clock [s]. Values that are not positive and finite are not plotted.
  void add(double now, double wall_time, double error);
  /// Removes cycles older than a few seconds and redraws.
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
