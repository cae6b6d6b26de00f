#include "src/rviz_plugin/error_plot.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QPaintEngine>
#include <cmath>
#include <memory>

namespace spring_workbench::rviz_plugin::error_plot_test {
namespace {

const QColor background(30, 33, 38), blue(90, 190, 250);

/// Counts what is drawn.
class Counter : public QPaintEngine, public QPaintDevice {
 public:
  Counter() : QPaintEngine(AllFeatures) {}
  int drawn = 0;

  bool begin(QPaintDevice*) override { return true; }
  bool end() override { return true; }
  void updateState(const QPaintEngineState&) override {}
  Type type() const override { return User; }
  void drawPath(const QPainterPath&) override { ++drawn; }
  void drawPolygon(const QPointF*, int, PolygonDrawMode) override { ++drawn; }
  void drawPixmap(const QRectF&, const QPixmap&, const QRectF&) override { ++drawn; }
  void drawImage(const QRectF&, const QImage&, const QRectF&, Qt::ImageConversionFlags) override { ++drawn; }
  void drawTextItem(const QPointF&, const QTextItem&) override { ++drawn; }

  QPaintEngine* paintEngine() const override { return const_cast<Counter*>(this); }
  int metric(PaintDeviceMetric metric) const override { return metric == PdmDepth ? 32 : 1000; }
};

class ErrorPlotTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    static int argc = 1;
    static char name[] = "test", *argv[] = {name, nullptr};
    qputenv("QT_QPA_PLATFORM", "offscreen");
    application_ = std::make_unique<QApplication>(argc, argv);
  }
  static void TearDownTestSuite() { application_.reset(); }

  void SetUp() override {
    plot_ = std::make_unique<ErrorPlot>();
    plot_->resize(220, 120);
  }

  /// A cycle for every place of the plot, all at time 0.
  void fill() {
    for (int column = 0; column <= 220; ++column) {
      for (int row = 0; row <= 120; ++row) {
        const double error = std::pow(10.0, -13.0 + row / 12.0);
        plot_->add(0.0, std::pow(10.0, -5.0 + column / 55.0), error, with_bound_ ? error : 0.0);
      }
    }
  }
  QImage image(double now) {
    plot_->refresh(now);
    return plot_->grab().toImage();
  }
  int drawn() {
    Counter counter;
    plot_->render(&counter);
    return counter.drawn;
  }

  static std::unique_ptr<QApplication> application_;
  std::unique_ptr<ErrorPlot> plot_;
  bool with_bound_ = false;
};

std::unique_ptr<QApplication> ErrorPlotTest::application_;

/// Whether the colour is `opacity` of the dots' above the background's.
testing::AssertionResult is_blue(const QColor& color, double opacity, int tolerance) {
  const auto differs = [&](int given, int of_dot, int of_ground) {
    return std::abs(given - (of_ground + opacity * (of_dot - of_ground))) > tolerance;
  };
  if (!differs(color.red(), blue.red(), background.red()) &&
      !differs(color.green(), blue.green(), background.green()) &&
      !differs(color.blue(), blue.blue(), background.blue()))
    return testing::AssertionSuccess();
  return testing::AssertionFailure() << color.name().toStdString() << " at opacity " << opacity;
}

TEST_F(ErrorPlotTest, EveryPlaceShowsItsCycle) {
  fill();
  for (const QSize& size : {QSize(220, 120), QSize(400, 150), QSize(220, 120)}) {
    plot_->resize(size);
    const QImage shown = image(1000.0);
    for (int x = 45; x < size.width() - 11; ++x) {
      for (int y = 9; y < size.height() - 21; ++y)
        ASSERT_TRUE(is_blue(shown.pixelColor(x, y), size.width() == 220 ? 0.95 : 0.8, size.width() == 220 ? 12 : 50))
            << x << ", " << y;
    }
  }
  with_bound_ = true;
  fill();
  EXPECT_GT(image(1000.0).pixelColor(100, 50).red(), 240) << "amber above blue";
}

TEST_F(ErrorPlotTest, WorkDoesNotGrowWithTheNumberOfCycles) {
  const int of_none = drawn();
  EXPECT_GT(of_none, 10) << "axes";
  plot_->add(0.0, 1e-3, 1e-8, 1e-7);
  EXPECT_EQ(drawn(), of_none);
  with_bound_ = true;
  fill();
  EXPECT_EQ(drawn(), of_none);
}

TEST_F(ErrorPlotTest, ADotFades) {
  const QImage empty = image(0.0);
  const double wall_time = std::pow(10.0, -3.5), error = std::pow(10.0, -8.5);
  plot_->add(20.0, wall_time, error, 0.0);
  int dotted = 0;
  QPoint dot;
  const QImage fresh = image(20.0);
  for (int x = 0; x < fresh.width(); ++x) {
    for (int y = 0; y < fresh.height(); ++y) {
      if (fresh.pixel(x, y) == empty.pixel(x, y)) continue;
      ++dotted;
      dot = QPoint(x, y);
    }
  }
  EXPECT_EQ(dotted, 6);
  EXPECT_TRUE(is_blue(fresh.pixelColor(dot), 1.0, 2));
  EXPECT_TRUE(is_blue(image(25.0).pixelColor(dot), 0.5, 2));
  EXPECT_TRUE(is_blue(image(40.0).pixelColor(dot), 0.35, 2));
  plot_->add(40.0, wall_time, error, 0.0);
  EXPECT_EQ(image(40.0), fresh) << "renewed";
  EXPECT_TRUE(is_blue(image(60.0).pixelColor(dot), 0.35, 2)) << "still one";
  plot_->clear();
  EXPECT_EQ(image(60.0), empty);
}

}  // namespace
}  // namespace spring_workbench::rviz_plugin::error_plot_test
