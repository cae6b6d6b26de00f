#include "benchmark/contact/trials.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include "benchmark/contact/bodies.h"
#include "benchmark/contact/card_house.h"
#include "benchmark/contact/drops.h"
#include "benchmark/contact/exact_motions.h"
#include "benchmark/contact/marbles.h"
#include "benchmark/contact/pegs.h"
#include "benchmark/contact/piles.h"
#include "benchmark/contact/rings.h"
#include "benchmark/contact/same_bits.h"
#include "benchmark/contact/scale.h"
#include "benchmark/contact/shown.h"
#include "benchmark/contact/stress_motions.h"
#include "benchmark/contact/throws.h"
#include "benchmark/contact/wedge.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::benchmark {
namespace {

constexpr const char* where = "command line";

int count_at(const std::vector<std::string>& arguments, std::size_t index, int otherwise) {
  if (index >= arguments.size()) return otherwise;
  const std::string& text = arguments[index];
  const bool digits = !text.empty() && text.size() < 9 &&
                      std::all_of(text.begin(), text.end(), [](unsigned char c) { return c >= '0' && c <= '9'; });
  if (!digits) validation::refuse(where, "argument", text, "a whole number");
  return std::stoi(text);
}

void run_stress(int motions, int first_seed, const std::vector<StressScene>& scenes,
                const std::vector<scene::ContactMode>& modes, double damping_ratio, std::ostream& out) {
  out << "contact,scene,damping_ratio,motions,passed_through,over_0.1mm,penetration_mm,worst_seed,steps_blocked,"
         "time_lost_s,rejected,cpu_s_per_motion\n";
  for (const scene::ContactMode mode : modes) {
    for (const StressScene scene : scenes) {
      StressResult sum;
      int passed = 0, over = 0, worst_seed = first_seed;
      for (int seed = first_seed; seed < first_seed + motions; ++seed) {
        const StressResult r = run({scene, mode, static_cast<unsigned>(seed), damping_ratio});
        if (r.penetration > sum.penetration) worst_seed = seed;
        sum.penetration = std::max(sum.penetration, r.penetration);
        passed += r.passed_through ? 1 : 0;
        over += r.penetration > 1e-4 ? 1 : 0;
        sum.steps_blocked += r.steps_blocked;
        sum.time_lost += r.time_lost;
        sum.rejected += r.rejected;
        sum.seconds += r.seconds;
      }
      out << name_of(mode) << ',' << name_of(scene) << ',' << damping_ratio << ',' << motions << ',' << passed << ','
          << over << ',' << 1e3 * sum.penetration << ',' << worst_seed << ',' << sum.steps_blocked << ','
          << sum.time_lost << ',' << sum.rejected << ',' << sum.seconds / std::max(motions, 1) << std::endl;
    }
  }
}

/// The lines of a file written by `record`, by seed; empty if there is no file. Ignores a truncated last line.
std::map<int, std::string> recorded(const std::string& path, const std::string& run) {
  std::map<int, std::string> lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line) && !file.eof();) {
    if (line.compare(0, run.size(), run) == 0) lines[std::stoi(line.substr(run.size()))] = line;
  }
  return lines;
}

