#pragma once

#include <QWidget>
#include <vector>

namespace spring_workbench::rviz_plugin {

/// Plot of what cycles cost and how exact they are, for all of the session so far, on logarithmic axes: over the wall
/// time [s] the local error estimate [m] in blue and, where there is one, the bound on the error since the grasp [m] in
/// amber. Newer cycles are brighter.
class ErrorPlot : public QWidget {
  Q_OBJECT
 public:
  explicit ErrorPlot(QWidget* parent = nullptr);

  /// Adds a cycle. `now`: time of a monotonic clock [s]. Values that are not positive and finite are not plotted.
  void add(double now, double wall_time, double error, double bound);
  /// Removes all cycles: another session begins.
  void clear();
  /// Redraws at time `now` [s].
  void refresh(double now);
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  /// When a cycle fell last into each cell of the plot [s], by rows from the lower left; −∞: never. However long the
  /// session is, drawing takes the same time.
  using Cells = std::vector<double>;
  Cells estimates_, bounds_;
  double now_ = 0.0;
};

}  // namespace spring_workbench::rviz_plugin
