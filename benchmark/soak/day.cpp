#include "benchmark/soak/day.h"

#include <malloc.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>

#include "spring_workbench/live/checkpoint.h"
#include "spring_workbench/motion/stream_clock.h"
#include "spring_workbench/motion_files/open_motion.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::benchmark {
namespace {

using live::Command;
using simulation::Simulation;

constexpr double kTick = 1.0 / 30.0;                        // [s] between the samples of a station
constexpr long kWait = 90, kPressed = 15;                   // samples before a path starts
constexpr double kFork = 0.2;                               // [m] from the handle to the tip
constexpr double kOutOfReach = 1.5;                         // [m] from the centre of the bench
constexpr double kReach = 0.4;                              // [m] to which a longer recorded path is scaled
constexpr double kFaultEvery = 20.0, kChangeEvery = 5.0;    // [s] on average
constexpr std::int64_t kBegin = 1'700'000'000'000'000'000;  // [ns]
constexpr std::size_t kTextRoom = 1'000'000;                // [bytes] more than a checkpoint ever has

std::int64_t nanoseconds(double s) { return std::llround(1e9 * s); }

/// A recording resampled to the rate of a station, relative to its first pose, with the fork pointing down.
std::vector<RigidTransform> path_of(const std::string& file) {
  std::vector<RigidTransform> path;
  const auto source = motion_files::open_motion(file);
  RigidTransform first = RigidTransform::Identity();
  double extent = kReach, due = -std::numeric_limits<double>::infinity();
  while (const auto sample = source->next()) {
    if (path.empty()) first = sample->X;
    if (sample->t < due) continue;
    due = sample->t + kTick;
    const Vector3d p = sample->X.translation() - first.translation();
    extent = std::max(extent, p.norm());
    const Matrix3d turn = sample->X.linear() * first.linear().transpose();
    path.push_back(make_transform(p, Quaterniond(Matrix3d(turn * Quaterniond(0.0, 1.0, 0.0, 0.0).matrix()))));
  }
  for (RigidTransform& X : path) X.translation() *= kReach / extent;
  return path;
}

/// A record received over the line.
struct Record {
  Vector3d p;
  Quaterniond q;
  bool pressed = false;
};

struct Hand {
  const std::vector<RigidTransform>* path = nullptr;
  long next = 0;                      ///< index of the next pose; below 0: waits at the first one
  Vector3d begin = Vector3d::Zero();  ///< start of the path, in world
  double silent_until = 0.0, garbage_until = 0.0, doubled_until = 0.0;
  motion::StampedStream<Record> stream{1.0};
  std::vector<std::pair<std::int64_t, Record>> waiting;
  std::int64_t zero = 0;
  bool pressed = false;  ///< state of the button known to the node
};

class Day {
 public:
  Day(const DayOptions& options, std::ostream& out)
      : options_(options), out_(out), scene_(scene::load_scene(options.scene)), random_(options.seed) {
    for (const std::string& file : options.motions) paths_.push_back(path_of(file));
    text_.reserve(kTextRoom);
    begin_life();
  }

  /// Progress, for messages.
  std::string where() const { return std::to_string(t_) + " s, life " + std::to_string(result_.lives); }
  DayResult run() {
    out_ << "hours,samples,lives,faults,changes,memory_MB\n";
    const double end = 3600.0 * options_.hours;
    for (long tick = 0; t_ < end; ++tick) {
      t_ += kTick;
      if (chance(kTick / kFaultEvery)) make_fault();
      if (chance(kTick / kChangeEvery)) change();
      for (std::size_t hand = 0; hand < hands_.size(); ++hand) send(hand);
      if (t_ >= stands_until_) cycle();
      if (tick % 10 == 0) runner_->show(uniform(0.0, 0.05), now(), [](const live::Progress&) { return false; });
      if (tick % 30 == 0) compare();
      note(tick, end);
    }
    end_life();
    result_.hours = t_ / 3600.0;
    return result_;
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }
  hand_input::LocalTime now() const { return {t_, running_}; }

