#include <iomanip>
#include <ostream>
#include <sstream>

#include "benchmark/error_table.h"

namespace spring_workbench::benchmark {
namespace {

constexpr const char* kHeader =
    "scene,stiffness_factor,mass,shape,method,ours,hand,step,tolerance,own_reference,reference_uncertainty,hand_error,"
    "largest_deflection,error,position_error,error_between,angle_error,error_over_hand_amplitude,error_over_largest_"
    "deflection,"
    "wall_us_per_simulated_second,steps_per_second,error_over_tolerance,model_error,finite,steps_fallback,given_up,"
    "other_round_wall_us";

}  // namespace

void write_rows(const std::vector<ErrorRow>& rows, std::ostream& out) {
  out << kHeader << '\n' << std::setprecision(6);
  for (const ErrorRow& row : rows) {
    out << row.scene << ',' << row.stiffness_factor << ',' << row.mass << ',' << row.shape << ',' << row.method << ','
        << row.ours << ',' << row.hand << ',';
    if (row.step > 0.0) out << row.step;
    out << ',';
    if (row.tolerance > 0.0) out << row.tolerance;
    out << ',' << row.own_reference << ',' << row.reference_uncertainty << ',' << row.hand_error << ','
        << row.largest_deflection << ',';
    if (row.finite) {
      out << row.error << ',' << row.position_error << ',' << row.error_between << ',' << row.angle_error << ','
          << row.error_over_hand_amplitude << ',' << row.error_over_largest_deflection << ','
          << row.wall_us_per_simulated_second << ',' << row.steps_per_second << ',';
      if (row.error_over_tolerance > 0.0) out << row.error_over_tolerance;
      out << ',';
      if (row.own_reference) out << row.model_error;
    } else {
      out << ",,,,,,";
      if (row.given_up) out << row.wall_us_per_simulated_second;
      out << ",,,";
    }
    out << ',' << row.finite << ',' << row.steps_fallback << ',' << row.given_up << ',';
    if (row.other_wall_us > 0.0) out << row.other_wall_us;
    out << '\n';
  }
}

std::string as_csv(const std::vector<ErrorRow>& rows) {
  std::ostringstream out;
  write_rows(rows, out);
  return out.str();
}

}  // namespace spring_workbench::benchmark
