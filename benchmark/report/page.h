#pragma once

#include <string>
#include <vector>

#include "benchmark/report/run_facts.h"

namespace spring_workbench::benchmark {

/// A section of the page.
struct PageSection {
  struct Table {
    std::string title;
    std::string csv;      ///< with a header line
    bool folded = false;  ///< whether the table opens on a click
  };
  struct Figure {
    std::string path;  ///< path of a PNG file; empty: none
    std::string caption;
  };
  std::string title;
  std::string text;
  std::vector<Figure> figures;
  std::vector<Table> tables;
};

/// Contents of the page.
struct PageContents {
  std::vector<RunFact> facts;
  std::string warning;  ///< empty: none
  std::vector<PageSection> sections;
};

/// A self-contained HTML page.
std::string html_page(const PageContents& contents);

}  // namespace spring_workbench::benchmark
