#include <iostream>

#include "benchmark/report/options.h"
#include "benchmark/report/recording.h"
#include "benchmark/report/report.h"
#include "benchmark/report/run_facts.h"
#include "spring_workbench/config/command_line.h"

/// Measures error against run time and the stability map, or does so for a recording of the user (report_help()).
int main(int argc, char** argv) {
  using namespace spring_workbench;
  return config::run_program(
      "report", benchmark::report_help(), [&] { return benchmark::parse_report_options(argc, argv); },
      [&](const benchmark::ReportOptions& options) {
        const auto make = options.of_recording() ? benchmark::report_recording : benchmark::make_report;
        make(options, benchmark::command_of(argc, argv), std::cout, std::cerr);
      });
}
