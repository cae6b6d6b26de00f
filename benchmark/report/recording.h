#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "benchmark/report/options.h"
#include "benchmark/rod_reference.h"

namespace spring_workbench::benchmark {

/// A run of a complete recording by `replay`: hands, buttons, contact.
struct RecordingRow {
  std::string integrator;
  double step = 0.0;         ///< largest [s]
  double error = 0.0;        ///< largest distance of an object from its position in the reference [m]
  double angle_error = 0.0;  ///< the same for its orientation [rad]
  double wall_us_per_simulated_second = 0.0;
  long steps = 0, steps_fallback = 0, steps_blocked = 0, steps_rejected = 0;
};

/// Error against run time for a recording of the user: every integrator at some steps, compared with the default one at
/// 0.25 ms, whose own `uncertainty` is its distance from the run at 0.5 ms [m].
struct RecordingTable {
  std::vector<RecordingRow> rows;
  double uncertainty = 0.0;
};

/// A row of the poses that `replay` writes: time, object, x y z, qx qy qz qw.
struct ReplayedPose {
  double t = 0.0;
  std::string object;
  RigidTransform X = RigidTransform::Identity();
};
/// Reads such a table. Throws std::runtime_error if the file is not one.
std::vector<ReplayedPose> read_replayed(const std::string& path);

/// The number after `"key": ` in the last line of `replay`, a line of JSON. Throws std::runtime_error if there is none.
double number_in_json(const std::string& json, const std::string& key);

/// Runs `replay` (next to this program) as often as necessary, with output in `options.out`. Throws std::runtime_error
/// with its error message if a run fails.
RecordingTable measure_recording(const ReportOptions& options, std::ostream& log);

std::string recording_csv(const RecordingTable& table);

/// Writes tables, a picture, and a line for each row on `out`.
void report_recording(const ReportOptions& options, const std::string& command, std::ostream& out, std::ostream& log);

}  // namespace spring_workbench::benchmark
