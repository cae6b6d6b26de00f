#include <iostream>
#include <string>
#include <vector>

#include "cadence_table.h"
#include "filter_table.h"
#include "prediction_table.h"
#include "spring_workbench/validation/number_rule.h"

/// Writes the tables of doc/tracker.md as CSV to standard output.
int main(int argc, char** argv) {
  using namespace spring_workbench;
  const std::vector<std::string> words(argv + 1, argv + argc);
  const std::string table = words.empty() ? "" : words.front();
  try {
    if (words.size() >= 2 && table == "filter") {
      write_filter_table({words.begin() + 1, words.end()}, std::cout);
    } else if (words.size() >= 2 && table == "cadence") {
      write_cadence_table({words.begin() + 1, words.end()}, std::cout);
    } else if (words.size() >= 3 && table == "prediction") {
      write_prediction_table(words[1], {words.begin() + 2, words.end()}, std::cout);
    } else {
      validation::refuse("tracker_report", "arguments",
                         "filter or cadence, and one motion or more, or prediction, a scene and one motion or more");
    }
    return 0;
  } catch (const validation::InputError& e) {
    std::cerr << e.what() << std::endl;
    return 2;
  }
}
