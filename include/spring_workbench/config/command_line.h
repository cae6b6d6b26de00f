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

const char* const command_line = "command line";  ///< origin of the values, for error messages

/// An option `--name VALUE` of a program, or `--name` alone if `argument` is no_argument.
struct CommandOption {
  std::string name;
  std::function<void(const std::string& value)> take;
  int argument = required_argument;
};

// Options that set a variable, which must outlive the reading of the command line. If an option is given twice, the
// last value counts.
CommandOption text_option(const std::string& name, std::string& value);
CommandOption number_option(const std::string& name, const validation::NumberRule& rule, double& value);
CommandOption integer_option(const std::string& name, int min, int max, int& value);

/// Reads the options in the order in which they are given. Returns false at `--help` or `-h`, and ignores the rest.
/// Throws InputError for an unknown option, a missing value, or an argument that is not an option.
bool read_command_line(int argc, char** argv, const std::vector<CommandOption>& options);

/// For the main() of a ROS node, which has no options: if one of the arguments is `--help` or `-h`, prints what the
/// node is and where its parameters are described, and returns true.
bool print_node_help(int argc, char** argv, const std::string& name, const std::string& what);

/// Body of main(): calls `run(*options)`, or prints the help text if `parse()` returns nothing. Prints an exception as
/// one line on stderr. Returns the exit status: 0 success, 1 failure, 2 bad arguments or input.
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
