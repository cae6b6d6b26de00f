#include <chrono>
#include <stdexcept>

#include "benchmark/cvode_solver.h"
#include "benchmark/peers.h"

namespace spring_workbench::benchmark {
namespace {

class Cvode : public Method {
 public:
  explicit Cvode(CvodeCoordinates coordinates) : coordinates_(coordinates) {}
  std::string name() const override {
    return coordinates_ == CvodeCoordinates::world ? "cvode_world" : "cvode_deflection";
  }
  Knob knob() const override { return Knob::tolerance; }

  RunResult run(const Scenario& scene, double tolerance) const override {
    CvodeSolver solver(scene, coordinates_);
    RunResult result;
    const auto start = std::chrono::steady_clock::now();
    try {
      result.outputs = solver.solve(tolerance);
    } catch (const std::runtime_error&) {
      return result;
    }
    result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.finite = true;
    for (const Vector3d& output : result.outputs) result.finite = result.finite && is_bounded(output);
    return result;
  }

 private:
  CvodeCoordinates coordinates_;
};

}  // namespace

std::vector<MethodPtr> cvode_peers() {
  std::vector<MethodPtr> peers;
  peers.push_back(std::make_unique<Cvode>(CvodeCoordinates::world));
  peers.push_back(std::make_unique<Cvode>(CvodeCoordinates::deflection));
  return peers;
}

}  // namespace spring_workbench::benchmark
