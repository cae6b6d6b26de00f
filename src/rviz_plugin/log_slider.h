#pragma once

#include <QWidget>
#include <functional>

class QLabel;
class QSlider;

namespace spring_workbench::rviz_plugin {

/// A slider with a logarithmic scale and its value next to it. It follows `show_value`, except while the user moves it
/// and for a moment afterwards.
class LogSlider : public QWidget {
  Q_OBJECT
 public:
  /// Range `low` … `high`, 0 < low < high.
  LogSlider(double low, double high, const QString& unit, QWidget* parent = nullptr);

  /// Shows the current value, which may be outside the range.
  void show_value(double value);
  /// The value set by the user or, if the slider was not moved, the last value shown.
  double value() const { return value_; }

 Q_SIGNALS:
  /// Signals that the user moved it.
  void moved(double value);

 private:
  void on_moved(int position);
  void write();

  const double low_, high_;
  const QString unit_;
  double value_;
  double free_at_ = 0.0;  ///< time from which it follows again [s]
  QSlider* slider_;
  QLabel* label_;
};

/// Time of a monotonic clock [s].
double panel_time();

}  // namespace spring_workbench::rviz_plugin
