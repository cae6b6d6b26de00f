#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "benchmark/report/options.h"
#include "benchmark/rod_reference.h"

namespace spring_workbench::benchmark {

/// A run of a recording by `replay`, all that is in it: hands, buttons, contact.
struct RecordingRow {
  std::string integrator;
  double step = 0.0;         ///< largest [s]
  double error = 0.0;        ///< largest distance of an object from where it is in the reference [m]
  double angle_error = 0.0;  ///< the same of its attitude [rad]
  double wall_us_per_simulated_second = 0.0;
  long steps = 0, steps_fallback = 0, steps_blocked = 0, steps_rejected = 0;
};

/// Error against run time of a recording of the user's own: every integrator at some steps beside the default one at a
/// step of 0.25 ms; how good that is itself tells `uncertainty`: the distance from the same at 0.5 ms [m].
struct RecordingTable {
  std::vector<RecordingRow> rows;
  double uncertainty = 0.0;
};

/// Poses of the objects as `replay` writes them, by line: time, object, x y z, qx qy qz qw.
struct ReplayedPose {
  double t = 0.0;
  std::string object;
  RigidTransform X = RigidTransform::Identity();
};
/// Throws std::runtime_error for what is no such table.
std::vector<ReplayedPose> read_replayed(const std::string& path);

/// The number behind `"key": ` in the line of JSON that `replay` ends with; throws std::runtime_error where there is
/// none.
double number_in_json(const std::string& json, const std::string& key);

/// Runs `replay`, which stands beside this program, as often as it takes, writing into `options.out`. Throws
/// std::runtime_error where a run fails, with what it said.
RecordingTable measure_recording(const ReportOptions& options, std::ostream& log);

std::string recording_csv(const RecordingTable& table);

/// Tables, picture and a line for each row on `out`.
void report_recording(const ReportOptions& options, const std::string& command, std::ostream& out, std::ostream& log);

}  // namespace spring_workbench::benchmark
