#include "spring_workbench/live/shared_states.h"

#include <algorithm>

namespace spring_workbench::live {

void SharedStates::follow(const simulation::Simulation& simulation) {
  const std::vector<bodies::BodyState>& states = simulation.objects();
  const bodies::Changes& changes = simulation.object_changes();
  size_ = states.size();
  parts_.resize((size_ + part_size - 1) / part_size);
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const std::size_t begin = begin_of(part), end = std::min(begin + part_size, size_);
    bool changed = false;
    for (std::size_t i = begin; i < end; ++i) changed |= changes.since(at_, i);
    if (!changed) continue;
    parts_[part] = std::make_shared<const Part>(states.begin() + static_cast<std::ptrdiff_t>(begin),
                                                states.begin() + static_cast<std::ptrdiff_t>(end));
  }
  at_ = changes.now();
}

}  // namespace spring_workbench::live
