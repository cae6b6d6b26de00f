#include "spring_workbench/fastrak/cadence_clock.h"

#include <algorithm>
#include <cmath>

#include "constants.h"

namespace spring_workbench::fastrak {

double CadenceClock::stamp(double receipt) {
  if (k_ < 0.0) {
    first_ = stamp_ = receipt;
    k_ = 0.0;
    add({0.0, 0.0});
  } else {
    k_ += 1.0;
    recount(receipt);
    add({k_, receipt - first_ - k_ * interval_});
    fit();
    const double on_line = first_ + k_ * interval_ + line(k_);
    stamp_ = std::max(std::min(on_line, receipt), stamp_ + shortest_stamp_interval);
  }
  receipt_ = receipt;
  return stamp_;
}

bool CadenceClock::has_wrong_interval() const {
  return quickest_.size() == buckets && std::abs(slope_) >= largest_drift * interval_;
}

void CadenceClock::recount(double receipt) {
  const double lateness = receipt - first_ - k_ * interval_ - line(k_);
  recent_.push_back({receipt, lateness});
  const std::size_t many = static_cast<std::size_t>(std::max(late_in_a_row, late_duration / interval_));
  if (recent_.size() > many) recent_.pop_front();
  if (k_ - skipped_at_ > recount_window / interval_) skipped_intervals_ = 0.0;
  double samples = 0.0;
  if (receipt - receipt_ > std::max(stream_silence, 4.0 * interval_)) {
    samples = std::round(lateness / interval_);
  } else if (lateness < -0.5 * interval_) {  // too early: records that were counted as lost were only delayed
    samples = -std::min(std::round(-lateness / interval_), skipped_intervals_);
  } else if (recent_.size() == many && is_even(recent_)) {
    const auto quickest = std::min_element(recent_.begin(), recent_.end(),
                                           [](const Receipt& a, const Receipt& b) { return a.late < b.late; });
    samples = std::round(quickest->late / interval_);
  }
  if (samples == 0.0) return;
  k_ += samples;
  skipped_intervals_ = std::max(0.0, skipped_intervals_ + samples);
  skipped_at_ = k_;
  recent_.clear();
}

/// Whether the receipts arrive at about the device's rate and not in a burst.
bool CadenceClock::is_even(const std::deque<Receipt>& receipts) const {
  const double due = interval_ * static_cast<double>(receipts.size() - 1);
  return receipts.back().t - receipts.front().t > 0.75 * due;
}

void CadenceClock::add(const Point& point) {
  if (quickest_.empty() || point.k >= bucket_end_) {
    quickest_.push_back(point);
    bucket_end_ = point.k + bucket / interval_;
    if (quickest_.size() > buckets) quickest_.pop_front();
  } else if (point.late < quickest_.back().late) {
    quickest_.back() = point;
  }
}

void CadenceClock::fit() {
  std::vector<Point> hull;
  double middle = 0.0;
  for (const Point& p : quickest_) {
    const auto above = [&](const Point& a, const Point& b) {  // b lies on or above the line from a to p
      return (b.late - a.late) * (p.k - a.k) >= (p.late - a.late) * (b.k - a.k);
    };
    while (hull.size() >= 2 && above(hull[hull.size() - 2], hull.back())) hull.pop_back();
    if (hull.empty() || p.k > hull.back().k) hull.push_back(p);
    middle += p.k / static_cast<double>(quickest_.size());
  }
  slope_ = 0.0;
  if ((hull.back().k - hull.front().k) * interval_ >= shortest_fit) {
    const auto right =
        std::upper_bound(hull.begin() + 1, hull.end() - 1, middle, [](double k, const Point& p) { return k < p.k; });
    const Point a = *(right - 1), b = *right;
    const double largest = largest_drift * interval_;
    slope_ = std::clamp((b.late - a.late) / (b.k - a.k), -largest, largest);
  }
  level_ = hull.front().late - slope_ * hull.front().k;
  for (const Point& p : quickest_) level_ = std::min(level_, p.late - slope_ * p.k);
}

}  // namespace spring_workbench::fastrak