  void begin_life() {
    ++result_.lives;
    runner_ = std::make_unique<live::SimulationRunner>(scene_, simulation::SimulationSettings(),
                                                       hand_input::InputSettings(), false);
    checkpoint_ = std::make_unique<live::Checkpoint>(*runner_, scene_.path);
    for (Hand& hand : hands_) {
      hand.stream.restart();
      hand.waiting.clear();
      hand.zero = 0;
      hand.pressed = false;
    }
    result_.memory_late = static_cast<double>(mallinfo2().uordblks);
    if (10.0 * t_ <= 3600.0 * options_.hours)
      result_.memory_early = std::max(result_.memory_early, result_.memory_late);
  }
  void keep_journal() {
    runner_->keep_journal(true);
    replayer_ = std::make_unique<live::Replayer>([](const std::string& path) { return scene::load_scene(path); },
                                                 simulation::SimulationSettings());
  }
  /// Ends a life: the replay must reach the same state, whose hash is accumulated.
  void end_life() {
    if (!replayer_) keep_journal();
    compare();
    const auto add = [](std::uint64_t& sum, std::uint64_t hash) { sum = (sum ^ hash) * 0x100000001b3U; };
    add(result_.hash, runner_->locked([](const Simulation& s) { return s.state_hash(); }));
    add(result_.replay_hash, replayer_->simulation()->state_hash());
    result_.mismatches += replayer_->changes().mismatches.size();
    replayer_.reset();
  }
  /// The node exits with the old master, and its successor resumes from the checkpoint.
  void new_master() {
    end_life();
    sender_set_ = host_set_;  // no stream can start with clocks further apart than max_age
    checkpoint_->forget();
    checkpoint_->keep([&](const std::string& kept) { text_ = kept; });
    const auto objects = [&] { return runner_->locked([](const Simulation& s) { return s.objects(); }); };
    const std::vector<bodies::BodyState> before = objects();
    begin_life();
    checkpoint_->resume(text_, "checkpoint", {});
    const std::vector<bodies::BodyState> after = objects();
    for (std::size_t i = 0; i < before.size(); ++i) {
      const bool there = i < after.size() && after[i].X_WO.matrix() == before[i].X_WO.matrix();
      result_.lost_states += there ? 0 : 1;
    }
  }

  void make_fault() {
    Hand& hand = hands_[random_() % hands_.size()];
    const double by = std::array{0.3, -0.3, 3.0, -3.0, 3600.0, -3600.0}[random_() % 6];
    const std::array<std::pair<const char*, std::function<void()>>, 8> all = {{
        {"silence", [&] { hand.silent_until = t_ + uniform(0.2, 3.0); }},
        {"garbage", [&] { hand.garbage_until = t_ + uniform(0.1, 1.0); }},
        {"twice, out of order", [&] { hand.doubled_until = t_ + uniform(0.1, 1.0); }},
        {"host's clock", [&] { host_set_ += by; }},
        {"sender's clock", [&] { sender_set_ += by; }},
        {"suspended", [&] { suspend(chance(0.5) ? 7.0 : 60.0); }},
        {"stopped", [&] { stands_until_ = t_ + uniform(0.2, 10.0); }},
        {"new master", [&] { new_master(); }},
    }};
    const auto& [name, happen] = all[random_() % all.size()];
    ++result_.faults[name];
    happen();
  }
  /// Advances the wall clocks, but not the steady clock.
  void suspend(double seconds) {
    host_set_ += seconds;
    sender_set_ += seconds;
  }

  Command random_command() {
    using Kind = Command::Kind;
    constexpr Kind kinds[] = {Kind::select_tool, Kind::settings, Kind::calibrate, Kind::release,
                              Kind::clutch,      Kind::edit,     Kind::undo};
    Command command;
    command.kind = kinds[random_() % 7];
    if (chance(0.5)) command.hand = random_() % hands_.size();
    command.tool = std::array{tools::Tool::spring, tools::Tool::spring_fork, tools::Tool::direct}[random_() % 3];
    command.on = chance(0.3);
    command.fork_change.dofs = {chance(0.8), chance(0.8), chance(0.8)};
    command.fork_change.stiffness.stretch = uniform(200.0, 1000.0);
    command.edit.action = simulation::ObjectEdit::Action::mass;
    command.edit.name = movable(random_()).name;
    command.edit.mass = uniform(0.2, 2.0);
    return command;
  }
  void change() {
    try {
      if (chance(0.1)) return void(runner_->restart());
      runner_->change("day", random_command());
    } catch (const validation::InputError&) {  // nothing is held, or there is nothing to undo
    }
  }
  const scene::Body& movable(std::size_t number) const {
    std::vector<const scene::Body*> bodies;
    for (const scene::Body& body : scene_.bodies) {
      if (body.movable) bodies.push_back(&body);
    }
    return *bodies.at(number % bodies.size());
  }

  /// Starts a new recording with the tip in an object at its current position. Returns objects that were thrown out of
  /// reach, and switches the clutch off.
  void take_path(std::size_t number) {
    Hand& hand = hands_[number];
    hand.path = &paths_[random_() % paths_.size()];
    hand.next = -kWait;
    const auto place = [&](const std::string& name) {
      return runner_->locked([&](const Simulation& s) {
        const auto is_it = [&](const bodies::BodyState& object) { return object.name == name; };
        return Vector3d(std::find_if(s.objects().begin(), s.objects().end(), is_it)->X_WO.translation());
      });
    };
    const std::string name = movable(random_()).name;
    if (place(name).norm() > kOutOfReach) runner_->restart();
    hand.begin = place(name) + Vector3d(0.0, 0.0, kFork);
    Command clutch_off;
    clutch_off.kind = Command::Kind::clutch;
    clutch_off.hand = number;
    runner_->change("day", clutch_off);
  }
  void send(std::size_t number) {
    Hand& hand = hands_[number];
    if (hand.path == nullptr || hand.next >= static_cast<long>(hand.path->size())) take_path(number);
    const RigidTransform& X = (*hand.path)[static_cast<std::size_t>(std::max(hand.next++, 0L))];
    if (t_ < hand.silent_until) return;
    Record record{hand.begin + X.translation(), Quaterniond(X.linear()), hand.next > -kPressed};
    if (t_ < hand.garbage_until) {
      const double wrong = std::array{std::nan(""), 0.0, 5.0}[random_() % 3];
      record.p = Vector3d::Constant(wrong);
      if (wrong == 0.0) record.q = Quaterniond::Identity();
    }
    const std::int64_t stamp = kBegin + nanoseconds(t_ - uniform(0.001, 0.003)) + nanoseconds(sender_set_);
    hand.waiting.emplace_back(stamp, record);
    if (t_ < hand.doubled_until) hand.waiting.emplace_back(stamp - nanoseconds(uniform(0.0, 0.05)), record);
    ++result_.samples;
  }

