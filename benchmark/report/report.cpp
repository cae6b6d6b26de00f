#include "benchmark/report/report.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "benchmark/our_methods.h"
#include "benchmark/peers.h"
#include "benchmark/report/page.h"
#include "benchmark/report/pictures.h"
#include "benchmark/report/sections.h"
#include "benchmark/report/tables.h"
#include "benchmark/rod_table.h"
#include "benchmark/verdicts.h"

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

std::string as_csv(const std::vector<ErrorRow>& rows) {
  std::ostringstream out;
  write_rows(rows, out);
  return out.str();
}

void print(const std::vector<Verdict>& verdicts, std::ostream& out) {
  for (const Verdict& v : verdicts) {
    out << std::left << std::setw(9) << name_of(v.result) << ' ' << v.claim << "\n          target: " << v.target
        << "\n          measured: " << v.measured << '\n';
  }
}

/// All that is to be measured.
struct Plan {
  explicit Plan(bool quick)
      : scenes(error_table_plan(quick)),
        rods(rod_table_plan(quick, SPRING_WORKBENCH_REFERENCE_FOLDER)),
        map(stability_plan(quick)) {}
  ErrorTablePlan scenes;
  RodTablePlan rods;
  StabilityPlan map;
};

std::size_t units(const Plan& plan, const std::vector<const Method*>& methods, const std::vector<DragMethod>& drags,
                  bool quick) {
  std::size_t counts = 0;
  for (const Method* method : methods) counts += has_stability_counts(*method) ? 2 : 0;
  return line_count(methods, plan.scenes) + line_count(plan.rods) + unit_count(plan.map) + (quick ? 0 : counts) +
         contact_unit_count(drags, quick);
}

}  // namespace

void make_report(const ReportOptions& options, const std::string& command, std::ostream& out, std::ostream& log) {
  const std::vector<MethodPtr> ours = our_methods();
  const Peers peers = all_peers();
  std::vector<const Method*> methods;
  for (const MethodPtr& method : ours) methods.push_back(method.get());
  for (const MethodPtr& method : peers.methods) methods.push_back(method.get());
  const Plan plan(options.quick);

  PageContents page;
  page.facts = run_facts(command, peers);
  page.warning = load_warning();
  const std::string header = as_csv_header(page.facts);
  log << header;
  if (!page.warning.empty()) log << "report: " << page.warning << '\n';

  Progress progress(log, isatty(STDERR_FILENO) != 0, units(plan, methods, peers.drags, options.quick));
  Measurements measured;
  measured.quick = options.quick;
  measured.scenes = error_table(methods, plan.scenes, progress);
  measured.rods = rod_table(plan.rods, progress);
  measured.elastica = elastica_table();
  measured.contact = measure_contact(peers.drags, options.quick, progress);
  if (!options.quick) measured.stability_counts = stability_table(methods, progress);
  measured.map = stability_map(plan.map, progress);
  measured.step_costs = step_costs();
  measured.fork_curves = measure_fork_curves();
  progress.finish();
  measured.seconds = progress.elapsed();
  const std::vector<Verdict> judged = verdicts(measured);

  Tables tables;
  const auto keep = [&](const std::string& name, const std::string& csv) {
    return write_file(options.out, name, header + csv);
  };
  tables.scenes = keep("error_table.csv", as_csv(measured.scenes));
  tables.rods = keep("rod_table.csv", as_csv(measured.rods));
  tables.elastica = keep("elastica.csv", elastica_csv(measured.elastica));
  tables.map = keep("stability_map.csv", stability_csv(measured.map));
  keep("stability_failures.csv", failures_csv(measured.map));
  keep("verdicts.csv", verdicts_csv(judged));
  if (!options.quick) keep("stability_counts.csv", stability_counts_csv(measured.stability_counts));
  keep("step_cost.csv", step_cost_csv(measured.step_costs));
  keep("fork_curve.csv", fork_curves_csv(measured.fork_curves));
  tables.drags = keep("contact_drag.csv", drags_csv(measured.contact.drags));
  tables.impacts = keep("contact_impact.csv", impacts_csv(measured.contact.impacts));
  tables.world_steps = keep("contact_steps.csv", world_steps_csv(measured.contact.world_steps));
  keep("contact_costs.csv", contact_costs_csv(measured.contact.costs));
  page.sections = page_sections(measured, judged, elastica_check(SPRING_WORKBENCH_REFERENCE_FOLDER), tables, options.out);
  const std::string path = write_file(options.out, "report.html", html_page(page));
  print(judged, out);
  log << "wrote " << path << '\n';
}

}  // namespace spring_workbench::benchmark
