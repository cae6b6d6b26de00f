#include "benchmark/report/recording.h"

#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "benchmark/report/pictures.h"
#include "benchmark/report/run_facts.h"
#include "spring_workbench/dynamics/settings.h"
#include "spring_workbench/math/so3.h"
#include "spring_workbench/validation/input_error.h"
#include "spring_workbench/validation/names.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kReferenceStep = 2.5e-4;  // s
constexpr const char* kReference = "exponential";

std::string shell_word(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + '\'';
}

/// Throws what `replay` printed last as our own message; `status`: its exit status.
[[noreturn]] void throw_last_line(std::string output, int status) {
  while (!output.empty() && output.back() == '\n') output.pop_back();
  std::string line = output.substr(output.rfind('\n') + 1);
  const std::string name = "replay: ";
  if (line.rfind(name, 0) == 0) line.erase(0, name.size());
  if (status == 2) throw validation::InputError(line);
  throw std::runtime_error("replay: " + line);
}

/// Folders that are made, and removed again if they are empty when it ends.
class OutputFolder {
 public:
  explicit OutputFolder(const std::filesystem::path& path) {
    for (std::filesystem::path p = path; !p.empty() && !std::filesystem::exists(p); p = p.parent_path())
      made_.push_back(p);
    make_folder(path);
  }
  ~OutputFolder() {
    std::error_code not_empty;
    for (const std::filesystem::path& path : made_) std::filesystem::remove(path, not_empty);
  }
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  std::vector<std::filesystem::path> made_;  ///< the innermost first
};

/// Output files and text of one run of replay.
struct Replayed {
  std::vector<ReplayedPose> poses;
  std::string json;
};

class Replay {
 public:
  explicit Replay(const ReportOptions& options) : csv_(std::filesystem::path(options.out) / "recording_run.csv") {
    const std::filesystem::path beside = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "replay";
    command_ = shell_word(beside) + " --scene " + shell_word(options.scene);
    for (const std::string& motion : options.motions) command_ += " --motion " + shell_word(motion);
    if (!options.bag.empty()) command_ += " --hand-only --bag " + shell_word(options.bag);
    if (!options.settings.empty()) command_ += " --settings " + shell_word(options.settings);
    command_ += " --out " + shell_word(csv_);
  }

  Replayed run(const std::string& integrator, double step) const {
    std::ostringstream command;
    command << command_ << " --set integrator=" << integrator << " --set step=" << step << " --set tolerance=0 2>&1";
    FILE* pipe = popen(command.str().c_str(), "r");
    if (pipe == nullptr) throw std::runtime_error("cannot run replay");
    std::string output;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
    const int status = pclose(pipe);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
      throw_last_line(output, WIFEXITED(status) ? WEXITSTATUS(status) : 1);
    Replayed replayed{read_replayed(csv_), output};
    std::filesystem::remove(csv_);
    std::filesystem::remove(std::filesystem::path(csv_).replace_extension(".fork.csv"));
    return replayed;
  }

 private:
  std::string csv_, command_;
};

PoseDistance largest_distance(const std::vector<ReplayedPose>& a, const std::vector<ReplayedPose>& b) {
  if (a.size() != b.size()) throw std::runtime_error("two runs of replay have not as many lines");
  PoseDistance largest;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].object != b[i].object) throw std::runtime_error("two runs of replay are not of the same objects");
    largest.position = std::max(largest.position, (a[i].X.translation() - b[i].X.translation()).norm());
    largest.angle = std::max(largest.angle, math::log_so3(a[i].X.linear().transpose() * b[i].X.linear()).norm());
  }
  return largest;
}

}  // namespace

std::vector<ReplayedPose> read_replayed(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line.rfind("t,object,x,y,z,qx,qy,qz,qw", 0) != 0) {
    throw std::runtime_error(path + ": not a table of replay");
  }
  std::vector<ReplayedPose> poses;
  while (std::getline(file, line)) {
    std::istringstream in(line);
    std::string cell;
    std::vector<std::string> cells;
    while (cells.size() < 9 && std::getline(in, cell, ',')) cells.push_back(cell);
    if (cells.size() < 9) throw std::runtime_error(path + ": a line with too few cells: " + line);
    const auto number = [&](std::size_t i) { return std::stod(cells[i]); };
    poses.push_back({number(0), cells[1],
                     make_transform({number(2), number(3), number(4)},
                                    Quaterniond(number(8), number(5), number(6), number(7)).normalized())});
  }
  return poses;
}

double number_in_json(const std::string& json, const std::string& key) {
  const std::size_t at = json.rfind('"' + key + "\": ");
  if (at == std::string::npos) throw std::runtime_error("replay has not told " + key + ": " + json);
  return std::stod(json.substr(at + key.size() + 4));
}

RecordingTable measure_recording(const ReportOptions& options, std::ostream& log) {
  const Replay replay(options);
  const std::string warning = load_warning();
  const Replayed reference = replay.run(kReference, kReferenceStep);  // before any other line: it may be refused
  if (!warning.empty()) log << "report: " << warning << '\n';
  log << "reference: " << kReference << ", step " << kReferenceStep << " s\n";
  RecordingTable table;
  table.uncertainty = largest_distance(replay.run(kReference, 2.0 * kReferenceStep).poses, reference.poses).position;
  const std::vector<double> steps =
      options.quick ? std::vector<double>{0.02, 0.005} : std::vector<double>{0.02, 0.01, 0.005, 0.002, 0.001};
  for (const std::string& integrator : validation::names<dynamics::IntegratorKind>()) {
    for (const double step : steps) {
      log << integrator << ", step " << step << " s\n";
      const Replayed run = replay.run(integrator, step);
      const PoseDistance distance = largest_distance(run.poses, reference.poses);
      const auto field = [&](const char* key) { return number_in_json(run.json, key); };
      table.rows.push_back({integrator, step, distance.position, distance.angle,
                            1e6 * field("wall_time") / field("simulated_time"), std::lround(field("steps")),
                            std::lround(field("steps_fallback")), std::lround(field("steps_blocked")),
                            std::lround(field("steps_rejected"))});
    }
  }
  return table;
}

std::string recording_csv(const RecordingTable& table) {
  std::ostringstream out;
  out << "integrator,step,error,angle_error,wall_us_per_simulated_second,steps,steps_fallback,steps_blocked,"
         "steps_rejected,reference_uncertainty\n";
  for (const RecordingRow& row : table.rows) {
    out << row.integrator << ',' << row.step << ',' << row.error << ',' << row.angle_error << ','
        << row.wall_us_per_simulated_second << ',' << row.steps << ',' << row.steps_fallback << ',' << row.steps_blocked
        << ',' << row.steps_rejected << ',' << table.uncertainty << '\n';
  }
  return out.str();
}

void report_recording(const ReportOptions& options, const std::string& command, std::ostream& out, std::ostream& log) {
  const OutputFolder folder(options.out);
  const RecordingTable table = measure_recording(options, log);
  const std::string path = std::filesystem::path(options.out) / "recording.csv", csv = recording_csv(table);
  std::ofstream file(path);
  file << as_csv_header(run_facts(command, options.commit, {})) << csv;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path);
  out << csv;
  const std::string picture =
      draw({"recording", path, "recording.png", {}, "Error against run time of a recording"}, options.out);
  log << "wrote " << path << (picture.empty() ? "" : " and " + picture) << '\n';
}

}  // namespace spring_workbench::benchmark
