#include "benchmark/latency/pixel_observer.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace spring_workbench::benchmark {

int stripe_color(unsigned long pixel) {
  const std::array<unsigned long, 3> rgb{pixel >> 16 & 0xff, pixel >> 8 & 0xff, pixel & 0xff};
  const auto brightest = std::max_element(rgb.begin(), rgb.end());
  unsigned long others = rgb[0] + rgb[1] + rgb[2] - *brightest;
  return *brightest > 60 && 3 * others < *brightest ? static_cast<int>(brightest - rgb.begin()) : -1;
}

double ruler_position(const std::vector<unsigned long>& row, const Ruler& ruler, double before) {
  const double period = 3.0 * ruler.stripe;
  for (std::size_t i = 1; i < row.size(); ++i) {
    const int left = stripe_color(row[i - 1]), right = stripe_color(row[i]);
    if (left < 0 || right < 0 || right != (left + 1) % 3) continue;
    const double edge = ruler.centre_x + (static_cast<double>(i) - 0.5 * static_cast<double>(row.size())) / ruler.scale;
    const double position = edge - right * ruler.stripe;  // up to whole periods
    return std::isfinite(before) ? position + period * std::round((before - position) / period) : position;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

PixelObserver::PixelObserver(const Ruler& ruler) : ruler_(ruler), display_(XOpenDisplay(nullptr)) {
  if (display_ == nullptr) throw std::runtime_error("there is no X display");
  thread_ = std::thread([this] { run(); });
}

PixelObserver::~PixelObserver() {
  ends_ = true;
  thread_.join();
  XCloseDisplay(static_cast<Display*>(display_));
}

std::vector<Moment> PixelObserver::observed() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return observed_;
}

void PixelObserver::run() {
  auto* display = static_cast<Display*>(display_);
  const int screen = DefaultScreen(display);
  const int width = DisplayWidth(display, screen), height = DisplayHeight(display, screen);
  std::vector<unsigned long> row(static_cast<std::size_t>(width));
  double before = std::numeric_limits<double>::quiet_NaN();
  while (!ends_) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    XImage* image = XGetImage(display, RootWindow(display, screen), 0, height / 2, static_cast<unsigned>(width), 1,
                              AllPlanes, ZPixmap);
    if (image == nullptr) continue;
    const double t = steady_now();
    for (int x = 0; x < width; ++x) row[static_cast<std::size_t>(x)] = XGetPixel(image, x, 0);
    XDestroyImage(image);
    const double now = ruler_position(row, ruler_, before);
    if (!std::isfinite(now) || now == before) continue;
    before = now;
    const std::lock_guard<std::mutex> lock(mutex_);
    observed_.push_back({t, now});
  }
}

}  // namespace spring_workbench::benchmark
