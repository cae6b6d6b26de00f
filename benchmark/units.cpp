#include "benchmark/units.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace spring_workbench::benchmark {

double processor_time_of_all() {
  double seconds = 0.0;
  for (const int whose : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage used{};
    getrusage(whose, &used);
    for (const timeval& t : {used.ru_utime, used.ru_stime})
      seconds += static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  }
  return seconds;
}

void Units::begin(const std::string& part) {
  part_ = part;
  mine_.clear();
}

bool Units::is_mine(std::size_t number) {
  if (queue_.empty()) return number % shard_.count == shard_.index - 1;
  const auto [asked, is_new] = mine_.emplace(number, false);
  if (is_new) {
    const std::string path = queue_ + '/' + part_ + ' ' + std::to_string(number);
    const int file = open(path.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (file < 0 && errno != EEXIST) throw std::system_error(errno, std::generic_category(), path);
    if (file >= 0) close(file);
    asked->second = file >= 0;
  }
  return asked->second;
}

UnitRows Units::take(const std::string& name) {
  progress_.next(name);
  const auto found = rows_.find(name);
  if (found == rows_.end())
    validation::refuse("shards", "unit", name,
                       "one that was measured by one of them: same build, same baselines, same recordings");
  UnitRows unit = std::move(found->second);
  rows_.erase(found);
  times_.push_back({part_, name, unit.processor});
  return unit;
}

}  // namespace spring_workbench::benchmark
