#include "error_plot.h"

#include <QPainter>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

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

/// About as many cells along each axis as the plot has pixels at its usual size.
const QSize cells(221, 121);

constexpr double never = -std::numeric_limits<double>::infinity();

std::size_t cell_of(double wall_time, double error) {
  const long column = std::lround((cells.width() - 1) * times.place(wall_time));
  return static_cast<std::size_t>(std::lround((cells.height() - 1) * errors.place(error)) * cells.width() + column);
}

}  // namespace

ErrorPlot::ErrorPlot(QWidget* parent) : QWidget(parent) {
  setMinimumHeight(90);
  setToolTip(
      "all cycles so far, over their run time: error estimate (blue), bound on the error since the grasp (amber)");
  clear();
}

void ErrorPlot::add(double now, double wall_time, double error, double bound) {
  const auto plotted = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (!plotted(wall_time)) return;
  if (plotted(error)) estimates_[cell_of(wall_time, error)] = now;
  if (plotted(bound)) bounds_[cell_of(wall_time, bound)] = now;
}

void ErrorPlot::clear() {
  estimates_.assign(static_cast<std::size_t>(cells.width() * cells.height()), never);
  bounds_ = estimates_;
}

void ErrorPlot::refresh(double now) {
  now_ = now;
  update();
}

QSize ErrorPlot::sizeHint() const { return {220, 120}; }

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
  const auto paint = [&](const Cells& last, QColor color) {
    QImage dots(size(), QImage::Format_ARGB32_Premultiplied);  // a pixel each, which is drawn as two by three
    dots.fill(Qt::transparent);
    for (std::size_t i = 0; i < last.size(); ++i) {
      if (last[i] == never) continue;
      const std::div_t cell = std::div(static_cast<int>(i), cells.width());
      const QPoint dot = at(cell.rem / (cells.width() - 1.0), cell.quot / (cells.height() - 1.0)).toPoint();
      const double opacity = std::clamp(1.0 - (now_ - last[i]) / plot_fading, 0.35, 1.0);
      color.setAlphaF(1.0 - (1.0 - opacity) * (1.0 - dots.pixelColor(dot).alphaF()));  // above those there
      dots.setPixelColor(dot, color);
    }
    for (int i = 0; i < 6; ++i) painter.drawImage(i % 2 - 1, i / 2 - 2, dots);
  };
  paint(estimates_, QColor(90, 190, 250));
  paint(bounds_, QColor(250, 180, 70));
}

}  // namespace spring_workbench::rviz_plugin
