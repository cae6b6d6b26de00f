#include "spring_workbench/config/command_line.h"

#include "spring_workbench/validation/one_line.h"

namespace spring_workbench::config {

CommandOption text_option(const std::string& name, std::string& value) {
  return {name, [&value](const std::string& text) { value = text; }};
}

CommandOption number_option(const std::string& name, const validation::NumberRule& rule, double& value) {
  return {name, [=, &value](const std::string& text) {
            value = read_number(YAML::Node(text), command_line, "--" + name, rule);
          }};
}

CommandOption integer_option(const std::string& name, int min, int max, int& value) {
  return {name, [=, &value](const std::string& text) {
            value = read_integer(YAML::Node(text), command_line, "--" + name, min, max);
          }};
}

bool read_command_line(int argc, char** argv, const std::vector<CommandOption>& options) {
  std::vector<option> known{{"help", no_argument, nullptr, 0}};
  for (const CommandOption& o : options) known.push_back({o.name.c_str(), o.argument, nullptr, 0});
  known.push_back({});
  opterr = 0;
  int found = 0;
  for (int code; (code = getopt_long(argc, argv, ":h", known.data(), &found)) != -1;) {
    const std::string word = optind > 0 && optind <= argc ? argv[optind - 1] : "";
    if (code == 'h') return false;
    if (code == ':') validation::refuse(command_line, word, "a value");
    if (code != 0) {
      throw validation::InputError(std::string(command_line) + ": " + validation::one_line(word) +
                                   ": unknown option; --help lists all options");
    }
    if (found == 0) return false;
    options[static_cast<std::size_t>(found - 1)].take(optarg != nullptr ? optarg : "");
  }
  if (optind < argc) {
    throw validation::InputError(std::string(command_line) + ": " + validation::one_line(argv[optind]) +
                                 ": unexpected argument; --help lists all options");
  }
  return true;
}

bool print_node_help(int argc, char** argv, const std::string& name, const std::string& what) {
  if (std::none_of(argv + 1, argv + argc, [](const std::string& a) { return a == "--help" || a == "-h"; }))
    return false;
  std::cout
      << name << ": " << what << "\nA ROS node without options. doc/reference.md describes its parameters, topics "
      << "and services; the files in launch\nset the parameters, e.g. roslaunch spring_workbench workbench.launch.\n";
  return true;
}

}  // namespace spring_workbench::config
