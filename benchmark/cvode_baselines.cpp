#include <chrono>
#include <stdexcept>
#include <utility>

#include "benchmark/baselines.h"
#include "benchmark/scene_solver.h"

namespace spring_workbench::benchmark {
namespace {

class Cvode : public Method {
 public:
  explicit Cvode(SceneCoordinates coordinates) : coordinates_(coordinates) {}
  std::string name() const override {
    return coordinates_ == SceneCoordinates::world ? "cvode_world" : "cvode_deflection";
  }
  Knob knob() const override { return Knob::tolerance; }

  RunResult run(const Scenario& scene, double tolerance) const override {
    SceneSolver solver(scene, coordinates_, [](int size, OdeSolver::Rates rates) {
      return make_cvode(CvodeFormula::bdf, size, std::move(rates));
    });
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
  SceneCoordinates coordinates_;
};

}  // namespace

std::vector<MethodPtr> cvode_baselines() {
  std::vector<MethodPtr> baselines;
  baselines.push_back(std::make_unique<Cvode>(SceneCoordinates::world));
  baselines.push_back(std::make_unique<Cvode>(SceneCoordinates::deflection));
  return baselines;
}

}  // namespace spring_workbench::benchmark
