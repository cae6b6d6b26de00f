// peers_table [--quick] [--stability] [--out FILE.csv]: error against run time of the peers on scenes A, B and C, or in
// how many cases they stay finite and bounded.
#include <fstream>
#include <iostream>

#include "benchmark/error_table.h"
#include "benchmark/peers.h"
#include "benchmark/stability_table.h"

namespace {

using namespace spring_workbench::benchmark;

int usage(const std::string& what) {
  std::cerr << "peers_table: " << what << "; usage: peers_table [--quick] [--stability] [--out FILE.csv]\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  bool quick = false, stability = false;
  std::string file;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--quick") {
      quick = true;
    } else if (argument == "--stability") {
      stability = true;
    } else if (argument == "--out" && i + 1 < argc) {
      file = argv[++i];
    } else {
      return usage("argument " + argument + " is not allowed");
    }
  }
  std::ofstream out;
  if (!file.empty()) {
    out.open(file);
    if (!out) return usage("cannot write " + file);
  }
  const Peers peers = all_peers();
  for (const std::string& name : peers.found) std::cerr << "found " << name << '\n';
  for (const std::string& name : peers.not_found) std::cerr << "not found: " << name << '\n';
  std::vector<const Method*> methods;
  for (const MethodPtr& method : peers.methods) methods.push_back(method.get());
  std::ostream& table = file.empty() ? std::cout : out;
  if (stability) {
    write_stability_table(methods, table, std::cerr);
  } else {
    write_error_table(methods, error_table_plan(quick), table, std::cerr);
  }
  return 0;
}
