#pragma once

#include "spring_workbench/dynamics/held_body.h"

namespace spring_workbench::dynamics {

struct QuinticPoint {
  rod::StrainVector q, q_dot, q_ddot;
};

/// The quintic through state and acceleration at both ends of a step of `h` [s], at `u` = 0 … 1 of it.
inline QuinticPoint quintic(const StrainState& begin, const rod::StrainVector& a_begin, const StrainState& end,
                            const rod::StrainVector& a_end, double h, double u) {
  // q₀ + u (h v₀ + u (h² a₀ / 2 + u (c₃ + u (c₄ + u c₅)))).
  const rod::StrainVector rise = end.q - begin.q - h * begin.q_dot - 0.5 * h * h * a_begin;
  const rod::StrainVector slope = h * (end.q_dot - begin.q_dot) - h * h * a_begin;
  const rod::StrainVector bend = h * h * (a_end - a_begin);
  const rod::StrainVector c3 = 10.0 * rise - 4.0 * slope + 0.5 * bend;
  const rod::StrainVector c4 = -15.0 * rise + 7.0 * slope - bend;
  const rod::StrainVector c5 = 6.0 * rise - 3.0 * slope + 0.5 * bend;
  QuinticPoint p;
  p.q = begin.q + u * (h * begin.q_dot + u * (0.5 * h * h * a_begin + u * (c3 + u * (c4 + u * c5))));
  p.q_dot = begin.q_dot + u * h * a_begin + u * u / h * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5));
  p.q_ddot = a_begin + u / (h * h) * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5));
  return p;
}

}  // namespace spring_workbench::dynamics
