// contact_engines [quick]: piles, unequal masses and the card house in our contact and in the engines of the report, as
// CSV.
#include <algorithm>
#include <iostream>
#include <numeric>

#include "benchmark/baselines.h"
#include "benchmark/contact/card_house.h"
#include "benchmark/contact/piles.h"
#include "benchmark/contact/processor_time.h"
#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double sample_time = 0.02;  // s
constexpr double max_seconds = 5.0;   // of processor time, for a row

BoxScene box_scene(const ContactTrial& trial) {
  BoxScene s{trial.scene, trial.settings.grasp.object, {}};
  if (s.held.empty()) return s;
  const auto held = scene::find_body(s.scene, s.held);
  const RigidTransform X_HO = trial.X_WH(0.0).inverse() * s.scene.bodies[*held].X_WO;
  s.X_WO = [X_WH = trial.X_WH, X_HO](double t) { return RigidTransform(X_WH(t) * X_HO); };
  return s;
}

struct Figures {
  double depth = 0.0, moved = 0.0, spent = 0.0, simulated = 0.0;  // m, m, s, s
  bool finite = true;
};

void look(const PairDepth& depth, const ContactTrial& trial, const std::vector<RigidTransform>& now, Figures& f) {
  for (std::size_t i = 0; i < now.size(); ++i) {
    const scene::Body& body = trial.scene.bodies[i];
    f.finite = f.finite && now[i].matrix().allFinite();
    if (body.name == trial.settings.grasp.object) continue;
    f.moved = std::max(f.moved, (now[i].translation() - body.X_WO.translation()).norm());
  }
  if (f.finite) f.depth = std::max(f.depth, depth.deepest(now).depth);
}

Figures run_engine(const BoxEngine& engine, const ContactTrial& trial, double step) {
  const BoxScene scene = box_scene(trial);
  const PairDepth depth(trial.scene);
  const std::unique_ptr<BoxWorld> world = engine.make(scene, step);
  Figures f;
  const int a_sample = std::max(1, static_cast<int>(sample_time / step + 0.5));
  const double h = sample_time / a_sample;
  for (int i = 0; i * h < trial.duration - 1e-9 && f.finite && f.spent < max_seconds; ++i) {
    const double begin = processor_time();
    world->step(i * h, h);
    f.spent += processor_time() - begin;
    f.simulated = (i + 1) * h;
    if ((i + 1) % std::max(1, a_sample / 4) == 0) look(depth, trial, world->poses(), f);
  }
  return f;
}

Figures run_ours(const ContactTrial& trial) {
  ContactTrial limited = trial;
  limited.max_seconds = max_seconds;
  TrialRun run(limited);
  Figures f;
  const PairDepth depth(trial.scene);
  for (bool more = true; more;) {
    more = run.advance();
    look(depth, trial, run.poses(), f);
  }
  const Measured m = run.measured();
  f.depth = std::max(f.depth, m.deepest.depth);
  f.finite = m.finite;
  f.simulated = run.time();
  f.spent = m.cpu_mean * f.simulated / sample_time;
  return f;
}

void print(const ContactTrial& trial, const std::string& engine, double step, const Figures& f) {
  const bool to_the_end = f.simulated > trial.duration - sample_time;
  std::cout << trial.trial << ",\"" << trial.name << "\",\"" << engine << "\"," << 1e3 * step << ',' << f.finite << ','
            << to_the_end << ',' << 1e3 * f.depth << ',' << 1e3 * f.moved << ','
            << 1e3 * f.spent * sample_time / std::max(f.simulated, 1e-9) << std::endl;
}

void compare(bool quick) {
  std::cout << "trial,case,engine,step_ms,finite,to_the_end,depth_mm,moved_mm,cpu_ms_per_20_ms\n";
  std::vector<ContactTrial> trials{pushed_pile(2, 2, 0.02)};
  if (!quick) {
    trials.push_back(pushed_pile(3, 3, 0.02));
    trials.push_back(pushed_pile(5, 4, 0.02));
    for (const double ratio : {1.0, 1e3, 1e6}) trials.push_back(standing_stack(ratio, 1.0));
    trials.push_back(card_house(false, 1.0));
  }
  const Baselines baselines = all_baselines();
  const std::vector<double> steps =
      quick ? std::vector<double>{0.005} : std::vector<double>{0.02, 0.005, 0.001, 0.0002};
  for (const ContactTrial& trial : trials) {
    print(trial, "ours", trial.settings.dynamics.step, run_ours(trial));
    for (const BoxEngine& engine : baselines.boxes) {
      for (const double step : steps) print(trial, engine.name, step, run_engine(engine, trial, step));
    }
  }
}

}  // namespace
}  // namespace spring_workbench::benchmark

int main(int argc, char** argv) {
  const std::string argument = argc > 1 ? argv[1] : "";
  if (argc > 2 || (argc == 2 && argument != "quick")) {
    std::cerr << "contact_engines: arguments: none, or quick\n";
    return 2;
  }
  try {
    spring_workbench::benchmark::compare(argument == "quick");
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "contact_engines: " << error.what() << '\n';
    return 1;
  }
}