  void cycle() {
    running_ += std::min(kTick, 0.01);
    live::HandEvents events;
    for (std::size_t number = 0; number < hands_.size(); ++number) {
      for (const auto& [stamp, record] : std::exchange(hands_[number].waiting, {})) {
        const motion::WallMoment moment =
            wall_.read(kBegin + nanoseconds(t_) + nanoseconds(host_set_), nanoseconds(t_));
        hands_[number].stream.offer(
            record, stamp, moment,
            [&](const Record& one, std::int64_t local, double age) { use(number, one, local, age, events[number]); },
            [](const auto&...) {});
      }
    }
    if (!replayer_) keep_journal();
    while (runner_->cycle(std::exchange(events, {}), now()).more) continue;
    runner_->locked([&](const Simulation& s) {
      bool held = false;
      for (const bodies::BodyState& object : s.objects()) {
        held = held || object.held;
        result_.finite = result_.finite && object.X_WO.matrix().allFinite() && object.V_WO_W.linear.allFinite();
      }
      result_.held_ticks += held ? 1 : 0;
    });
    ++result_.ticks;
  }
  void use(std::size_t number, const Record& record, std::int64_t local, double age,
           std::vector<live::StylusEvent>& events) {
    Hand& hand = hands_[number];
    if (hand.zero == 0) events.emplace_back(live::NewEpoch{hand.zero = local});
    live::StylusPose pose;
    pose.sample = {1e-9 * static_cast<double>(local - hand.zero), record.p, record.q};
    pose.arrival = now();
    pose.age = age;
    const bool was = std::exchange(hand.pressed, record.pressed);
    if (was != record.pressed) {
      events.emplace_back(
          live::StylusButton{pose.sample.t, record.pressed ? motion::ButtonEdge::grasp : motion::ButtonEdge::release});
    }
    events.emplace_back(pose);
  }

  /// Replays the journal so far; the replayer throws if its state differs.
  void compare() {
    if (!replayer_) return;
    runner_->note_state();
    for (const live::Entry& entry : runner_->take_journal()) {
      ++result_.entries;
      if (const auto* made = std::get_if<live::Change>(&entry.what)) {
        const bool empty = made->state == simulation::SimulationState();
        result_.comparisons += empty ? 1 : 0;
        result_.changes += empty ? 0 : 1;
        result_.restarts += made->command.kind == Command::Kind::restart ? 1 : 0;
      }
      replayer_->play(entry, [](const auto&, const auto&) {});
    }
    checkpoint_->keep([](const std::string&) {});
  }

  void note(long tick, double end) {
    if (tick % 1000 != 0) return;
    if (t_ < next_line_) return;
    next_line_ += end / 20.0;
    std::size_t faults = 0;
    for (const auto& [name, count] : result_.faults) faults += count;
    out_ << t_ / 3600.0 << ',' << result_.samples << ',' << result_.lives << ',' << faults << ',' << result_.changes
         << ',' << result_.memory_late / 1e6 << std::endl;
  }

  const DayOptions& options_;
  std::ostream& out_;
  scene::Scene scene_;
  std::mt19937 random_;
  std::vector<std::vector<RigidTransform>> paths_;
  std::array<Hand, 2> hands_;
  motion::WallClock wall_;
  std::unique_ptr<live::SimulationRunner> runner_;
  std::unique_ptr<live::Checkpoint> checkpoint_;
  std::string text_;  ///< of the checkpoint: of one size, so that the heap in use at the start of a life is, too
  std::unique_ptr<live::Replayer> replayer_;
  double t_ = 0.0, running_ = 0.0, host_set_ = 0.0, sender_set_ = 0.0, stands_until_ = 0.0, next_line_ = 0.0;
  DayResult result_;
};

}  // namespace

DayResult run_day(const DayOptions& options, std::ostream& out) {
  Day day(options, out);
  try {
    return day.run();
  } catch (const validation::InputError& error) {
    throw validation::InputError("after " + day.where() + ": " + error.what());
  }
}

}  // namespace spring_workbench::benchmark
