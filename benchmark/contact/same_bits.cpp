#include "benchmark/contact/same_bits.h"

#include <cstring>

#include "benchmark/contact/bodies.h"
#include "benchmark/contact/piles.h"

namespace spring_workbench::benchmark {
namespace {

bool same(const bodies::BodyState& a, const bodies::BodyState& b) {
  const auto bits = [](const auto& x, const auto& y) { return std::memcmp(x.data(), y.data(), sizeof x) == 0; };
  return bits(a.X_WO.matrix(), b.X_WO.matrix()) && bits(a.V_WO_W.linear, b.V_WO_W.linear) &&
         bits(a.V_WO_W.angular, b.V_WO_W.angular);
}

}  // namespace

void run_same_bits(bool quick, const TakeRow& take) {
  struct Case {
    std::string name;
    double height;  ///< height of the far box's centre [m]; 0: no far box
  };
  for (const Case& c : {Case{"again", 0.0}, Case{"a far body rests", 0.02}, Case{"a far body falls", 0.5}}) {
    ContactTrial first = pushed_pile(2, 2, 0.02);
    if (quick) first.duration = 0.4;
    ContactTrial second = first;
    if (c.height > 0.0) {
      second.scene.bodies.push_back(box("far", Vector3d::Constant(0.04), 0.1, {10.0, 0.0, c.height}));
    }
    second.trial = "bits";
    second.name = c.name;
    TrialRun one(first), other(second);
    int different = 0;
    for (bool more = true; more;) {
      more = one.advance();
      other.advance();
      for (std::size_t i = 0; i < one.start().size(); ++i) {
        different += same(one.simulation().objects()[i], other.simulation().objects()[i]) ? 0 : 1;
      }
    }
    take(other.row({at_most("states that differ", different, 0.0)}));
  }
}

}  // namespace spring_workbench::benchmark
