// Replays a recorded hand (lines of `t x y z qx qy qz qw [button]`) or a scripted one (YAML) in a scene, and writes the
// objects as CSV. The last line is a hash of the whole state: equal input gives bit-identical results.
// Usage: replay_a_motion SCENE.urdf MOTION > run.csv
#include <spring_workbench/spring_workbench.h>

#include <cstdio>
#include <memory>

using namespace spring_workbench;

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "replay_a_motion: needs a scene (URDF) and a motion\n");
    return 2;
  }
  try {
    simulation::Simulation simulation(scene::load_scene(argv[1]), {});
    // Samples of a tracker pass through a filter. It rejects samples that no hand can have made, and can release the
    // object if the hand is lost.
    hand_input::InputFilter filter(simulation, {});
    const std::unique_ptr<motion::StylusSource> hand = motion_files::open_motion(argv[2]);
    bool pressed = false;
    while (const auto sample = hand->next()) {
      filter.push_stylus(*sample);
      if (sample->button != pressed) filter.push_button(sample->t, pressed = sample->button);
    }

    std::printf("t,object,x,y,z,held\n");
    const double end = simulation.newest_sample_time();
    for (int i = 0; 0.1 * i <= end + 1e-9; ++i) {
      filter.advance_to(0.1 * i);
      for (const bodies::BodyState& object : simulation.objects()) {
        const Vector3d p = object.X_WO.translation();
        std::printf("%.1f,%s,%.6f,%.6f,%.6f,%d\n", 0.1 * i, object.name.c_str(), p.x(), p.y(), p.z(), object.held);
      }
    }
    std::printf("# state %s\n", math::to_hex(simulation.state_hash()).c_str());
  } catch (const validation::InputError& error) {
    std::fprintf(stderr, "replay_a_motion: %s\n", error.what());
    return 2;
  }
}