/// Runs the seeds that are not in the file yet, and appends a line for each as it finishes.
void record(const std::string& path, const StressMotion& motion, int first, int last, std::ostream& out) {
  std::ostringstream name;
  name << name_of(motion.contact) << ',' << name_of(motion.scene) << ',' << motion.damping_ratio << ',';
  const std::string run_name = name.str();
  const std::map<int, std::string> done = recorded(path, run_name);
  std::ofstream file(path, std::ios::app);
  if (!file)
    validation::refuse(where, "file", path,
                       std::string("a file that can be written to (") + std::strerror(errno) + ')');
  file << '\n';  // after a line that was cut off
  for (int seed = first; seed <= last; ++seed) {
    if (done.count(seed) > 0) continue;
    const StressResult r = run({motion.scene, motion.contact, static_cast<unsigned>(seed), motion.damping_ratio});
    file << run_name << seed << ',' << 1e3 * r.penetration << ',' << r.passed_through << ',' << r.steps_blocked << ','
         << r.time_lost << ',' << r.rejected << ',' << r.seconds << std::endl;
  }
  int count = 0, passed = 0, over = 0, blocked = 0, rejected = 0, worst_seed = first;
  double worst = 0.0, lost = 0.0, seconds = 0.0, max_seconds = 0.0;
  for (const auto& [seed, line] : recorded(path, run_name)) {
    if (seed < first || seed > last) continue;
    std::istringstream fields(line.substr(run_name.size()));
    double values[7] = {};
    for (double& value : values) {
      fields >> value;
      fields.ignore();
    }
    ++count;
    passed += values[2] > 0.0;
    over += values[1] > 0.1;
    blocked += static_cast<int>(values[3]);
    lost += values[4];
    rejected += static_cast<int>(values[5]);
    seconds += values[6];
    max_seconds = std::max(max_seconds, values[6]);
    if (values[1] > worst) worst = values[1], worst_seed = seed;
  }
  out << "contact,scene,damping_ratio,motions,passed_through,over_0.1mm,penetration_mm,worst_seed,steps_blocked,"
         "time_lost_s,rejected,cpu_s_per_motion,most_cpu_s\n"
      << run_name << count << ',' << passed << ',' << over << ',' << worst << ',' << worst_seed << ',' << blocked << ','
      << lost << ',' << rejected << ',' << seconds / std::max(count, 1) << ',' << max_seconds << std::endl;
}

std::vector<StressScene> scenes_at(const std::vector<std::string>& arguments, std::size_t index) {
  if (index >= arguments.size()) return stress_scenes();
  for (const StressScene scene : stress_scenes()) {
    if (name_of(scene) == arguments[index]) return {scene};
  }
  validation::refuse(where, "scene", arguments[index], "rod_in_room or ring_on_rod");
}

std::vector<scene::ContactMode> modes_at(const std::vector<std::string>& arguments, std::size_t index) {
  const std::vector<scene::ContactMode> both{scene::ContactMode::stop, scene::ContactMode::dynamic};
  if (index >= arguments.size()) return both;
  for (const scene::ContactMode mode : both) {
    if (name_of(mode) == arguments[index]) return {mode};
  }
  validation::refuse(where, "contact", arguments[index], "stop or dynamic");
}

double damping_ratio_at(const std::vector<std::string>& arguments, std::size_t index) {
  if (index >= arguments.size()) return 1.0;
  std::istringstream text(arguments[index]);
  double value = -1.0;
  if (!(text >> value) || !text.eof() || value < 0.0 || value > 10.0)
    validation::refuse(where, "damping ratio", arguments[index], "a number from 0 to 10");
  return value;
}

void run_scale(int most, std::ostream& out) {
  out << "contact,objects,start_ms,memory_MB,step_us\n";
  for (const scene::ContactMode mode :
       {scene::ContactMode::none, scene::ContactMode::stop, scene::ContactMode::dynamic}) {
    for (int objects = 10; objects <= most; objects *= 10) {
      const ScaleRow row = measure_scale(mode, objects);
      out << name_of(mode) << ',' << objects << ',' << 1e3 * row.start << ',' << row.memory / 1e6 << ','
          << 1e6 * row.step << std::endl;
    }
  }
}

/// Trials without seeds, complete or quick.
const std::map<std::string, void (*)(bool quick, const TakeRow& take)>& trials() {
  static const std::map<std::string, void (*)(bool, const TakeRow&)> all{
      {"pile", run_piles},      {"stack", run_stacks},     {"cards", run_card_houses},
      {"marbles", run_marbles}, {"peg", run_pegs},         {"wedge", run_wedges},
      {"motion", run_motions},  {"incline", run_inclines}, {"bits", run_same_bits}};
  return all;
}

