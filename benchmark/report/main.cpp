// report [--quick] [--out DIR]: error against run time of our integrators and of the peers that were found, and in how
// many cases they stay finite and bounded, as CSV, pictures and one page.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "benchmark/error_table.h"
#include "benchmark/our_methods.h"
#include "benchmark/peers.h"
#include "benchmark/report/options.h"
#include "benchmark/report/page.h"
#include "benchmark/report/pictures.h"
#include "benchmark/stability_table.h"
#include "spring_workbench/config/input_error.h"

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

void run(const ReportOptions& options, int argc, char** argv) {
  const std::vector<MethodPtr> ours = our_methods();
  const Peers peers = all_peers();
  std::vector<const Method*> methods;
  for (const MethodPtr& method : ours) methods.push_back(method.get());
  for (const MethodPtr& method : peers.methods) methods.push_back(method.get());

  PageContents page;
  page.facts = run_facts(argc, argv, peers);
  const std::string header = as_csv_header(page.facts);
  std::cerr << header;

  std::ostringstream errors;
  page.errors = write_error_table(methods, error_table_plan(options.quick), errors, std::cerr);
  page.error_csv = errors.str();
  const std::string csv = write_file(options.out, "error_table.csv", header + page.error_csv);
  page.pictures = draw_pictures(csv, page.errors, options.out);
  if (!options.quick) {
    std::ostringstream stability;
    write_stability_table(methods, stability, std::cerr);
    page.stability_csv = stability.str();
    write_file(options.out, "stability.csv", header + page.stability_csv);
  }
  std::cerr << "wrote " << write_file(options.out, "report.html", html_page(page)) << '\n';
}

}  // namespace
}  // namespace spring_workbench::benchmark

int main(int argc, char** argv) {
  using namespace spring_workbench;
  try {
    benchmark::run(benchmark::parse_report_options(argc, argv), argc, argv);
    return 0;
  } catch (const InputError& error) {
    std::cerr << "report: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "report: " << error.what() << '\n';
    return 1;
  }
}
