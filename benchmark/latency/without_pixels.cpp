#include <stdexcept>

#include "benchmark/latency/pixel_observer.h"

// Where there is no Xlib.

namespace spring_workbench::benchmark {

PixelObserver::PixelObserver(const Ruler& ruler) : ruler_(ruler), display_(nullptr) {
  throw std::runtime_error("built without Xlib (libx11-dev): no pixels");
}
PixelObserver::~PixelObserver() = default;
std::vector<Moment> PixelObserver::seen() const { return seen_; }

}  // namespace spring_workbench::benchmark
