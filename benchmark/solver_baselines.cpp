#include <utility>

#include "benchmark/baselines.h"
#include "benchmark/function_hand.h"
#include "benchmark/solver_run.h"

namespace spring_workbench::benchmark {
namespace {

class SolverBaseline : public Method {
 public:
  explicit SolverBaseline(std::string name) : name_(std::move(name)) {}
  std::string name() const override { return name_; }
  Knob knob() const override { return takes_step(name_) ? Knob::step : Knob::tolerance; }

  bool runs_on(const Scenario& scene) const override { return scene.samples != nullptr || !is_for_samples(name_); }

  RunResult run(const Scenario& scene, double setting) const override {
    const FunctionHand hand(scene);
    // The outputs are at the samples, but for the run with additional ones half-way, in which steps end there, too.
    return as_result(scene, run_solver(rod_case(scene), "bushing", name_, setting, StepEnds::samples_and_outputs,
                                       scene.samples ? nullptr : &hand));
  }

 private:
  std::string name_;
};

}  // namespace

std::vector<MethodPtr> solver_baselines() {
  std::vector<MethodPtr> baselines;
  for (const std::string& name : solver_names()) baselines.push_back(std::make_unique<SolverBaseline>(name));
  return baselines;
}

}  // namespace spring_workbench::benchmark