/// Trials for the seeds first … first + count − 1.
const std::map<std::string, void (*)(int count, int first, const TakeRow& take)>& seeded_trials() {
  static const std::map<std::string, void (*)(int, int, const TakeRow&)> all{{"rings", run_rings},
                                                                             {"chain", run_chains}};
  return all;
}

/// The trial called `name` for display.
ContactTrial shown_trial(const std::string& name) {
  const std::map<std::string, std::function<ContactTrial()>> all{
      {"pile", [] { return pushed_pile(5, 4, 0.02); }},
      {"stack", [] { return standing_stack(1e3, 60.0); }},
      {"cards", [] { return card_house(false, 10.0); }},
      {"drawn_card", [] { return card_house(true, 2.5); }},
      {"marbles", [] { return tilted_marbles(1000, 5.0); }},
      {"rings", [] { return rings_on_peg(0); }},
      {"chain", [] { return swung_chain(0); }},
      {"peg", [] { return peg_in_hole(true, scene::ContactMode::dynamic); }},
      {"wedge", [] { return driven_wedge(0.3); }}};
  const auto found = all.find(name);
  if (found == all.end()) validation::refuse(where, "trial", name, "a trial that can be shown");
  return found->second();
}

}  // namespace

void run_contact_trials(const std::vector<std::string>& arguments, std::ostream& out) {
  const std::string what = arguments.empty() ? "" : arguments[0];
  const bool quick = arguments.size() == 2 && arguments[1] == "quick";
  const TakeRow to_out = [&](const TrialRow& row) { print(row, out); };
  if (trials().count(what) > 0 && (arguments.size() == 1 || quick)) {
    print_trial_header(out);
    return trials().at(what)(quick, to_out);
  }
  if (what == "show" && arguments.size() == 3) {
    return show(shown_trial(arguments[1]), 1e-3 * count_at(arguments, 2, 0), out);
  }
  if (seeded_trials().count(what) > 0 && arguments.size() <= 3) {
    print_trial_header(out);
    return seeded_trials().at(what)(count_at(arguments, 1, 100), count_at(arguments, 2, 0), to_out);
  }
  if (what == "stress" && arguments.size() <= 6) {
    run_stress(count_at(arguments, 1, 100), count_at(arguments, 2, 0), scenes_at(arguments, 3), modes_at(arguments, 4),
               damping_ratio_at(arguments, 5), out);
  } else if (what == "record" && (arguments.size() == 6 || arguments.size() == 7)) {
    record(arguments[1],
           {scenes_at(arguments, 2).front(), modes_at(arguments, 3).front(), 0, damping_ratio_at(arguments, 6)},
           count_at(arguments, 4, 0), count_at(arguments, 5, 0), out);
  } else if (what == "drops" && arguments.size() <= 3) {
    run_drops(count_at(arguments, 1, 100), count_at(arguments, 2, 0), out);
  } else if (what == "throws" && arguments.size() <= 3) {
    run_throws(count_at(arguments, 1, 100), count_at(arguments, 2, 0), out);
  } else if (what == "scale" && arguments.size() <= 2) {
    run_scale(count_at(arguments, 1, 10000), out);
  } else {
    validation::refuse(
        where, "arguments", what,
        "stress [N [FIRST_SEED [SCENE [CONTACT [DAMPING]]]]], record FILE SCENE CONTACT FIRST_SEED LAST_SEED "
        "[DAMPING], "
        "drops [N [FIRST_SEED]], throws [N [FIRST_SEED]], scale [MOST], "
        "pile|stack|cards|marbles|peg|wedge|motion|incline|bits [quick], rings|chain [N [FIRST_SEED]], or show "
        "TRIAL MILLISECONDS");
  }
}

}  // namespace spring_workbench::benchmark
