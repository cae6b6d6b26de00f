#include <iostream>

#include "../common/program.h"
#include "run.h"

int main(int argc, char** argv) {
  using namespace spring_workbench;
  return run_program("replay", [&] {
    const replay::Options options = replay::parse_options(argc, argv);
    if (options.help) {
      std::cout << replay::help_text();
    } else {
      std::cout << replay::run(options).json() << std::endl;
    }
  });
}
