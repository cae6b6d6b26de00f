#include <stdexcept>

#include "benchmark/latency/pixel_observer.h"

// Used if Xlib is missing.

namespace spring_workbench::benchmark {

PixelObserver::PixelObserver(const Ruler& ruler) : ruler_(ruler), display_(nullptr) {
  throw std::runtime_error("built without Xlib (libx11-dev): no pixels");
}
PixelObserver::~PixelObserver() = default;
std::vector<Moment> PixelObserver::observed() const { return observed_; }

}  // namespace spring_workbench::benchmark
