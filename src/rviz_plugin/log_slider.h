#pragma once

#include <QWidget>
#include <functional>

class QLabel;
class QSlider;

namespace spring_workbench::rviz_plugin {

/// A slider with a logarithmic scale and its value beside it. Follows `show` but while a hand is on it, and for a
/// moment after.
class LogSlider : public QWidget {
  Q_OBJECT
 public:
  /// Values `low` … `high`, 0 < low < high.
  LogSlider(double low, double high, const QString& unit, QWidget* parent = nullptr);

  /// The value that is true now, which need not be in the range.
  void show_value(double value);
  /// What the slider stands at, or what was shown last where nobody moved it.
  double value() const { return value_; }

 Q_SIGNALS:
  /// A hand moved it.
  void moved(double value);

 private:
  void on_moved(int position);
  void write();

  const double low_, high_;
  const QString unit_;
  double value_;
  double free_at_ = 0.0;  ///< when it follows again [s]
  QSlider* slider_;
  QLabel* label_;
};

/// Seconds on a clock that does not go back.
double panel_time();

}  // namespace spring_workbench::rviz_plugin
