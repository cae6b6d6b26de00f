#include <iostream>

#include "../common/program.h"
#include "options.h"
#include "run.h"

int main(int argc, char** argv) {
  using namespace spring_workbench;
  return run_program("assembly_trials", [&] {
    const assembly_trials::Options options = assembly_trials::parse_options(argc, argv);
    if (options.help) {
      std::cout << assembly_trials::help_text();
    } else {
      assembly_trials::run(options);
    }
  });
}
