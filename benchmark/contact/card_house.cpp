#include "benchmark/contact/card_house.h"

#include <algorithm>
#include <cmath>

#include "benchmark/contact/bodies.h"

namespace spring_workbench::benchmark {
namespace {

constexpr double length = 0.09, width = 0.06, thickness = 1e-3;  // m, of a card
constexpr double mass = 0.002;                                   // kg
constexpr double lean = 20.0 * M_PI / 180.0;
constexpr double between =
    length + 4e-4;              // m, distance of the centres of two pairs: length of a horizontal card plus a gap
constexpr double clear = 1e-6;  // m, initial gap between cards that will touch
constexpr double pull_time = 1.0, pull = 0.15;  // s, m

scene::Body card(const std::string& name, const Vector3d& p_WO, double angle) {
  scene::Body body = box(name, {thickness, width, length}, mass, p_WO);
  body.X_WO.linear() = Eigen::AngleAxisd(angle, Vector3d::UnitY()).toRotationMatrix();
  return body;
}

/// The height of a leaning card.
double storey() { return length * std::cos(lean) + thickness * std::sin(lean); }

/// Two cards that lean against each other above `x`, with their feet at height `z`.
void add_pair(const std::string& name, double x, double z, std::vector<scene::Body>& bodies) {
  const double from_middle = 0.5 * (length * std::sin(lean) + thickness * std::cos(lean)) + 0.5 * clear;
  for (const double side : {-1.0, 1.0}) {
    bodies.push_back(card(name + (side < 0.0 ? " left" : " right"),
                          Vector3d(x + side * from_middle, 0.0, z + 0.5 * storey()), -side * lean));
  }
}

std::vector<scene::Body> house() {
  std::vector<scene::Body> bodies;
  double z = clear;
  for (int pairs = 3; pairs > 0; --pairs) {
    for (int i = 0; i < pairs; ++i) {
      add_pair("pair" + std::to_string(pairs) + std::to_string(i), between * (i - 0.5 * (pairs - 1)), z, bodies);
    }
    z += storey() + clear;
    for (int i = 0; i + 1 < pairs; ++i) {
      bodies.push_back(card("lying" + std::to_string(pairs) + std::to_string(i),
                            Vector3d(between * (i + 0.5 - 0.5 * (pairs - 1)), 0.0, z + 0.5 * thickness), 0.5 * M_PI));
    }
    z += thickness + clear;
  }
  return bodies;
}

}  // namespace

ContactTrial card_house(bool pulled, double duration) {
  ContactTrial trial;
  trial.trial = "cards";
  trial.name = pulled ? "a card is drawn" : "stands";
  trial.scene = scene_with("cards", scene::ContactMode::dynamic, house());
  const std::string taken = pulled ? "pair31 left" : "pair10 left";
  const auto body = scene::find_body(trial.scene, taken);
  const Vector3d p = trial.scene.bodies[*body].X_WO.translation();
  trial.settings = settings_with(pulled ? 500.0 : 0.0, pulled ? 1.0 : 0.0, 0.02, pulled ? taken : "");
  if (!pulled) trial.settings.fork.shape = rod::ShapeKind::bushing;
  const double fork = trial.settings.fork.length;
  trial.X_WH = [=](double t) {
    return hand_above(p + (pulled ? minimum_jerk(t / pull_time) * pull : 0.0) * Vector3d::UnitY(), fork);
  };
  trial.woken_until = pulled ? 0.0 : duration;
  trial.rests_from = pulled ? pull_time : 0.0;
  trial.duration = duration;
  return trial;
}

void run_card_houses(bool quick, const TakeRow& take) {
  for (const bool pulled : {false, true}) {
    if (quick && pulled) continue;
    TrialRun run(card_house(pulled, quick ? 0.5 : pulled ? 2.5 : 10.0));
    double moved = 0.0, dropped = 0.0;
    for (bool more = true; more;) {
      more = run.advance();
      dropped = 1e9;
      for (std::size_t i = 0; i < run.start().size(); ++i) {
        const Vector3d d = run.simulation().objects()[i].X_WO.translation() - run.start()[i].X_WO.translation();
        moved = std::max(moved, d.norm());
        if (run.start()[i].name == "pair10 right") dropped = -d.z();
      }
    }
    const Measured m = run.measured();
    std::vector<Bar> bars{depth_bar(m), blocked_bar(m), unsolved_bar(m), rejected_bar(m)};
    if (pulled) {
      bars.push_back(at_least("the top falls", 1e3 * dropped, 50.0, "mm"));
    } else {
      bars.push_back(at_most("moved", 1e3 * moved, 0.2, "mm"));
      bars.push_back(at_most("gained", 1e6 * m.gained_height, 3.0, "µm"));
    }
    take(run.row(std::move(bars)));
  }
}

}  // namespace spring_workbench::benchmark
