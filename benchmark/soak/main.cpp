#include <iomanip>
#include <iostream>

#include "benchmark/soak/judge.h"
#include "benchmark/soak/soak.h"
#include "spring_workbench/config/yaml_fields.h"

namespace {

constexpr const char* kUse = "SCENE.urdf [STEPS [SETTINGS.yaml]]";
constexpr double kMemoryGrowth = 1.01;
constexpr double kEnergyGrowth = 2.0;
constexpr double kDrift = 1e-4;  // m

}  // namespace

/// soak: memory, energy and rest over many steps of a repeated assembly (doc/limits.md).
int main(int argc, char** argv) {
  using namespace spring_workbench;
  using benchmark::judge;
  try {
    benchmark::SoakOptions options;
    if (argc < 2 || argc > 4) validation::refuse("command line", "arguments", kUse);
    options.scene = argv[1];
    if (argc > 2)
      options.steps = config::read_integer(YAML::Node(std::string(argv[2])), "command line", "STEPS", 1, 2000000000);
    if (argc > 3) simulation::apply_settings(config::load_yaml_file(argv[3]), argv[3], options.settings);
    const benchmark::SoakResult r = benchmark::run_soak(options, std::cout);
    std::cout << "placed " << r.placed << " of " << r.targets << " in " << r.assemblies << " assemblies, " << r.rejected
              << " steps rejected\nhash " << std::hex << std::setfill('0') << std::setw(16) << r.hash << std::dec
              << '\n';
    return judge(r.finite, "everything is finite") |
           judge(r.drift < kDrift, "objects at rest stay within 0.1 mm in 10 s") |
           judge(r.largest_energy <= kEnergyGrowth * r.energy_early,
                 "energy stays within twice the most of the first tenth") |
           judge(r.memory_late <= kMemoryGrowth * r.memory_early, "resident memory is flat within 1 %");
  } catch (const validation::InputError& error) {
    std::cerr << "soak: " << error.what() << '\n';
    return 2;
  }
}
