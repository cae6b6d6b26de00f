#include "benchmark/report/html.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

namespace spring_workbench::benchmark {
namespace {

/// Cells of a line of CSV.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
  return cells;
}

std::string opening(const std::string& tag, const std::string& text) {
  if (text == "PASS") return '<' + tag + " class=\"held\">";
  if (text == "FAIL") return '<' + tag + " class=\"failed\">";
  return '<' + tag + '>';
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
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

void add_table(const std::string& csv, std::ostream& out) {
  out << "<table>\n";
  std::istringstream lines(csv);
  std::string tag = "th";
  for (std::string line; std::getline(lines, line); tag = "td") {
    out << "<tr>";
    for (const std::string& text : cells_of(line)) out << opening(tag, text) << escaped(text) << "</" << tag << '>';
    out << "</tr>\n";
  }
  out << "</table>\n";
}

void add_folded_table(const std::string& title, const std::string& csv, std::ostream& out) {
  out << "<details><summary>" << escaped(title) << "</summary>\n";
  add_table(csv, out);
  out << "</details>\n";
}

void add_picture(const std::string& path, const std::string& caption, std::ostream& out) {
  if (path.empty()) return;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  out << "<figure><img alt=\"" << escaped(caption) << "\" src=\"data:image/png;base64," << base64(bytes.str())
      << "\"><figcaption>" << escaped(caption) << "</figcaption></figure>\n";
}

}  // namespace spring_workbench::benchmark
