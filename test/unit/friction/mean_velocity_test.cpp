#include "spring_workbench/friction/mean_velocity.h"

#include <gtest/gtest.h>

#include <cmath>

namespace spring_workbench::friction {
namespace {

constexpr double dt = 0.01, fall_rate = 9.81, resting = 1e-5;  // [s, m/s², m/s]

BodyVelocities from_to(double start, double end) {
  BodyVelocities v;
  v.start[2] = start;
  v.end[2] = end;
  v.free = true;
  return v;
}
BodyVelocities fixed() { return {}; }

/// Contact of `a` on top of `b`, with a normal impulse.
BouncingContact on(std::size_t a, std::size_t b, double gap, double impulse) {
  BouncingContact c{};
  c.a = a;
  c.b = b;
  c.J_a.setZero();
  c.J_b.setZero();
  c.motion.setZero();
  c.J_a(0, 2) = 1.0;
  c.J_b(0, 2) = -1.0;
  c.gap = gap;
  c.impulse = {impulse, 0.0, 0.0};
  return c;
}

std::vector<bool> mean(const std::vector<BodyVelocities>& bodies, std::vector<BouncingContact> contacts) {
  std::vector<BouncingContact*> all;
  for (BouncingContact& c : contacts) all.push_back(&c);
  return move_with_mean_velocity(bodies, all, dt, resting);
}

TEST(MeanVelocity, WhatFallsFreelyOrRestsHasIt) {
  EXPECT_EQ(mean({from_to(0.0, -fall_rate * dt), fixed()}, {on(0, 1, 1.0, 0.0)}), std::vector<bool>({true, false}));
  EXPECT_EQ(mean({from_to(0.0, 0.0), from_to(0.0, 0.0), fixed()}, {on(0, 1, 0.0, 1.0), on(1, 2, 0.0, 2.0)}),
            std::vector<bool>({true, true, false}));
}

// With its mean velocity, what lands would be below the ground by half its way; what lies on it goes with it.
TEST(MeanVelocity, WhatLandsAndWhatPressesOnItMovesWithItsEndVelocity) {
  const double gap = 0.4 * dt;
  EXPECT_EQ(mean({from_to(-1.0, -0.4), from_to(-1.0, -0.4), from_to(0.0, -fall_rate * dt), fixed()},
                 {on(0, 3, gap, 1.0), on(1, 0, 0.0, 0.5), on(2, 3, 1.0, 0.0)}),
            std::vector<bool>({false, false, true, false}));
}

// The way until it sticks is shorter than half the step.
TEST(MeanVelocity, WhatBeginsToStickMovesWithItsEndVelocity) {
  BodyVelocities slides = from_to(0.0, 0.0);
  slides.start[0] = 0.02;
  BouncingContact c = on(0, 1, 0.0, fall_rate * dt);
  c.friction = 0.5;
  c.J_a(1, 0) = 1.0;
  c.impulse[1] = -0.02;
  for (const double left : {0.0, 2.0 * resting}) {  // as the solution may leave it
    slides.end[0] = left;
    EXPECT_EQ(mean({slides, fixed()}, {c})[0], false) << left;
  }
  slides.start[0] = 1.0;  // still slips at the end
  slides.end[0] = 1.0 - c.friction * fall_rate * dt;
  c.impulse[1] = -c.friction * fall_rate * dt;
  EXPECT_EQ(mean({slides, fixed()}, {c})[0], true);
}

// Of two contacts, each as far as friction allows, aslant: together they stop the slip.
TEST(MeanVelocity, ContactsThatPressAgainstEachOtherStickToo) {
  BodyVelocities slides = from_to(0.0, 0.0);
  slides.start[0] = 0.03;
  BouncingContact one = on(0, 1, 0.0, 0.5 * fall_rate * dt), other = one;
  const double most = 0.5 * 0.5 * fall_rate * dt;
  for (BouncingContact* c : {&one, &other}) {
    c->friction = 0.5;
    c->J_a(1, 0) = c->J_a(2, 1) = 1.0;
    c->impulse[1] = -0.015;
    c->impulse[2] = (c == &one ? 1.0 : -1.0) * std::sqrt(most * most - 0.015 * 0.015);
  }
  for (const double left : {0.0, 0.1 * resting}) {
    slides.end[0] = left;
    EXPECT_EQ(mean({slides, fixed()}, {one, other})[0], false) << left;
  }
}

TEST(MeanVelocity, WhatHopsOrLandsMovesWithItsEndVelocity) {
  EXPECT_EQ(mean({from_to(0.05, 0.0), fixed()}, {on(0, 1, 0.0, 0.05)})[0], false);
  EXPECT_EQ(mean({from_to(-0.02, -0.01), fixed()}, {on(0, 1, 1e-4, 0.1)})[0], false);
}

TEST(MeanVelocity, WhatPressesOnADrivenBodyMovesWithItsEndVelocity) {
  BodyVelocities driven = from_to(0.0, 1.0);
  driven.free = false;
  BouncingContact pushed = on(0, 2, 0.0, 1.0);
  pushed.by_end_velocity = true;
  EXPECT_EQ(mean({from_to(0.0, 1.0), from_to(0.0, 1.0), driven}, {pushed, on(1, 0, 0.0, 1.0)}),
            std::vector<bool>({false, false, false}));
  pushed.impulse.setZero();  // it lets go
  EXPECT_EQ(mean({from_to(0.0, 2.0), driven}, {pushed})[0], true);
}

}  // namespace
}  // namespace spring_workbench::friction
