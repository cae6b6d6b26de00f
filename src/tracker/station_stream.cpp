#include "spring_workbench/tracker/station_stream.h"

namespace spring_workbench {

double StationStream::stamp(double received) {
  constexpr double measured_for = 3.0;  // [s]
  constexpr double longest_gap = 0.25;  // [s]
  if (!even_stamps_) return received;
  if (cadence_) return cadence_->stamp(received);
  if (count_ == 0 || received - last_ > longest_gap) {
    first_ = received;
    count_ = 0;
  }
  ++count_;
  last_ = received;
  if (received - first_ >= measured_for) cadence_.emplace((received - first_) / (count_ - 1));
  return received;
}

TrueSample StationStream::take(const StationSample& sample) {
  const double t = stamp(sample.received);
  const TrueSample taken = truth_.take(RawSample{t, sample.p_TS, sample.q_TS});
  if (usable(taken.verdict)) monitor_.sample(t, sample.received);
  return taken;
}

}  // namespace spring_workbench
