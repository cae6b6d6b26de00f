#pragma once

namespace spring_workbench::math {

/// A point of a curve: position and its time derivatives.
template <typename Vector>
struct CurvePoint {
  Vector x, x_dot, x_ddot;
};

/// The quintic through position, velocity and acceleration at both ends of a time of `h` [s], at its fraction `u`.
template <typename Vector>
CurvePoint<Vector> quintic(const CurvePoint<Vector>& begin, const CurvePoint<Vector>& end, double h, double u) {
  // x₀ + u (h ẋ₀ + u (h² ẍ₀ / 2 + u (c₃ + u (c₄ + u c₅)))).
  const Vector rise = end.x - begin.x - h * begin.x_dot - 0.5 * h * h * begin.x_ddot;
  const Vector slope = h * (end.x_dot - begin.x_dot) - h * h * begin.x_ddot;
  const Vector bend = h * h * (end.x_ddot - begin.x_ddot);
  const Vector c3 = 10.0 * rise - 4.0 * slope + 0.5 * bend;
  const Vector c4 = -15.0 * rise + 7.0 * slope - bend;
  const Vector c5 = 6.0 * rise - 3.0 * slope + 0.5 * bend;
  return {begin.x + u * (h * begin.x_dot + u * (0.5 * h * h * begin.x_ddot + u * (c3 + u * (c4 + u * c5)))),
          begin.x_dot + u * h * begin.x_ddot + u * u / h * (3.0 * c3 + u * (4.0 * c4 + u * 5.0 * c5)),
          begin.x_ddot + u / (h * h) * (6.0 * c3 + u * (12.0 * c4 + u * 20.0 * c5))};
}

}  // namespace spring_workbench::math
