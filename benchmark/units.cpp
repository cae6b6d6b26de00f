#include "benchmark/units.h"

namespace spring_workbench::benchmark {

UnitRows Units::take(const std::string& name) {
  progress_.next(name);
  const auto found = rows_.find(name);
  if (found == rows_.end())
    validation::refuse("shards", "unit", name, "measured by one of them: same build, same peers, same recordings");
  UnitRows unit = std::move(found->second);
  rows_.erase(found);
  return unit;
}

}  // namespace spring_workbench::benchmark
