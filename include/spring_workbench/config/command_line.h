#pragma once

#include <getopt.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include "spring_workbench/config/yaml_fields.h"

namespace spring_workbench::config {

const char* const command_line = "command line";  ///< where its values come from, in messages

/// An option `--name VALUE` of a program, or `--name` alone where `argument` is no_argument.
struct CommandOption {
  std::string name;
  std::function<void(const std::string& value)> take;
  int argument = required_argument;
};

// Options that set a variable, which must live until the command line is read; the last one given counts.
CommandOption text_option(const std::string& name, std::string& value);
CommandOption number_option(const std::string& name, const validation::NumberRule& rule, double& value);
CommandOption integer_option(const std::string& name, int min, int max, int& value);

/// Reads the options in the order in which they are given. Returns false at `--help`, after which nothing is read.
/// Throws InputError for an option that is not among `options`, one without its value, and an argument that is none.
bool read_command_line(int argc, char** argv, const std::vector<CommandOption>& options);

/// A whole program: `run(*options)`, or the help text where `parse()` gives none. Turns what it throws into one line
/// and an exit status: 0 done, 2 bad arguments or input, 1 failed.
template <typename Parse, typename Run>
int run_program(const std::string& name, const std::string& help, Parse&& parse, Run&& run) {
  const auto end = [&](std::string line, int status) {
    std::replace(line.begin(), line.end(), '\n', ' ');
    std::cerr << name << ": " << line << std::endl;
    return status;
  };
  try {
    if (const auto options = parse()) {
      run(*options);
    } else {
      std::cout << help;
    }
    return 0;
  } catch (const validation::InputError& e) {
    return end(e.what(), 2);
  } catch (const std::exception& e) {
    return end(std::string("failed: ") + e.what(), 1);
  }
}

}  // namespace spring_workbench::config
