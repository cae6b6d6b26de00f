#pragma once

#include <optional>
#include <string>
#include <vector>

#include "benchmark/contact/contact_table.h"
#include "benchmark/contact/limit_cases_table.h"
#include "benchmark/contact/product_map.h"
#include "benchmark/elastica.h"
#include "benchmark/error_table.h"
#include "benchmark/fork_curve.h"
#include "benchmark/stability_map.h"
#include "benchmark/stability_table.h"
#include "benchmark/step_cost.h"

namespace spring_workbench::benchmark {

/// All measurements.
struct Measurements {
  std::vector<ErrorRow> scenes;  ///< A, B, C
  std::vector<ErrorRow> rods;
  std::vector<ElasticaRow> elastica;
  StabilityMap map;
  std::vector<StabilityCount> stability_counts;
  std::vector<StepCost> step_costs;
  std::vector<ForkCurveRow> fork_curves;
  ContactTable contact;
  std::vector<LimitCaseRow> limit_cases;  ///< limit cases of contact
  std::vector<MapRow> contact_map;
  std::vector<UnitTime> unit_times;
  double seconds = 0.0;            ///< duration of the report, from its start to the last picture
  double processor_seconds = 0.0;  ///< of all processes
  bool quick = false;
};

/// A claim, its requirement and the measured result.
struct Check {
  std::string claim;
  std::string target;
  std::string measured;
  enum class Result { pass, fail, not_measured } result = Result::not_measured;
  /// For run times that are judged, the ratio of the other's to ours, or a lower bound (see Pair::ratio()); the
  /// smallest one if they are compared at several errors.
  std::optional<double> ratio = {};
  std::string baseline = {};                   ///< the method of that ratio
  std::optional<double> error = {};            ///< the error at which it is compared, in the claim's measure; see Pair
  std::optional<double> within = {};           ///< SceneRows::ratio_within() the claim's error
  std::optional<double> left_by_samples = {};  ///< of the largest deflection, if it is known
};
std::string name_of(Check::Result result);

/// Evaluates the claims on accuracy, speed and stability from the measurements alone. Values between two settings of a
/// method are interpolated as in run_time_for_error().
std::vector<Check> checks(const Measurements& measured);

std::string checks_csv(const std::vector<Check>& checks);

}  // namespace spring_workbench::benchmark
