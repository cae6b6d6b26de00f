#include "fuzz/running.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "spring_workbench/validation/input_error.h"

namespace spring_workbench::fuzz {

bool accepted(const std::function<void()>& work) {
  try {
    work();
    return true;
  } catch (const validation::InputError& error) {
    const std::string message = error.what();
    const auto controls = [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; };
    require(!message.empty() && std::none_of(message.begin(), message.end(), controls),
            "one line says what is wrong: " + message);
    return false;
  }
}

void check_finite(const simulation::Simulation& simulation) {
  for (const bodies::BodyState& object : simulation.objects()) {
    require(object.X_WO.matrix().allFinite() && object.V_WO_W.linear.allFinite() && object.V_WO_W.angular.allFinite(),
            "an object's pose and twist are finite");
  }
  for (std::size_t hand = 0; hand < simulation.hands(); ++hand) {
    const tools::ToolState fork = simulation.tool(hand);
    require(fork.X_WE.matrix().allFinite() && fork.strain.allFinite() && fork.tip_wrench_W.force.allFinite() &&
                fork.tip_wrench_W.moment.allFinite() && std::isfinite(fork.elastic_energy),
            "a tool's state is finite");
  }
}

void run_a_hand(simulation::Simulation& simulation) {
  motion::PoseSample sample{0.0, RigidTransform::Identity()};
  sample.X.linear() = Eigen::AngleAxisd(std::acos(-1.0), Vector3d::UnitX()).toRotationMatrix();
  for (const scene::Body& body : simulation.scene().bodies) {
    if (!body.movable) continue;
    sample.X.translation() = body.X_WO.translation() + Vector3d(0.0, 0.0, simulation.tool().length);
    break;
  }
  simulation.push_stylus(sample);
  simulation.push_button(0.05, true);
  for (int i = 1; i <= 5; ++i) {
    sample.t = 0.05 * i;
    sample.X.translation().z() += 0.01 * i;
    simulation.push_stylus(sample);
    simulation.advance_to(sample.t);
    check_finite(simulation);
  }
}

}  // namespace spring_workbench::fuzz
