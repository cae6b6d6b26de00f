#include <csignal>
#include <iostream>

#include "../common/program.h"
#include "options.h"
#include "run.h"

namespace {

volatile std::sig_atomic_t interrupted = 0;

}  // namespace

int main(int argc, char** argv) {
  using namespace spring_workbench;
  return run_program("fastrak_simulator", [&] {
    const fastrak_simulator::Options options = fastrak_simulator::parse_options(argc, argv);
    if (options.help) {
      std::cout << fastrak_simulator::help_text();
      return;
    }
    std::signal(SIGINT, [](int) { interrupted = 1; });
    std::signal(SIGTERM, [](int) { interrupted = 1; });
    fastrak_simulator::run(options, [] { return interrupted != 0; });
  });
}
