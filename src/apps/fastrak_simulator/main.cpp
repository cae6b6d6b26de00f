#include <csignal>
#include <iostream>

#include "options.h"
#include "run.h"
#include "spring_workbench/config/input_error.h"

namespace {

volatile std::sig_atomic_t interrupted = 0;

}  // namespace

int main(int argc, char** argv) {
  using namespace spring_workbench;
  try {
    const fastrak_simulator::Options options = fastrak_simulator::parse_options(argc, argv);
    if (options.help) {
      std::cout << fastrak_simulator::help_text();
      return 0;
    }
    std::signal(SIGINT, [](int) { interrupted = 1; });
    std::signal(SIGTERM, [](int) { interrupted = 1; });
    fastrak_simulator::run(options, [] { return interrupted != 0; });
    return 0;
  } catch (const InputError& e) {
    std::cerr << "fastrak_simulator: " << e.what() << std::endl;
    return 2;
  } catch (const std::exception& e) {
    std::cerr << "fastrak_simulator: failed: " << e.what() << std::endl;
    return 1;
  }
}
