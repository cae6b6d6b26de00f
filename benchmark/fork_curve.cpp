#include "benchmark/fork_curve.h"

#include <time.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "spring_workbench/fork_mesh/fork_model.h"

namespace spring_workbench::benchmark {
namespace {

constexpr int points = 256;  ///< number of intervals at which shapes are compared

/// Bending of a rod of unit length in the x–z plane: slope, curvature and position as functions of arc length.
using Section = Eigen::Vector4d;  // θ, θ', x, z
using Sections = std::vector<Section>;

/// The cantilever under a transverse force P of fixed direction, with EI = L = 1: θ'' = −P cos θ, θ(0) = 0.
Sections integrate(double force, double curvature_at_clamp) {
  constexpr int steps_per_interval = 16;
  const auto rate = [force](const Section& y) {
    return Section(y[1], -force * std::cos(y[0]), std::sin(y[0]), std::cos(y[0]));
  };
  Sections sections{Section(0.0, curvature_at_clamp, 0.0, 0.0)};
  const double h = 1.0 / (points * steps_per_interval);
  Section y = sections.front();
  for (int i = 1; i <= points * steps_per_interval; ++i) {
    const Section a = rate(y), b = rate(y + 0.5 * h * a), c = rate(y + 0.5 * h * b), d = rate(y + h * c);
    y += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    if (i % steps_per_interval == 0) sections.push_back(y);
  }
  return sections;
}

/// Solves for zero curvature at the free end by shooting.
Sections cantilever(double force) {
  double low = 0.0, high = force;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (integrate(force, middle).back()[1] < 0.0 ? low : high) = middle;
  }
  return integrate(force, high);
}

/// The tip is displaced without rotation: two cantilevers of half the length, the second one rotated by half a turn.
Sections s_shape(double force) {
  const Sections half = cantilever(0.25 * force);
  const Section tip = half.back();
  Sections whole;
  for (std::size_t i = 0; i <= points; i += 2) whole.emplace_back(half[i][0], 0.0, 0.5 * half[i][2], 0.5 * half[i][3]);
  for (std::size_t i = 2; i <= points; i += 2) {
    const Section& mirrored = half[points - i];
    whole.emplace_back(mirrored[0], 0.0, tip[2] - 0.5 * mirrored[2], tip[3] - 0.5 * mirrored[3]);
  }
  return whole;
}

/// Strain of the rod `linear` with this deflection and slope at its tip, by Newton; length stays.
rod::StrainVector strain_to_tip(const rod::ShapeModel& shape, const Section& tip) {
  rod::StrainVector q = rod::StrainVector::Zero(shape.size());
  const int mean = 2, slope = 3;  // of the curvature about y
  q[mean] = tip[0];
  const auto miss = [&](const rod::StrainVector& at) {
    const RigidTransform X = shape.section(at, 1.0);
    return Eigen::Vector2d(std::atan2(X(0, 2), X(2, 2)) - tip[0], X(0, 3) - tip[2]);
  };
  for (int newton = 0; newton < 50; ++newton) {
    constexpr double d = 1e-6;
    Eigen::Matrix2d J;
    for (const int c : {mean, slope}) {
      rod::StrainVector up = q, down = q;
      up[c] += d;
      down[c] -= d;
      J.col(c - mean) = (miss(up) - miss(down)) / (2.0 * d);
    }
    q.segment<2>(mean) -= J.lu().solve(miss(q));
  }
  return q;
}

double thread_time() {  // [s]
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Minimum processor time over many runs [µs].
template <typename Work>
double cost_us(Work&& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 60; ++run) {
    const double begin = thread_time();
    work();
    least = std::min(least, thread_time() - begin);
  }
  return 1e6 * least;
}

double length_of(const fork_mesh::ForkCurve& curve) {
  constexpr int parts = 20000;
  double sum = 0.0;
  Vector3d last = curve.at(0.0).p;
  for (int i = 1; i <= parts; ++i) {
    const Vector3d p = curve.at(static_cast<double>(i) / parts).p;
    sum += (p - last).norm();
    last = p;
  }
  return sum;
}

fork_mesh::ForkModel fine_fork() {
  fork_mesh::ForkAppearance look;
  look.points_per_turn = 64;
  look.wire_sides = 16;
  return fork_mesh::ForkModel(look);
}

template <typename MakeCurve>
ForkCurveRow measure(const std::string& name, const Sections& exact, MakeCurve&& make) {
  static const fork_mesh::ForkModel fork = fine_fork();
  const fork_mesh::ForkCurve curve = make();
  ForkCurveRow row;
  row.curve = name;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double u = static_cast<double>(i) / static_cast<double>(exact.size() - 1);
    row.shape_error = std::max(row.shape_error, (curve.at(u).p - Vector3d(exact[i][2], 0.0, exact[i][3])).norm());
  }
  row.length_error = std::abs(length_of(curve) - 1.0);
  row.curve_us = cost_us(make);
  fork_mesh::ForkMesh mesh;
  row.deform_us = cost_us([&] { fork.deform(curve, fork_mesh::default_diameter, mesh); });
  row.vertices = fork.vertex_count();
  return row;
}

}  // namespace

std::vector<ForkCurveRow> measure_fork_curves() {
  const auto shape = rod::make_shape_model(rod::ShapeKind::linear, 1.0);
  const RigidTransform X_WH = RigidTransform::Identity();
  std::vector<ForkCurveRow> rows;
  for (const char* load : {"cantilever", "s_shape"}) {
    for (const double alpha : {0.5, 1.0, 2.0, 5.0, 10.0}) {
      const Sections exact = load[0] == 'c' ? cantilever(alpha) : s_shape(alpha);
      const Section& tip = exact.back();
      const rod::StrainVector q = strain_to_tip(*shape, tip);
      const RigidTransform X_WE =
          make_transform(Vector3d(tip[2], 0.0, tip[3]), Quaterniond(Eigen::AngleAxisd(tip[0], Vector3d::UnitY())));
      rows.push_back(measure("rod", exact, [&] { return fork_mesh::rod_curve(*shape, q, X_WH); }));
      rows.push_back(measure("bezier", exact, [&] { return fork_mesh::bezier_curve(X_WH, X_WE, 1.0, 0.0); }));
      for (std::size_t i = rows.size() - 2; i < rows.size(); ++i) {
        rows[i].load = load;
        rows[i].alpha = alpha;
      }
    }
  }
  return rows;
}

std::string fork_curves_csv(const std::vector<ForkCurveRow>& rows) {
  std::ostringstream csv;
  csv << "curve,load,alpha,shape_error,length_error,curve_us,deform_us,vertices\n";
  for (const ForkCurveRow& row : rows) {
    csv << row.curve << ',' << row.load << ',' << row.alpha << ',' << row.shape_error << ',' << row.length_error << ','
        << row.curve_us << ',' << row.deform_us << ',' << row.vertices << '\n';
  }
  return csv.str();
}

}  // namespace spring_workbench::benchmark
