#pragma once

#include <algorithm>
#include <cmath>

#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::exponential {

/// Generalised complex number re + im j with j² = `square`: a complex number for −1, a dual number for 0, a split one
/// for 1. A function of the real 2×2 matrix re I + im J with J² = square I is that function of the number, even if the
/// eigenvalues re ± im √square coincide and there is only one eigenvector. The operands of a sum or a product have the
/// same `square`, or one of them is real.
struct GeneralComplex {
  double re = 0.0, im = 0.0, square = 0.0;

  GeneralComplex() = default;
  GeneralComplex(double real) : re(real) {}  // NOLINT(google-explicit-constructor): as std::complex
  GeneralComplex(double real, double imaginary, double j_squared) : re(real), im(imaginary), square(j_squared) {}

  GeneralComplex& operator+=(const GeneralComplex& z) { return *this = *this + z; }
  friend GeneralComplex operator+(const GeneralComplex& z, double a) { return a + z; }
  friend GeneralComplex operator+(const GeneralComplex& a, const GeneralComplex& b) {
    return {a.re + b.re, a.im + b.im, common_square(a, b)};
  }
  friend GeneralComplex operator+(double a, const GeneralComplex& z) { return {a + z.re, z.im, z.square}; }
  friend GeneralComplex operator-(const GeneralComplex& z, double a) { return {z.re - a, z.im, z.square}; }
  friend GeneralComplex operator*(double a, const GeneralComplex& z) { return {a * z.re, a * z.im, z.square}; }
  friend GeneralComplex operator*(const GeneralComplex& z, double a) { return a * z; }
  friend GeneralComplex operator*(const GeneralComplex& a, const GeneralComplex& b) {
    const double square = common_square(a, b);
    return {a.re * b.re + square * a.im * b.im, a.re * b.im + a.im * b.re, square};
  }
  friend GeneralComplex operator/(double a, const GeneralComplex& z) {
    const double largest = std::max(std::abs(z.re), std::abs(z.im));
    const double re = z.re / largest, im = z.im / largest;
    const double over = a / (largest * (re * re - z.square * im * im));
    return {over * re, -over * im, z.square};
  }

  friend bool operator==(const GeneralComplex& a, const GeneralComplex& b) {
    return a.re == b.re && a.im == b.im && a.square == b.square;
  }

  /// Square of the larger absolute value of the eigenvalues.
  friend double norm(const GeneralComplex& z) {
    if (z.square < 0.0) return z.re * z.re - z.square * z.im * z.im;
    const double size = abs(z);
    return size * size;
  }
  /// Larger absolute value of the eigenvalues.
  friend double abs(const GeneralComplex& z) {
    const double apart = std::abs(z.im) * std::sqrt(std::abs(z.square));
    return z.square < 0.0 ? std::hypot(z.re, apart) : std::abs(z.re) + apart;
  }
  friend GeneralComplex exp(const GeneralComplex& z) {
    const double apart = std::abs(z.im) * std::sqrt(std::abs(z.square));  // half of the eigenvalues' distance
    const auto of = [&](double mean, double difference) {
      return GeneralComplex{mean, apart > 0.0 ? difference / apart * z.im : mean * z.im, z.square};
    };
    if (z.square < 0.0) return of(std::exp(z.re) * std::cos(apart), std::exp(z.re) * std::sin(apart));
    if (apart < 1.0) return of(std::exp(z.re) * std::cosh(apart), std::exp(z.re) * std::sinh(apart));
    const double above = std::exp(z.re + apart), below = std::exp(z.re - apart);
    return of(0.5 * (above + below), 0.5 * (above - below));
  }

  void archive(math::StateArchive& state) { state(re, im, square); }

 private:
  static double common_square(const GeneralComplex& a, const GeneralComplex& b) {
    return a.square != 0.0 ? a.square : b.square;
  }
};

}  // namespace spring_workbench::exponential
