#pragma once

#include <string>
#include <vector>

#include "benchmark/error_table.h"
#include "benchmark/report/run_facts.h"

namespace spring_workbench::benchmark {

/// What the page shows.
struct PageContents {
  std::vector<RunFact> facts;
  std::vector<std::string> pictures;  ///< paths of PNG files, in their order
  std::vector<ErrorRow> errors;
  std::string error_csv;      ///< without header lines
  std::string stability_csv;  ///< empty: not measured
};

/// One HTML page that needs no other file: the facts, the pictures, the run time that each method needs for an error,
/// and the tables in full.
std::string html_page(const PageContents& contents);

/// For each scene and stiffness (columns) and method (rows) the least run time [µs per simulated second] of a setting
/// whose error is at most `error` of the hand's amplitude, as CSV; "-" where there is none.
std::string run_time_for_error_csv(const std::vector<ErrorRow>& errors, double error);

/// RFC 4648.
std::string base64(const std::string& bytes);

}  // namespace spring_workbench::benchmark
