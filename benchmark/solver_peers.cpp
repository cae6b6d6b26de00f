#include <utility>

#include "benchmark/function_hand.h"
#include "benchmark/peers.h"
#include "benchmark/solver_run.h"

namespace spring_workbench::benchmark {
namespace {

class SolverPeer : public Method {
 public:
  explicit SolverPeer(std::string name) : name_(std::move(name)) {}
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

std::vector<MethodPtr> solver_peers() {
  std::vector<MethodPtr> peers;
  for (const std::string& name : solver_names()) peers.push_back(std::make_unique<SolverPeer>(name));
  return peers;
}

}  // namespace spring_workbench::benchmark
