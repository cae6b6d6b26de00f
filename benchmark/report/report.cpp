#include "benchmark/report/report.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <stdexcept>
#include <utility>

#include "benchmark/baselines.h"
#include "benchmark/checks.h"
#include "benchmark/our_methods.h"
#include "benchmark/report/page.h"
#include "benchmark/report/parts.h"
#include "benchmark/report/sections.h"
#include "benchmark/report/tables.h"
#include "benchmark/rod_table.h"
#include "benchmark/units.h"

namespace spring_workbench::benchmark {
namespace {

std::string write_file(const std::string& folder, const std::string& name, const std::string& contents) {
  const std::string path = std::filesystem::path(folder) / name;
  std::ofstream file(path, std::ios::binary);
  file << contents;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path);
  return path;
}

void print(const std::vector<Check>& checks, std::ostream& out) {
  for (const Check& v : checks) {
    out << std::left << std::setw(9) << name_of(v.result) << ' ' << v.claim << "\n          target: " << v.target
        << "\n          measured: " << v.measured << '\n';
  }
}

/// Everything to be measured.
struct Plan {
  explicit Plan(bool quick)
      : scenes(error_table_plan(quick)),
        rods(rod_table_plan(quick, SPRING_WORKBENCH_REFERENCE_FOLDER)),
        map(stability_plan(quick)) {}
  ErrorTablePlan scenes;
  RodTablePlan rods;
  StabilityPlan map;
};

std::size_t units_of(const Plan& plan, const std::vector<const Method*>& methods, const std::vector<DragMethod>& drags,
                     bool quick) {
  std::size_t counts = 0;
  for (const Method* method : methods) counts += has_stability_counts(*method) ? 2 : 0;
  return unit_count(plan.scenes) + unit_count(plan.rods) + unit_count(plan.map) + (quick ? 0 : counts) +
         contact_unit_count(drags, quick) + limit_case_unit_count() + map_unit_count(quick) + 4;
}

Measurements measure(const Plan& plan, const std::vector<const Method*>& methods, const Baselines& baselines,
                     bool quick, Units& units) {
  Measurements measured;
  measured.quick = quick;
  units.begin("steps");
  measured.step_costs = units.rows<StepCost>(0, "parts of a step", [] { return step_costs(); });
  measured.scenes = error_table(methods, plan.scenes, units);
  measured.rods = rod_table(plan.rods, baselines.rods, units);
  measured.contact = measure_contact(baselines.drags, quick, units);
  if (!quick) measured.stability_counts = stability_table(methods, units);
  measured.map = stability_map(plan.map, units);
  measured.limit_cases = limit_cases_table(quick, units);
  measured.contact_map = contact_map(quick, units);
  units.begin("shapes and steps");
  measured.elastica = units.rows<ElasticaRow>(0, "elastica", [] { return elastica_table(); });
  keep_least(units.rows<StepCost>(1, "parts of a step, timed again", [] { return step_costs(); }), measured.step_costs);
  measured.fork_curves = units.rows<ForkCurveRow>(2, "curves of the fork", [] { return measure_fork_curves(); });
  measured.unit_times = units.times();
  return measured;
}

/// Writes tables, pictures and the page. `measuring`: time taken by the shards or by this process so far; `begun`:
/// start of the work of this process that is not included in that [s].
void write_report(Measurements measured, const RunTime& measuring, const RunTime& begun, PageContents page,
                  const std::string& folder, std::ostream& out, std::ostream& log) {
  const std::string header = as_csv_header(page.facts);
  Tables tables;
  const auto keep = [&](const std::string& name, const std::string& csv) {
    return write_file(folder, name, header + csv);
  };
  tables.scenes = keep("error_table.csv", as_csv(measured.scenes));
  tables.rods = keep("rod_table.csv", as_csv(measured.rods));
  tables.elastica = keep("elastica.csv", elastica_csv(measured.elastica));
  tables.map = keep("stability_map.csv", stability_csv(measured.map));
  tables.limit_cases = keep("contact_limit_cases.csv", limit_cases_csv(measured.limit_cases));
  tables.contact_map = keep("contact_map.csv", contact_map_csv(measured.contact_map));
  keep("stability_failures.csv", failures_csv(measured.map));
  if (!measured.quick) keep("stability_counts.csv", stability_counts_csv(measured.stability_counts));
  keep("step_cost.csv", step_cost_csv(measured.step_costs));
  keep("fork_curve.csv", fork_curves_csv(measured.fork_curves));
  tables.drags = keep("contact_drag.csv", drags_csv(measured.contact.drags));
  tables.impacts = keep("contact_impact.csv", impacts_csv(measured.contact.impacts));
  tables.motion_steps = keep("contact_steps.csv", motion_steps_csv(measured.contact.motion_steps));
  keep("contact_costs.csv", contact_costs_csv(measured.contact.costs));
  keep("report_times.csv", unit_times_csv(measured.unit_times));
  page.sections = page_sections(measured, elastica_check(SPRING_WORKBENCH_REFERENCE_FOLDER), tables, folder);
  const RunTime now = run_time_now();
  measured.seconds = measuring.ended - measuring.begun + now.ended - begun.ended;
  measured.processor_seconds = measuring.processor + now.processor - begun.processor;
  const std::vector<Check> judged = checks(measured);
  keep("checks.csv", checks_csv(judged));
  page.sections.insert(page.sections.begin(), checks_section(judged));
  const std::string path = write_file(folder, "report.html", html_page(page));
  print(judged, out);
  log << "wrote " << path << '\n';
}

}  // namespace

void make_report(const ReportOptions& options, const std::string& command, std::ostream& out, std::ostream& log) {
  const RunTime begun = run_time_now();
  const bool merging = !options.parts.empty();
  ReportPart part;
  if (merging) part = read_parts(options.parts);
  if (!options.shard) make_folder(options.out);
  const bool quick = merging ? part.quick : options.quick;
  const Shard shard = options.shard.value_or(Shard{});
  const std::vector<MethodPtr> ours = our_methods();
  const Baselines baselines = all_baselines();
  std::vector<const Method*> methods;
  for (const MethodPtr& method : ours) methods.push_back(method.get());
  for (const MethodPtr& method : baselines.methods) methods.push_back(method.get());
  const Plan plan(quick);
  if (!merging) {
    part.shard = shard;
    part.quick = quick;
    part.facts = run_facts(command, options.commit, baselines);
    part.warning = load_warning();
  }
  log << as_csv_header(part.facts);
  if (!part.warning.empty()) log << "report: " << part.warning << '\n';

  Progress progress(log, isatty(STDERR_FILENO) != 0, units_of(plan, methods, baselines.drags, quick));
  Units units = merging ? Units(progress, std::move(part.rows)) : Units(progress, shard, options.queue);
  Measurements measured = measure(plan, methods, baselines, quick, units);
  progress.finish();
  if (merging && !units.kept().empty()) {
    validation::refuse("shards", "unit", units.kept().begin()->first,
                       "a unit of this report: same build, same baselines, same recordings");
  }
  if (!merging) {
    part.time = run_time_now();
    part.time.begun = begun.ended;
  }
  if (options.shard) {
    part.rows = units.kept();
    write_part(part, out);
    return;
  }
  write_report(std::move(measured), part.time, merging ? begun : part.time, {part.facts, part.warning, {}}, options.out,
               out, log);
}

}  // namespace spring_workbench::benchmark
