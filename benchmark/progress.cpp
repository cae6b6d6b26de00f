#include "benchmark/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace spring_workbench::benchmark {
namespace {

constexpr std::size_t kWidth = 40;  // characters
constexpr std::size_t kMarks = 20;

}  // namespace

Progress::Progress(std::ostream& out, bool terminal, std::size_t total)
    : out_(out), terminal_(terminal), total_(total), start_(std::chrono::steady_clock::now()) {}

double Progress::elapsed() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Progress::draw(const std::string& what) {
  const std::size_t done = std::min(begun_ - std::min<std::size_t>(begun_, 1), total_);
  const std::size_t filled = kWidth * done / total_;
  const long seconds = std::lround(elapsed());
  char time[32];
  std::snprintf(time, sizeof(time), "%3zu %% %2ld:%02ld ", 100 * done / total_, seconds / 60, seconds % 60);
  if (terminal_) out_ << "\r\033[K";
  out_ << '[' << std::string(filled, '#') << std::string(kWidth - filled, '.') << "] " << time << what;
  if (!terminal_) out_ << '\n';
  out_ << std::flush;
}

void Progress::next(const std::string& what) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++begun_;
  const std::size_t mark = kMarks * begun_ / total_;
  if (!terminal_ && begun_ > 1 && mark == last_mark_) return;
  last_mark_ = mark;
  draw(what);
}

void Progress::finish() {
  const std::lock_guard<std::mutex> lock(mutex_);
  begun_ = total_ + 1;
  draw("done");
  if (terminal_) out_ << std::endl;
}

}  // namespace spring_workbench::benchmark
