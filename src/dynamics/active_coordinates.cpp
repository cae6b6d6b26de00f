#include "spring_workbench/dynamics/active_coordinates.h"

#include "constants.h"

namespace spring_workbench::dynamics {
ActiveCoordinates::ActiveCoordinates(int count) : count_(count) { take_modes(); }

void ActiveCoordinates::take_modes() {
  size_ = returning_ = 0;
  for (int c = 0; c < count_; ++c) {
    const Mode mode = mode_[static_cast<std::size_t>(c)];
    if (mode == Mode::active) active_[static_cast<std::size_t>(size_++)] = c;
    if (mode == Mode::returning) ++returning_;
  }
}

void ActiveCoordinates::archive(math::StateArchive& state) {
  state(mode_, return_);
  if (state.is_restoring()) take_modes();
}

void ActiveCoordinates::set(const rod::CoordinateRange& range, bool on, double t, double return_time,
                            const StrainState& full) {
  for (int i = range.begin; i < range.begin + range.count; ++i) {
    Mode& mode = mode_[static_cast<std::size_t>(i)];
    if (on) {
      mode = Mode::active;
    } else if (mode == Mode::active) {
      const bool strained = full.q[i] != 0.0 || full.q_dot[i] != 0.0;
      mode = strained ? Mode::returning : Mode::off;
      return_[static_cast<std::size_t>(i)] = {t, return_time, full.q[i], full.q_dot[i]};
    }
  }
  take_modes();
}

bool ActiveCoordinates::drop_finished_returns(double t) {
  const int before = returning_;
  for (std::size_t c = 0; c < mode_.size(); ++c) {
    const Return& r = return_[c];
    if (mode_[c] == Mode::returning && t - r.t0 > return_duration * r.time_constant) mode_[c] = Mode::off;
  }
  take_modes();
  return returning_ != before;
}

rod::StrainVector ActiveCoordinates::gather(const rod::StrainVector& all) const {
  rod::StrainVector active(size_);
  for (int i = 0; i < size_; ++i) active[i] = all[(*this)[i]];
  return active;
}

StrainState ActiveCoordinates::full_state(double t, const StrainState& active) const {
  StrainState full{rod::StrainVector(count_), rod::StrainVector(count_)};
  scatter(active.q.data(), full.q.data());
  scatter(active.q_dot.data(), full.q_dot.data());
  if (returning()) {
    rod::StrainVector q_ddot(count_);
    prescribe(t, 0, full.q.data(), full.q_dot.data(), q_ddot.data());
  }
  return full;
}

}  // namespace spring_workbench::dynamics
