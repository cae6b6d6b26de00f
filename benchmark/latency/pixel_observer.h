#pragma once

#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include "benchmark/latency/played_device.h"

namespace spring_workbench::benchmark {

/// A ruler that is looked at from above, and how a row of pixels shows it: stripes of one width in red, green and blue,
/// the first to begin at the ruler's origin.
struct Ruler {
  double stripe = 0.004;   ///< [m]
  double scale = 50000.0;  ///< [pixels/m]
  double centre_x = 0.3;   ///< what is in the middle of the row, along x [m]
};

/// Colour of a pixel: 0 red, 1 green, 2 blue; -1: none of them.
int stripe_color(unsigned long pixel);

/// Where the ruler is along x [m], by the first edge between two stripes in the row and nearest to `before`: the
/// stripes repeat. NaN if there is no edge.
double ruler_position(const std::vector<unsigned long>& row, const Ruler& ruler, double before);

/// Watches the middle row of the X display of this process a thousand times a second, in a thread of its own.
class PixelObserver {
 public:
  /// Throws std::runtime_error without a display.
  explicit PixelObserver(const Ruler& ruler);
  ~PixelObserver();
  PixelObserver(const PixelObserver&) = delete;
  PixelObserver& operator=(const PixelObserver&) = delete;

  /// Each time that the ruler was seen somewhere else.
  std::vector<Moment> seen() const;

 private:
  void run();

  Ruler ruler_;
  void* display_;  ///< Xlib's
  mutable std::mutex mutex_;
  std::vector<Moment> seen_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace spring_workbench::benchmark
