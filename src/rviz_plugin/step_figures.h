#pragma once

#ifndef Q_MOC_RUN
#include <QWidget>
#include <cstddef>

#include "spring_workbench/StepReport.h"
#endif

class QLabel;

namespace spring_workbench::rviz_plugin {

class ErrorPlot;

/// Cost and accuracy of the steps, from `~steps`: the newest as text, all of the session so far as a plot.
class StepFigures : public QWidget {
 public:
  explicit StepFigures(QWidget* parent);

  /// `now`: time of a monotonic clock [s].
  void add(double now, const StepReportConstPtr& steps);
  /// The session is over: the next `add` begins another.
  void clear();
  void refresh(double now);

 private:
  StepReportConstPtr steps_;
  std::size_t missed_ = 0;  ///< number of deadlines missed
  QLabel *figures_, *skipped_;
  ErrorPlot* plot_;
};

}  // namespace spring_workbench::rviz_plugin
