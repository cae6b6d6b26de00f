#include <algorithm>
#include <iostream>
#include <string>

#include "options.h"
#include "run.h"
#include "spring_workbench/config/input_error.h"

namespace {

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace spring_workbench;
  try {
    const assembly_trials::Options options = assembly_trials::parse_options(argc, argv);
    if (options.help) {
      std::cout << assembly_trials::help_text();
    } else {
      assembly_trials::run(options);
    }
    return 0;
  } catch (const InputError& e) {
    std::cerr << "assembly_trials: " << one_line(e.what()) << std::endl;
    return 2;
  } catch (const std::exception& e) {
    std::cerr << "assembly_trials: failed: " << one_line(e.what()) << std::endl;
    return 1;
  }
}
