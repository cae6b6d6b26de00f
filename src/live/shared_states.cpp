#include "spring_workbench/live/shared_states.h"

#include <algorithm>
#include <utility>

namespace spring_workbench::live {

void SharedStates::update_from(const simulation::Simulation& simulation) {
  const std::vector<bodies::BodyState>& states = simulation.objects();
  const bodies::ChangeLog& changes = simulation.object_changes();
  const std::vector<std::size_t> changed = changes.since(at_);
  at_ = changes.now();
  if (changed.empty() && states.size() == size_) return;
  size_ = states.size();
  Parts parts = *parts_;
  parts.resize((size_ + part_size - 1) / part_size);
  std::size_t next = 0;  // next part to take over
  for (const std::size_t object : changed) {
    const std::size_t part = part_of(object), begin = begin_of(part), end = std::min(begin + part_size, size_);
    if (part < next) continue;
    next = part + 1;
    parts[part] = std::make_shared<const Part>(states.begin() + static_cast<std::ptrdiff_t>(begin),
                                               states.begin() + static_cast<std::ptrdiff_t>(end));
  }
  parts_ = std::make_shared<const Parts>(std::move(parts));
}

}  // namespace spring_workbench::live
