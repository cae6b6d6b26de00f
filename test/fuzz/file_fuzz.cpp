// External files: motions, settings, scenes.
#include <cmath>
#include <set>

#include "fuzz/running.h"
#include "fuzz/targets.h"
#include "spring_workbench/config/yaml_fields.h"
#include "spring_workbench/motion_files/motion_file.h"
#include "spring_workbench/motion_files/scripted_source.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace spring_workbench::fuzz {
namespace {

constexpr int kSamplesAsked = 1000;

const test_support::TemporaryFolder& folder() {
  static const test_support::TemporaryFolder only;
  return only;
}

/// The text before the line `mark` and the text after it.
std::pair<std::string, std::string> parted(std::string_view text, std::string_view mark) {
  const std::size_t at = text.find(mark);
  if (at == std::string_view::npos) return {std::string(text), {}};
  return {std::string(text.substr(0, at)), std::string(text.substr(at + mark.size()))};
}

void check(const motion::StylusSample& sample) {
  require(std::isfinite(sample.t) && sample.X.matrix().allFinite(), "a sample is finite");
  require((sample.X.linear().transpose() * sample.X.linear() - Matrix3d::Identity()).norm() < 1e-9,
          "a sample's attitude is a rotation");
}

void check(const scene::Scene& scene) {
  std::set<std::string> names;
  for (const scene::Body& body : scene.bodies) {
    require(names.insert(body.name).second, "names of bodies are unique");
    require(body.X_WO.matrix().allFinite() && body.X_OL.matrix().allFinite(), "a body's place is finite");
    const scene::MassProperties& m = body.mass_properties;
    require(m.mass >= 0.0 && m.mass <= 1e12 && m.inertia_O.allFinite(), "a mass is one");
  }
}

}  // namespace

void motion(std::string_view bytes) {
  constexpr std::string_view script = "%script\n";
  if (bytes.substr(0, script.size()) == script) {
    folder().write("motion.yaml", std::string(bytes.substr(script.size())));
    accepted([] {
      motion_files::ScriptedSource source(folder().path("motion.yaml"));
      for (int i = 0; i < kSamplesAsked; ++i) {
        const std::optional<motion::StylusSample> sample = source.next();
        if (!sample) break;
        check(*sample);
      }
    });
    return;
  }
  folder().write("motion.tum", std::string(bytes));
  accepted([] {
    for (const motion::StylusSample& sample : motion_files::read_motion_file(folder().path("motion.tum")))
      check(sample);
  });
}

void settings(std::string_view bytes) {
  static const scene::Scene scene = scene::load_scene(test_support::checkout("scenes/single_box.urdf"));
  folder().write("settings.yaml", std::string(bytes));
  accepted([] {
    simulation::SimulationSettings chosen;
    simulation::apply_settings(config::load_yaml_file(folder().path("settings.yaml")), "settings.yaml", chosen);
    chosen.dynamics.step = std::max(chosen.dynamics.step, 0.005);  // to limit the run time
    if (chosen.dynamics.tolerance > 0.0) chosen.dynamics.tolerance = std::max(chosen.dynamics.tolerance, 1e-6);
    simulation::Simulation simulation(scene, chosen);
    run_a_hand(simulation);
  });
}

void scene(std::string_view bytes) {
  const auto [urdf, yaml] = parted(bytes, "\n%yaml\n");
  folder().write("scene.urdf", urdf);
  folder().write("scene.yaml", yaml);
  accepted([] {
    const scene::Scene loaded = scene::load_scene(folder().path("scene.urdf"), {folder().path("")});
    check(loaded);
    simulation::Simulation simulation(loaded, {});
    run_a_hand(simulation);
  });
}

}  // namespace spring_workbench::fuzz
