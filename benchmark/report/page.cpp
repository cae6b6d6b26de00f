#include "benchmark/report/page.h"

#include <sstream>

#include "benchmark/report/html.h"

namespace spring_workbench::benchmark {
namespace {

constexpr const char* kHead =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Error against run time</title>\n<style>\n"
    "body { font-family: sans-serif; margin: 2em auto; max-width: 90em; padding: 0 1em; }\n"
    "table { border-collapse: collapse; font-size: 85%; }\n"
    "th, td { border: 1px solid #ccc; padding: 0.15em 0.5em; text-align: right; }\n"
    "th:first-child, td:first-child { text-align: left; }\n"
    "figure { margin: 1em 0; } figcaption { color: #555; font-size: 90%; } img { max-width: 100%; }\n"
    ".held { background: #d8f0d8; } .failed { background: #f6d0d0; font-weight: bold; }\n"
    ".warning { background: #fff0c0; border: 1px solid #d0b040; padding: 0.5em 1em; }\n"
    "</style></head><body>\n";

void add_section(const PageSection& section, std::ostream& out) {
  out << "<h2>" << escaped(section.title) << "</h2>\n<p>" << escaped(section.text) << "</p>\n";
  for (const PageSection::Figure& figure : section.figures) add_picture(figure.path, figure.caption, out);
  for (const PageSection::Table& table : section.tables) {
    if (table.folded) {
      add_folded_table(table.title, table.csv, out);
    } else {
      if (!table.title.empty()) out << "<h3>" << escaped(table.title) << "</h3>\n";
      add_table(table.csv, out);
    }
  }
}

}  // namespace

std::string html_page(const PageContents& contents) {
  std::ostringstream out;
  out << kHead << "<h1>Error against run time, and stability</h1>\n";
  if (!contents.warning.empty()) out << "<p class=\"warning\">" << escaped(contents.warning) << "</p>\n";
  out << "<ul>\n";
  for (const RunFact& fact : contents.facts) {
    out << "<li>" << escaped(fact.name) << ": " << escaped(fact.value) << "</li>\n";
  }
  out << "</ul>\n";
  for (const PageSection& section : contents.sections) add_section(section, out);
  out << "</body></html>\n";
  return out.str();
}

}  // namespace spring_workbench::benchmark
