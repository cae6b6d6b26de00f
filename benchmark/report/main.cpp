// report [--quick] [--out DIR] [--commit NAME]
// report [--quick] --shard I/N [--queue DIR] [--commit NAME] > PART
// report [--out DIR] --merge PART...
// report [--quick] [--out DIR] --scene SCENE (--bag FILE | --motion FILE...) [--settings FILE] [--commit NAME]
//
// Measures error against run time of our integrators, shape models and the peers that were found, and the stability
// map; writes CSV, pictures, one page and a table of verdicts. Or does so for a recording of the user.
#include <iostream>

#include "benchmark/report/options.h"
#include "benchmark/report/recording.h"
#include "benchmark/report/report.h"
#include "benchmark/report/run_facts.h"
#include "spring_workbench/validation/input_error.h"

int main(int argc, char** argv) {
  using namespace spring_workbench;
  try {
    const benchmark::ReportOptions options = benchmark::parse_report_options(argc, argv);
    const auto make = options.of_recording() ? benchmark::report_recording : benchmark::make_report;
    make(options, benchmark::command_of(argc, argv), std::cout, std::cerr);
    return 0;
  } catch (const validation::InputError& error) {
    std::cerr << "report: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "report: " << error.what() << '\n';
    return 1;
  }
}
