#include "benchmark/report/page.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

namespace spring_workbench::benchmark {
namespace {

constexpr const char* kHead =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Error against run time</title>\n<style>\n"
    "body { font-family: sans-serif; margin: 2em auto; max-width: 80em; }\n"
    "table { border-collapse: collapse; font-size: 85%; }\n"
    "th, td { border: 1px solid #ccc; padding: 0.15em 0.5em; text-align: right; }\n"
    "th:first-child, td:first-child { text-align: left; }\n"
    "img { max-width: 100%; }\n"
    "</style></head><body>\n";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else {
      out += c;
    }
  }
  return out;
}

void add_table(const std::string& csv, std::ostream& out) {
  out << "<table>\n";
  std::istringstream lines(csv);
  const char* cell = "th";
  for (std::string line; std::getline(lines, line); cell = "td") {
    out << "<tr>";
    std::istringstream cells(line + ',');
    for (std::string text; std::getline(cells, text, ',');) {
      out << '<' << cell << '>' << escaped(text) << "</" << cell << '>';
    }
    out << "</tr>\n";
  }
  out << "</table>\n";
}

std::string file_contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

std::string column_of(const ErrorRow& row) {
  std::ostringstream name;
  name << row.scene << " × " << row.stiffness_factor;
  return name.str();
}

template <typename T>
void add_new(const T& value, std::vector<T>& values) {
  if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
}

}  // namespace

std::string run_time_for_error_csv(const std::vector<ErrorRow>& errors, double error) {
  std::vector<std::string> columns, methods;
  std::map<std::pair<std::string, std::string>, double> least;
  for (const ErrorRow& row : errors) {
    add_new(column_of(row), columns);
    add_new(row.method, methods);
    if (!row.finite || row.error_over_hand_amplitude > error) continue;
    const auto [place, added] = least.try_emplace({row.method, column_of(row)}, row.wall_us_per_simulated_second);
    if (!added) place->second = std::min(place->second, row.wall_us_per_simulated_second);
  }
  std::ostringstream csv;
  csv << "method";
  for (const std::string& column : columns) csv << ',' << column;
  csv << '\n';
  for (const std::string& method : methods) {
    csv << method;
    for (const std::string& column : columns) {
      const auto found = least.find({method, column});
      csv << ',';
      if (found == least.end()) {
        csv << '-';
      } else {
        csv << std::lround(found->second);
      }
    }
    csv << '\n';
  }
  return csv.str();
}

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      group = group << 8 | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    }
    for (std::size_t j = 0; j < 4; ++j) out += j <= count ? digits[group >> (18 - 6 * j) & 63U] : '=';
  }
  return out;
}

std::string html_page(const PageContents& contents) {
  std::ostringstream out;
  out << kHead << "<h1>Error against run time</h1>\n";
  out << "<p>Scenes A (stretch), B (torsion) and C (six coordinates): a held body on a spring on a moving hand; times "
         "a "
         "factor on the stiffness. Every method at every step or tolerance: its largest error over the hand's "
         "amplitude, "
         "and the run time of its stepping loop.</p>\n<ul>\n";
  for (const RunFact& fact : contents.facts) {
    out << "<li>" << escaped(fact.name) << ": " << escaped(fact.value) << "</li>\n";
  }
  out << "</ul>\n";
  for (const std::string& picture : contents.pictures) {
    out << "<p><img alt=\"error against run time\" src=\"data:image/png;base64," << base64(file_contents(picture))
        << "\"></p>\n";
  }
  for (const double error : {1e-3, 1e-6, 1e-9}) {
    out << "<h2>µs per simulated second for an error of " << error << " of the hand's amplitude</h2>\n";
    add_table(run_time_for_error_csv(contents.errors, error), out);
  }
  if (!contents.stability_csv.empty()) {
    out << "<h2>Cases of stiffness × mass × step that stay finite and bounded</h2>\n";
    add_table(contents.stability_csv, out);
  }
  out << "<details><summary>All runs</summary>\n";
  add_table(contents.error_csv, out);
  out << "</details>\n</body></html>\n";
  return out.str();
}

}  // namespace spring_workbench::benchmark
