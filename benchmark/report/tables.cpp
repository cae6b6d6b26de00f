#include "benchmark/report/tables.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace spring_workbench::benchmark {
namespace {

constexpr double kOnePerSample = 0.02;  // s
constexpr const char* kLargestBends = "heavy_large_bend";

template <typename T>
void add_new(const T& value, std::vector<T>& values) {
  if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
}

template <typename T>
std::string text(const T& value) {
  std::ostringstream out;
  out.precision(3);
  out << value;
  return out.str();
}

bool one_per_sample(const ErrorRow& row) { return std::abs(row.step - kOnePerSample) < 1e-9; }

}  // namespace

std::string run_time_for_error_csv(const std::vector<ErrorRow>& rows, double error, ErrorMeasure measure) {
  std::vector<std::string> columns, lines;
  for (const ErrorRow& row : rows) {
    add_new(title_of(row), columns);
    add_new(row.method, lines);
  }
  std::ostringstream csv;
  csv << "method";
  for (const std::string& column : columns) csv << ",\"" << column << '"';
  for (const std::string& line : lines) {
    csv << '\n' << line;
    for (const std::string& column : columns) {
      const auto wanted = [&](const ErrorRow& row) { return row.method == line && title_of(row) == column; };
      const auto time = run_time_for_error(curve(rows, wanted, measure), error);
      csv << ',' << (time ? text(*time) : "-");
    }
  }
  csv << '\n';
  return csv.str();
}

std::string one_step_per_sample_csv(const std::vector<ErrorRow>& rods, const std::string& shape) {
  std::vector<std::string> cases, methods;
  for (const ErrorRow& row : rods) {
    if (row.shape != shape || !one_per_sample(row)) continue;
    add_new(row.scene, cases);
    add_new(row.method, methods);
  }
  std::ostringstream csv;
  csv << "case";
  for (const std::string& method : methods) csv << ',' << method;
  for (const std::string& name : cases) {
    csv << '\n' << name;
    for (const std::string& method : methods) {
      for (const ErrorRow& row : rods) {
        if (row.scene != name || row.method != method || row.shape != shape || !one_per_sample(row)) continue;
        csv << ",\""
            << (row.finite ? text(row.position_error) + " m, " + text(row.angle_error) + " rad (" +
                                 text(row.error_over_largest_deflection) + "), " +
                                 (row.own_reference ? "model error " + text(row.model_error) + " m, " : "") +
                                 text(row.wall_us_per_simulated_second) + " µs/s"
                           : "fails")
            << '"';
      }
    }
  }
  csv << '\n';
  return csv.str();
}

std::string shapes_csv(const std::vector<ElasticaRow>& elastica, const std::vector<ErrorRow>& rods) {
  std::vector<std::string> shapes;
  std::vector<double> loads;
  for (const ElasticaRow& row : elastica) {
    add_new(row.shape, shapes);
    add_new(row.alpha, loads);
  }
  std::ostringstream csv;
  csv << "shape";
  for (const double load : loads) csv << ",model: tip error / L at P L²/EI = " << text(load);
  csv << ",evaluation [ns],integration: error / largest deflection,run time [µs/s]";
  for (const std::string& shape : shapes) {
    csv << '\n' << shape;
    for (const ElasticaRow& row : elastica) {
      if (row.shape == shape) csv << ',' << text(row.tip_error);
    }
    csv << ',' << text(std::round(evaluation_cost(shape)));
    const auto found = std::find_if(rods.begin(), rods.end(), [&](const ErrorRow& row) {
      return row.scene == kLargestBends && row.shape == shape && row.method == "exponential" && one_per_sample(row);
    });
    if (found == rods.end() || !found->finite) {
      csv << ",-,-";
    } else {
      csv << ',' << text(found->error_over_largest_deflection) << ',' << text(found->wall_us_per_simulated_second);
    }
  }
  csv << '\n';
  return csv.str();
}

std::string step_cost_csv(const std::vector<StepCost>& costs) {
  const auto column = [](const StepCost& cost) { return cost.shape + " (" + std::to_string(cost.coordinates) + ')'; };
  std::vector<std::string> columns, parts;
  for (const StepCost& cost : costs) {
    add_new(column(cost), columns);
    add_new(cost.part, parts);
  }
  std::ostringstream csv;
  csv << "part";
  for (const std::string& name : columns) csv << ',' << name;
  for (const std::string& part : parts) {
    csv << "\n\"" << part << '"';
    for (const std::string& name : columns) {
      const auto found = std::find_if(costs.begin(), costs.end(),
                                      [&](const StepCost& cost) { return cost.part == part && column(cost) == name; });
      csv << ',' << (found == costs.end() ? "-" : text(std::round(found->nanoseconds)));
    }
  }
  csv << '\n';
  return csv.str();
}

std::string map_summary_csv(const StabilityMap& map) {
  std::vector<StabilityRow> sums;
  for (const StabilityRow& row : map.rows) {
    if (sums.empty() || sums.back().integrator != row.integrator || sums.back().shape != row.shape) {
      sums.push_back({row.integrator, row.shape});
    }
    add(row, sums.back());
  }
  std::ostringstream csv;
  csv << "integrator,shape,cells,finite,bounded,energy judged,energy kept,growing by at most 1e-9 without allowing for "
         "the estimates,no step rejected,all of these,of those "
         "without shorter steps and stops and fallback,cells whose hand turns to the end (reach and energy not judged),"
         "faster than real time,below three times that,steps,substeps,stops,steps_fallback,cells that cannot fail\n";
  for (const StabilityRow& sum : sums) {
    csv << sum.integrator << ',' << sum.shape << ',' << sum.cells << ',' << sum.finite << ',' << sum.bounded << ','
        << sum.energy_judged << ',' << sum.energy_kept << ',' << sum.within_rounding << ',' << sum.none_rejected << ','
        << sum.held << ',' << sum.on_its_own << ',' << sum.turning << ',' << sum.real_time << ',' << sum.three_times
        << ',' << sum.steps << ',' << sum.substeps << ',' << sum.stops << ',' << sum.fallback << ',' << sum.cannot_fail
        << '\n';
  }
  return csv.str();
}

std::string unit_times_csv(const std::vector<UnitTime>& times) {
  std::ostringstream csv;
  csv << "part,unit,processor_s\n";
  for (const UnitTime& time : times) csv << time.part << ",\"" << time.unit << "\"," << text(time.processor) << '\n';
  return csv.str();
}

std::string times_by_part_csv(const std::vector<UnitTime>& times) {
  std::vector<std::string> parts;
  for (const UnitTime& time : times) add_new(time.part, parts);
  std::ostringstream csv;
  csv << "part,units,processor time [s],of the longest unit [s]\n";
  for (const std::string& part : parts) {
    int units = 0;
    double sum = 0.0, longest = 0.0;
    for (const UnitTime& time : times) {
      if (time.part != part) continue;
      ++units;
      sum += time.processor;
      longest = std::max(longest, time.processor);
    }
    csv << part << ',' << units << ',' << text(sum) << ',' << text(longest) << '\n';
  }
  return csv.str();
}

}  // namespace spring_workbench::benchmark
