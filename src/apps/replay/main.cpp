#include <algorithm>
#include <iostream>
#include <string>

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
    const replay::Options options = replay::parse_options(argc, argv);
    if (options.help) {
      std::cout << replay::help_text();
    } else {
      std::cout << replay::run(options).json() << std::endl;
    }
    return 0;
  } catch (const InputError& e) {
    std::cerr << "replay: " << one_line(e.what()) << std::endl;
    return 2;
  } catch (const std::exception& e) {
    std::cerr << "replay: failed: " << one_line(e.what()) << std::endl;
    return 1;
  }
}
