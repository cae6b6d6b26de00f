#include "step_figures.h"

#include <QLabel>
#include <QVBoxLayout>

#include "error_plot.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::rviz_plugin {

StepFigures::StepFigures(QWidget* parent)
    : QWidget(parent), figures_(new QLabel(this)), skipped_(new QLabel(this)), plot_(new ErrorPlot(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  for (QLabel* label : {figures_, skipped_}) {
    label->setWordWrap(true);
    layout->addWidget(label);
  }
  layout->addWidget(plot_);
}

void StepFigures::add(double now, const StepReportConstPtr& steps) {
  if (!steps_) plot_->clear();
  steps_ = steps;
  if (steps->deadline_missed) ++missed_;
  plot_->add(now, steps->wall_time, steps->position_error, steps->error_bound);
}

void StepFigures::clear() {
  steps_.reset();
  missed_ = 0;
}

void StepFigures::refresh(double now) {
  plot_->refresh(now);
  if (!steps_) {
    figures_->setText("no data");
    skipped_->clear();
    return;
  }
  const bool bounded = steps_->steps > 0 && steps_->integrations_without_bound == 0;
  figures_->setText(QString("cycle %1 ms, error %2 m%3, deadlines missed: %4")
                        .arg(1e3 * steps_->wall_time, 0, 'f', 3)
                        .arg(steps_->position_error, 0, 'g', 2)
                        .arg(bounded ? QString(", of the run at most %1 m").arg(steps_->error_bound, 0, 'g', 2) : "")
                        .arg(missed_));
  const QString skipped = QString::fromStdString(validation::join(steps_->skipped));
  skipped_->setText("skipped: " + (skipped.isEmpty() ? "nothing" : skipped));
}

}  // namespace spring_workbench::rviz_plugin
