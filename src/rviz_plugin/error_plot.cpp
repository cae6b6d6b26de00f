#include "error_plot.h"

#include <QPainter>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "constants.h"

namespace spring_workbench::rviz_plugin {
namespace {

/// A range of powers of ten.
struct Decades {
  double low, high;  // exponents
  double place(double value) const { return std::clamp((std::log10(value) - low) / (high - low), 0.0, 1.0); }
};
constexpr Decades times{-5.0, -1.0};    // [s]
constexpr Decades errors{-13.0, -3.0};  // [m]

}  // namespace

ErrorPlot::ErrorPlot(QWidget* parent) : QWidget(parent) {
  setMinimumHeight(90);
  setToolTip("error estimate against run time of the cycles of the last ten seconds");
}

void ErrorPlot::add(double now, double wall_time, double error) {
  if (wall_time > 0.0 && std::isfinite(wall_time) && error > 0.0 && std::isfinite(error)) {
    points_.push_back({now, wall_time, error});
  }
}

void ErrorPlot::refresh(double now) {
  now_ = now;
  while (!points_.empty() && points_.front().t < now - plot_duration) points_.pop_front();
  update();
}

void ErrorPlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), QColor(30, 33, 38));
  const QRectF area = QRectF(rect()).adjusted(42.0, 6.0, -8.0, -18.0);
  const auto at = [&](double x, double y) {
    return QPointF(area.left() + x * area.width(), area.bottom() - y * area.height());
  };
  QFont small = font();
  small.setPointSizeF(7.0);
  painter.setFont(small);
  const QColor grid(70, 75, 82), text(170, 175, 182);
  for (double decade = times.low; decade <= times.high; ++decade) {
    const double x = (decade - times.low) / (times.high - times.low);
    painter.setPen(grid);
    painter.drawLine(at(x, 0.0), at(x, 1.0));
  }
  for (double decade = errors.low + 1.0; decade <= errors.high; decade += 3.0) {
    const double y = (decade - errors.low) / (errors.high - errors.low);
    painter.setPen(grid);
    painter.drawLine(at(0.0, y), at(1.0, y));
    painter.setPen(text);
    painter.drawText(at(0.0, y) + QPointF(-40.0, 4.0), QString("1e%1 m").arg(static_cast<int>(decade)));
  }
  painter.setPen(text);
  painter.drawText(at(0.0, 0.0) + QPointF(-12.0, 13.0), "10 us");
  painter.drawText(at(0.5, 0.0) + QPointF(-10.0, 13.0), "1 ms");
  painter.drawText(at(1.0, 0.0) + QPointF(-30.0, 13.0), "100 ms");
  painter.setPen(Qt::NoPen);
  std::set<std::pair<int, int>> painted;  // pixels: of a thousand cycles a second, most lie on newer ones
  for (auto point = points_.rbegin(); point != points_.rend(); ++point) {
    const QPointF place = at(times.place(point->wall_time), errors.place(point->error));
    if (!painted.emplace(qRound(place.x()), qRound(place.y())).second) continue;
    const double fade = std::clamp(1.0 - (now_ - point->t) / plot_duration, 0.1, 1.0);
    painter.setBrush(QColor(90, 190, 250, static_cast<int>(255.0 * fade)));
    painter.drawEllipse(place, 1.5, 1.5);
  }
}

}  // namespace spring_workbench::rviz_plugin
