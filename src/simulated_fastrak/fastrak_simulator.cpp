#include "spring_workbench/simulated_fastrak/fastrak_simulator.h"

#include <chrono>
#include <filesystem>
#include <thread>
#include <utility>

#include "constants.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::simulated_fastrak {

FastrakSimulator::FastrakSimulator(FastrakDevice device, LineFaults faults, std::string link)
    : device_(std::move(device)), faults_(std::move(faults)), link_(std::move(link)) {
  if (!faults_.active(Fault::Kind::unplug, 0.0)) plug_in();
}

FastrakSimulator::~FastrakSimulator() { unplug(); }

void FastrakSimulator::plug_in() {
  terminal_ = std::make_unique<PseudoTerminal>();
  device_.reset();
  if (link_.empty()) return;
  std::error_code error;
  if (std::filesystem::is_symlink(link_)) std::filesystem::remove(link_, error);
  if (std::filesystem::exists(link_))
    validation::refuse("command line", "--link", link_, "a path that does not exist yet");
  std::filesystem::create_symlink(terminal_->path(), link_, error);
  if (error)
    validation::refuse("command line", "--link", link_, "a path where a link can be created (" + error.message() + ")");
}

void FastrakSimulator::unplug() {
  std::error_code error;
  if (!link_.empty() && terminal_ && std::filesystem::read_symlink(link_, error) == terminal_->path()) {
    std::filesystem::remove(link_, error);
  }
  terminal_.reset();
  waiting_.clear();
}

void FastrakSimulator::send(const std::string& bytes) {
  waiting_ += bytes;
  if (terminal_) waiting_.erase(0, terminal_->write(waiting_));
}

void FastrakSimulator::serve(double timeout) {
  if (!terminal_) {
    std::this_thread::sleep_for(std::chrono::duration<double>(timeout));
    return;
  }
  const std::string asked = terminal_->read(timeout);
  if (faults_.active(Fault::Kind::silence, t_)) return;
  send(asked.empty() ? "" : device_.receive(asked));
}

void FastrakSimulator::measure(double t) {
  const bool unplugged = faults_.active(Fault::Kind::unplug, t);
  if (unplugged && terminal_) unplug();
  if (!unplugged && !terminal_) plug_in();
  if (faults_.mode_changes(t_, t)) device_.leave_in_another_mode();
  t_ = t;
  const std::string record = device_.measure(t);
  if (record.empty() || !terminal_) return;
  if (waiting_.size() > max_waiting) {
    ++dropped_;
    return;
  }
  ++sent_;
  send(faults_.pass(record, t));
}

}  // namespace spring_workbench::simulated_fastrak
