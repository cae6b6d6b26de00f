#include "log_slider.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QSlider>
#include <algorithm>
#include <chrono>
#include <cmath>

#include "constants.h"

namespace spring_workbench::rviz_plugin {

double panel_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

LogSlider::LogSlider(double low, double high, const QString& unit, QWidget* parent)
    : QWidget(parent), low_(low), high_(high), unit_(unit), value_(low) {
  slider_ = new QSlider(Qt::Horizontal, this);
  slider_->setRange(0, slider_positions);
  slider_->setMinimumWidth(60);
  label_ = new QLabel(this);
  label_->setMinimumWidth(label_->fontMetrics().boundingRect("8.88e+05 " + unit).width());
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(slider_, 1);
  layout->addWidget(label_);
  connect(slider_, &QSlider::valueChanged, this, &LogSlider::on_moved);
  write();
}

void LogSlider::show_value(double value) {
  if (slider_->isSliderDown() || panel_time() < free_at_) return;
  value_ = value;
  const double share = std::log(std::clamp(value, low_, high_) / low_) / std::log(high_ / low_);
  slider_->blockSignals(true);
  slider_->setValue(static_cast<int>(std::lround(slider_positions * share)));
  slider_->blockSignals(false);
  write();
}

void LogSlider::on_moved(int position) {
  free_at_ = panel_time() + settling;
  value_ = low_ * std::pow(high_ / low_, static_cast<double>(position) / slider_positions);
  write();
  Q_EMIT moved(value_);
}

void LogSlider::write() { label_->setText(QString::number(value_, 'g', 3) + " " + unit_); }

}  // namespace spring_workbench::rviz_plugin
