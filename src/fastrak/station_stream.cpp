#include "spring_workbench/fastrak/station_stream.h"

#include "constants.h"

namespace spring_workbench::fastrak {
namespace {

/// Slope of the least-squares line through receipts at even intervals [s]; using only the two ends would be exposed to
/// their delays.
double mean_interval(const std::vector<double>& receipts) {
  const double middle = 0.5 * static_cast<double>(receipts.size() - 1);
  double products = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < receipts.size(); ++k) {
    const double from_middle = static_cast<double>(k) - middle;
    products += from_middle * (receipts[k] - receipts.front());
    squares += from_middle * from_middle;
  }
  return products / squares;
}

}  // namespace

double StationStream::by_cadence(double received) {
  if (!even_stamps_) return received;
  if (cadence_ && cadence_->has_wrong_interval()) cadence_.reset();  // records were lost during the measurement
  if (cadence_) return cadence_->stamp(received);
  if (!receipts_.empty() && received - receipts_.back() > stream_silence) receipts_.clear();
  receipts_.push_back(received);
  if (received - receipts_.front() < cadence_measuring_time) return received;
  cadence_.emplace(mean_interval(receipts_));
  double stamp = received;
  for (const double receipt : receipts_) stamp = cadence_->stamp(receipt);
  receipts_.clear();
  return stamp;
}

double StationStream::stamp(double received) {
  const double t = by_cadence(received);
  monitor_.sample(t, received);
  return t;
}

}  // namespace spring_workbench::fastrak
