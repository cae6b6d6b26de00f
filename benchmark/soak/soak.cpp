#include "benchmark/soak/soak.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "benchmark/soak/resident.h"
#include "spring_workbench/assembly/trial.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double kRest = 10.0, kSettle = 2.0, kRestInterval = 0.1;  // s
constexpr double kTimeLimit = 300.0;                                // s, of an assembly
constexpr int kLines = 20;

/// FNV-1a over the bits of numbers.
class Hash {
 public:
  template <typename Derived>
  void add(const Eigen::DenseBase<Derived>& numbers) {
    for (Eigen::Index j = 0; j < numbers.cols(); ++j) {
      for (Eigen::Index i = 0; i < numbers.rows(); ++i) add(numbers.derived().coeff(i, j));
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  void add(double number) {
    std::uint64_t bits;
    std::memcpy(&bits, &number, sizeof bits);
    for (int i = 0; i < 8; ++i) value_ = (value_ ^ ((bits >> (8 * i)) & 0xffU)) * 0x100000001b3U;
  }
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

class Soak {
 public:
  Soak(const SoakOptions& options, std::ostream& out) : Soak(options, out, scene::load_scene(options.scene)) {}

  SoakResult run() {
    out_ << "steps,assemblies,simulated_s,resident_MB,largest_energy_J,drift_m\n";
    for (unsigned seed = options_.seed; result_.steps < options_.steps; ++seed) {
      assemble(seed);
      rest();
      for (const bodies::BodyState& object : simulation_.objects()) {
        hash_.add(object.X_WO.matrix());
        hash_.add(object.V_WO_W.linear);
        hash_.add(object.V_WO_W.angular);
      }
      simulation_.reset();
    }
    result_.hash = hash_.value();
    return result_;
  }

 private:
  Soak(const SoakOptions& options, std::ostream& out, const scene::Scene& scene)
      : options_(options), out_(out), simulation_(scene, assembly::with_all_hands(scene, options.settings)) {}
  bool over() const { return result_.steps >= options_.steps; }

  void assemble(unsigned seed) {
    assembly::TaskMonitor monitor(simulation_.scene());
    assembly::OperatorSettings hand;
    hand.seed = seed;
    assembly::SimulatedOperator person(simulation_.scene(), hand,
                                       [this] { return assembly::operator_view(simulation_); });
    std::vector<bool> pressed(person.hands(), false);
    double before = 0.0;
    for (std::optional<motion::StylusSample> sample; !over() && (sample = person.next()) && sample->t < kTimeLimit;) {
      simulation_.push_stylus(*sample, sample->hand);
      if (sample->button != pressed[sample->hand]) simulation_.push_button(sample->t, sample->button, sample->hand);
      pressed[sample->hand] = sample->button;
      if (sample->hand + 1 < person.hands()) continue;
      advance(before);
      monitor.observe(simulation_);
      before = sample->t;
    }
    const assembly::TaskScore score = monitor.score();
    ++result_.assemblies;
    result_.placed += score.placed;
    result_.targets += score.targets;
  }

  void rest() {
    simulation_.release();
    const double begin = simulation_.newest_sample_time();
    advance(begin + kSettle);
    const std::vector<bodies::BodyState> at_first = simulation_.objects();
    for (double t = begin + kSettle; t < begin + kSettle + kRest; t += kRestInterval) advance(t);
    for (std::size_t i = 0; i < at_first.size(); ++i) {
      const Vector3d moved = simulation_.objects()[i].X_WO.translation() - at_first[i].X_WO.translation();
      result_.drift = std::max(result_.drift, moved.norm());
    }
  }

  void advance(double t) {
    const simulation::AdvanceReport report = simulation_.advance_to(t);
    result_.steps += report.steps;
    result_.simulated_time += report.simulated_time;
    result_.rejected += report.steps_rejected;
    const tools::ToolState tool = simulation_.tool();
    for (const bodies::BodyState& object : simulation_.objects()) {
      result_.finite = result_.finite && object.X_WO.matrix().allFinite() && object.V_WO_W.linear.allFinite() &&
                       object.V_WO_W.angular.allFinite();
    }
    result_.finite = result_.finite && tool.X_WE.matrix().allFinite() && std::isfinite(tool.elastic_energy);
    result_.largest_energy = std::max(result_.largest_energy, tool.elastic_energy + tool.kinetic_energy);
    const bool early = 10 * result_.steps <= options_.steps;
    if (early) result_.energy_early = result_.largest_energy;
    if (result_.steps < next_line_) return;
    const double memory = resident_bytes();
    if (early) result_.memory_early = std::max(result_.memory_early, memory);
    result_.memory_late = memory;
    next_line_ += std::max(1L, options_.steps / kLines / 5);
    if (++looks_ % 5 == 0) {
      out_ << result_.steps << ',' << result_.assemblies << ',' << result_.simulated_time << ',' << memory / 1e6 << ','
           << result_.largest_energy << ',' << result_.drift << std::endl;
    }
  }

  const SoakOptions& options_;
  std::ostream& out_;
  simulation::Simulation simulation_;
  SoakResult result_;
  Hash hash_;
  long next_line_ = 0;
  int looks_ = 0;
};

}  // namespace

SoakResult run_soak(const SoakOptions& options, std::ostream& out) { return Soak(options, out).run(); }

}  // namespace spring_workbench::benchmark
