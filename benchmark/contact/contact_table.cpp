#include "benchmark/contact/contact_table.h"

#include <cstring>
#include <sstream>

#include "spring_workbench/validation/run_in_child.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double time_limit = 10.0;  // s, for the runs of a curve of the drag table

std::vector<DragMethod> all_drags(const std::vector<DragMethod>& baselines) {
  std::vector<DragMethod> all = our_drags();
  all.insert(all.end(), baselines.begin(), baselines.end());
  return all;
}

/// A method on the scene as it is, or on a box that cannot turn.
struct Line {
  const DragMethod* method;
  bool turns;
};
std::vector<Line> lines_of(const std::vector<DragMethod>& methods) {
  std::vector<Line> lines;
  for (const DragMethod& method : methods) {
    lines.push_back({&method, true});
    if (method.can_lock_turning) lines.push_back({&method, false});
  }
  return lines;
}

std::vector<double> factors(bool quick) {
  return quick ? std::vector<double>{1.0} : std::vector<double>{1.0, 100.0, 1e4};
}

std::vector<double> steps() { return {1.0 / 50.0, 1.0 / 100.0, 1.0 / 250.0, 1.0 / 1000.0}; }

DragRow isolated_drag(const DragMethod& method, const DragScene& scene, double step, int runs) {
  DragRow failed;
  failed.method = method.name;
  failed.stiffness_factor = scene.stiffness_factor;
  failed.turns = scene.turns;
  failed.step = step;
  constexpr std::size_t numbers = 6;
  const auto data = validation::run_in_child(
      [&] {
        const DragRow row = run_drag(method, scene, step, runs);
        const double values[numbers] = {
            row.finite ? 1.0 : 0.0, row.lag, row.lag_error, row.penetration, row.cpu_us_per_simulated_second,
            row.cpu_us_per_step};
        return std::string(reinterpret_cast<const char*>(values), sizeof values);
      },
      {time_limit});
  double values[numbers] = {};
  if (!data || data->size() != sizeof values) return failed;
  std::memcpy(values, data->data(), sizeof values);
  DragRow row = failed;
  row.finite = values[0] > 0.0;
  row.lag = values[1];
  row.lag_error = values[2];
  row.penetration = values[3];
  row.cpu_us_per_simulated_second = values[4];
  row.cpu_us_per_step = values[5];
  return row;
}

}  // namespace

std::size_t contact_unit_count(const std::vector<DragMethod>& baselines, bool quick) {
  return lines_of(all_drags(baselines)).size() * factors(quick).size() * steps().size() + 3;
}

ContactTable measure_contact(const std::vector<DragMethod>& baselines, bool quick, Units& units) {
  units.begin("contact");
  ContactTable table;
  const std::vector<DragMethod> methods = all_drags(baselines);
  std::size_t number = 0;
  for (const double factor : factors(quick)) {  // a stiffness belongs to one shard, and its methods take turns
    for (const double step : steps()) {
      for (const Line& line : lines_of(methods)) {
        DragScene scene;
        scene.stiffness_factor = factor;
        scene.turns = line.turns;
        std::ostringstream name;
        name << "drag × " << factor << (line.turns ? ", " : ", cannot turn, ") << step << " s, " << line.method->name;
        const auto rows = units.rows<DragRow>(
            number, name.str(), [&] { return std::vector{isolated_drag(*line.method, scene, step, quick ? 1 : 3)}; });
        table.drags.insert(table.drags.end(), rows.begin(), rows.end());
      }
    }
    ++number;
  }
  table.impacts = units.rows<ImpactRow>(number++, "search for the pose of contact",
                                        [&] { return measure_impact_search(quick ? 60 : 500); });
  table.motion_steps =
      units.rows<MotionStepRow>(number++, "steps of motions in contact", [&] { return measure_motion_steps(quick); });
  table.costs =
      units.rows<ContactCost>(number++, "cost of the parts of contact", [] { return measure_contact_costs(); });
  return table;
}

std::string drags_csv(const std::vector<DragRow>& rows) {
  std::ostringstream out;
  out << "method,stiffness_factor,box,step,finite,lag_mm,lag_error_percent,penetration_mm,cpu_us_per_simulated_second,"
         "cpu_us_per_step\n";
  for (const DragRow& row : rows) {
    out << row.method << ',' << row.stiffness_factor << ',' << (row.turns ? "turns" : "cannot turn") << ',' << row.step
        << ',' << row.finite << ',';
    if (row.finite) {
      out << 1e3 * row.lag << ',' << 100.0 * row.lag_error << ',' << 1e3 * row.penetration << ','
          << row.cpu_us_per_simulated_second << ',' << row.cpu_us_per_step << '\n';
    } else {
      out << ",,,,\n";
    }
  }
  return out.str();
}

std::string impacts_csv(const std::vector<ImpactRow>& rows) {
  std::ostringstream out;
  out << "pair,search,levels,mean_error_um,largest_error_um,through,cpu_us\n";
  for (const ImpactRow& row : rows) {
    out << row.pair << ',' << (row.levels == 0 ? "time of impact" : "bisection") << ',' << row.levels << ','
        << 1e6 * row.mean_error << ',' << 1e6 * row.largest_error << ',' << row.through << ',' << row.cpu_us << '\n';
  }
  return out.str();
}

std::string motion_steps_csv(const std::vector<MotionStepRow>& rows) {
  std::ostringstream out;
  out << "scene,against,step,error_mm,error_percent_of_way,cpu_us_per_simulated_second\n";
  for (const MotionStepRow& row : rows) {
    out << '"' << row.scene << "\"," << row.against << ',' << row.step << ',' << 1e3 * row.error << ','
        << 100.0 * row.error_share << ',' << row.cpu_us_per_simulated_second << '\n';
  }
  return out.str();
}

std::string contact_costs_csv(const std::vector<ContactCost>& costs) {
  std::ostringstream out;
  out << "contact,part,ns\n";
  for (const ContactCost& cost : costs) {
    out << cost.contact << ",\"" << cost.part << "\"," << static_cast<long>(cost.nanoseconds + 0.5) << '\n';
  }
  return out.str();
}

}  // namespace spring_workbench::benchmark
