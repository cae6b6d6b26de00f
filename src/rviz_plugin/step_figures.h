#pragma once

#ifndef Q_MOC_RUN
#include <QWidget>
#include <cstddef>

#include "spring_workbench/StepReport.h"
#endif

class QLabel;

namespace spring_workbench::rviz_plugin {

class ErrorPlot;

/// What the steps cost and how well they did, from `~steps`: the newest in words, the last seconds as a plot.
class StepFigures : public QWidget {
 public:
  explicit StepFigures(QWidget* parent);

  /// `now` [s] on a clock that does not go back.
  void add(double now, const StepReportConstPtr& steps);
  void clear();
  void refresh(double now);

 private:
  StepReportConstPtr steps_;
  std::size_t missed_ = 0;  ///< deadlines
  QLabel *figures_, *skipped_;
  ErrorPlot* plot_;
};

}  // namespace spring_workbench::rviz_plugin
