#pragma once

#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include "benchmark/latency/played_device.h"

namespace spring_workbench::benchmark {

/// A ruler seen from above in a row of pixels: stripes of equal width in red, green and blue, the first one starting at
/// the ruler's origin.
struct Ruler {
  double stripe = 0.004;   ///< [m]
  double scale = 50000.0;  ///< [pixels/m]
  double centre_x = 0.3;   ///< x coordinate at the centre of the row [m]
};

/// Colour of a pixel: 0 red, 1 green, 2 blue; -1: none of these.
int stripe_color(unsigned long pixel);

/// Position of the ruler along x [m], from the first edge between two stripes in the row. Since the stripes repeat, it
/// is the solution nearest to `before`. NaN if there is no edge.
double ruler_position(const std::vector<unsigned long>& row, const Ruler& ruler, double before);

/// Reads the middle row of the X display of this process a thousand times a second, in a separate thread.
class PixelObserver {
 public:
  /// Throws std::runtime_error if there is no display.
  explicit PixelObserver(const Ruler& ruler);
  ~PixelObserver();
  PixelObserver(const PixelObserver&) = delete;
  PixelObserver& operator=(const PixelObserver&) = delete;

  /// The moments at which the ruler appeared at a new position.
  std::vector<Moment> observed() const;

 private:
  void run();

  Ruler ruler_;
  void* display_;  ///< Xlib's
  mutable std::mutex mutex_;
  std::vector<Moment> observed_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace spring_workbench::benchmark
