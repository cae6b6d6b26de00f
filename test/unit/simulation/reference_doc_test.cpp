#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "spring_workbench/simulation/settings.h"
#include "support/paths.h"

namespace spring_workbench::simulation::reference_doc_test {
namespace {

const std::string begin_marker = "<!-- settings: begin -->\n";
const std::string end_marker = "<!-- settings: end -->\n";

std::string whole_file(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// What stands between the two markers; empty where they are not both there.
std::string block_between_markers(const std::string& text) {
  const std::size_t begin = text.find(begin_marker);
  const std::size_t end = text.find(end_marker);
  if (begin == std::string::npos || end == std::string::npos) return "";
  const std::size_t first = begin + begin_marker.size();
  return end < first ? "" : text.substr(first, end - first);
}

/// The table of doc/reference.md. No cell of it may hold a character that ends a cell.
std::string settings_table() {
  std::ostringstream table;
  table << "| key | unit | allowed | default | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const SettingDescription& d : setting_descriptions()) {
    for (const std::string* cell : {&d.key, &d.unit, &d.allowed, &d.default_value, &d.meaning}) {
      EXPECT_EQ(cell->find_first_of("|\n"), std::string::npos) << d.key << ": " << *cell;
    }
    table << "| `" << d.key << "` | " << d.unit << " | " << d.allowed << " | " << d.default_value << " | " << d.meaning
          << " |\n";
  }
  return table.str();
}

TEST(ReferenceDoc, SettingsAreThoseOfTheCode) {
  const std::string text = whole_file(test_support::checkout("doc/reference.md"));
  ASSERT_NE(text, "") << "doc/reference.md cannot be read";
  const std::string right = settings_table();
  EXPECT_TRUE(block_between_markers(text) == right) << "put this between the settings markers of doc/reference.md:\n"
                                                    << begin_marker << right << end_marker;
}

}  // namespace
}  // namespace spring_workbench::simulation::reference_doc_test
