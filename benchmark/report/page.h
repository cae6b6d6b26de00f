#pragma once

#include <string>
#include <vector>

#include "benchmark/report/run_facts.h"

namespace spring_workbench::benchmark {

/// A part of the page.
struct PageSection {
  struct Table {
    std::string title;
    std::string csv;      ///< header line first
    bool folded = false;  ///< opens on a click
  };
  struct Figure {
    std::string path;  ///< of a PNG file; empty: none
    std::string caption;
  };
  std::string title;
  std::string text;
  std::vector<Figure> figures;
  std::vector<Table> tables;
};

/// What the page shows.
struct PageContents {
  std::vector<RunFact> facts;
  std::string warning;  ///< empty: none
  std::vector<PageSection> sections;
};

/// One HTML page that needs no other file.
std::string html_page(const PageContents& contents);

}  // namespace spring_workbench::benchmark
