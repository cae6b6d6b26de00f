#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "benchmark/contact/trials.h"
#include "spring_workbench/validation/input_error.h"

int main(int argc, char** argv) {
  try {
    spring_workbench::benchmark::run_contact_trials(std::vector<std::string>(argv + 1, argv + argc), std::cout);
    return 0;
  } catch (const spring_workbench::validation::InputError& error) {
    std::cerr << "contact_trials: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "contact_trials: " << error.what() << '\n';
    return 1;
  }
}
