#include "spring_workbench/fork_mesh/fork_model.h"

#include <cmath>

#include "constants.h"
#include "spring_workbench/validation/number_rule.h"

namespace spring_workbench::fork_mesh {
namespace {

void check(const ForkAppearance& appearance) {
  const char* const where = "fork look";
  validation::check_number(where, "turns", appearance.turns, validation::between(1, 1000));
  validation::check_number(where, "points_per_turn", appearance.points_per_turn, validation::between(3, 1000));
  validation::check_number(where, "wire_sides", appearance.wire_sides, validation::between(3, 1000));
  validation::check_number(where, "round_sides", appearance.round_sides, validation::between(3, 1000));
  validation::check_number(where, "wire_radius", appearance.wire_radius, validation::positive());
  validation::check_number(where, "shaft_radius", appearance.shaft_radius, validation::positive());
  validation::check_number(where, "shaft_length", appearance.shaft_length, validation::positive());
  validation::check_number(where, "prong_radius", appearance.prong_radius, validation::positive());
  validation::check_number(where, "prong_gap", appearance.prong_gap, validation::positive());
  validation::check_number(where, "prong_length", appearance.prong_length, validation::positive());
  validation::check_number(where, "needle_length", appearance.needle_length, validation::positive());
  validation::check_number(where, "ball_radius", appearance.ball_radius, validation::positive());
}

/// Two triangles a, b, c and a, c, d.
void add_quad(int a, int b, int c, int d, ForkModel::Triangles& triangles) {
  triangles.emplace_back(a, b, c);
  triangles.emplace_back(a, c, d);
}

}  // namespace

ForkAppearance appearance_of(const std::string& tool) {
  using Spring = ForkAppearance::Spring;
  using End = ForkAppearance::End;
  ForkAppearance appearance;
  if (tool == "spring") appearance.end = End::ball;
  if (tool == "spring_probe") appearance.end = End::needle;
  if (tool == "ray") {
    appearance.spring = Spring::beam;
    appearance.end = End::ball;
  }
  if (tool == "direct") {
    appearance.spring = Spring::none;
    appearance.end = End::diamond;
    appearance.shaft = false;
  }
  const bool is_known = !(appearance == ForkAppearance()) || tool == "spring_fork";
  if (!is_known) validation::refuse("fork", "tool", tool, "one of spring, spring_fork, spring_probe, direct, ray");
  return appearance;
}

double drawn_diameter(const std::string& tool, double length, double share) {
  return tool == "direct" || tool == "ray" ? rigid_diameter : share * length;
}

ForkModel::ForkModel(const ForkAppearance& appearance) : appearance_(appearance) {
  check(appearance);
  if (appearance.shaft) make_shaft();
  make_end();
  if (appearance.spring == ForkAppearance::Spring::coil) {
    make_wire(appearance.turns, appearance.turns * appearance.points_per_turn, coil_radius);
    make_wire(0, seam_segments, coil_radius);
  }
  if (appearance.spring == ForkAppearance::Spring::beam) make_wire(0, 2, 0.0);
}

std::size_t ForkModel::vertex_count() const {
  return shaft_.size() + end_.size() + wire_.size() * static_cast<std::size_t>(appearance_.wire_sides);
}

void ForkModel::make_shaft() {
  const double rim = coil_radius + appearance_.wire_radius;
  revolve({{0.0, -appearance_.shaft_length},
           {appearance_.shaft_radius, -appearance_.shaft_length},
           {appearance_.shaft_radius, -2.0 * flange},
           {rim, -flange},
           {rim, 0.0},
           {0.0, 0.0}},
          0.0, shaft_);
}

void ForkModel::make_end() {
  const double rim = coil_radius + appearance_.wire_radius, tip = appearance_.prong_length,
               ball = appearance_.ball_radius;
  switch (appearance_.end) {
    case ForkAppearance::End::prongs:
      revolve({{0.0, 0.0}, {rim, 0.0}, {rim, flange}, {0.0, flange}}, 0.0, end_);
      for (const double centre : {-appearance_.prong_gap, 0.0, appearance_.prong_gap}) {
        const double radius = appearance_.prong_radius;
        revolve({{0.0, 0.5 * flange}, {radius, 0.5 * flange}, {radius, 0.7 * tip}, {0.0, tip}}, centre, end_);
      }
      return;
    case ForkAppearance::End::needle:
      return revolve({{0.0, -appearance_.needle_length}, {0.6 * coil_radius, -appearance_.needle_length}, {0.0, 0.0}},
                     0.0, end_);
    case ForkAppearance::End::diamond:
      return revolve({{0.0, -2.0 * ball}, {ball, 0.0}, {0.0, 2.0 * ball}}, 0.0, end_);
    case ForkAppearance::End::ball: {
      std::vector<Eigen::Vector2d> half_circle;
      const int sectors = appearance_.round_sides / 2;
      for (int i = 0; i <= sectors; ++i) {
        const double angle = M_PI * i / sectors;
        half_circle.emplace_back(ball * std::sin(angle), -ball * std::cos(angle));
      }
      half_circle.front().x() = half_circle.back().x() = 0.0;
      return revolve(half_circle, 0.0, end_);
    }
  }
}

/// Adds a surface of revolution about the line x = `centre` to the shaft or the end. `profile`: points (radius, z) from
/// back to front. Edges are sharp: each segment of the profile has its own vertices and normals.
void ForkModel::revolve(const std::vector<Eigen::Vector2d>& profile, double centre, Vertices& part) {
  const int sides = appearance_.round_sides;
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    const Eigen::Vector2d along = (profile[k + 1] - profile[k]).normalized();
    const Eigen::Vector2d outward(along.y(), -along.x());
    const int first = static_cast<int>(shaft_.size() + end_.size());
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * M_PI * i / sides;
      for (const Eigen::Vector2d& p : {profile[k], profile[k + 1]}) {
        const double x = centre + p.x() * std::cos(angle), y = p.x() * std::sin(angle);
        const double phi = std::atan2(y, x), turn = angle - phi;
        part.push_back(
            {std::hypot(x, y), phi, p.y(), outward.x() * std::cos(turn), outward.x() * std::sin(turn), outward.y()});
      }
      const int a = first + 2 * i, b = first + 2 * ((i + 1) % sides);
      if (profile[k].x() > 0.0) rigid_triangles_.emplace_back(a, b, b + 1);
      if (profile[k + 1].x() > 0.0) rigid_triangles_.emplace_back(a, b + 1, a + 1);
    }
  }
}

/// Makes a wire of `segments` segments around the axis at `radius` [diameters]: the coil or, without turns, a beam or a
/// seam along the spring, which shows the twist.
void ForkModel::make_wire(int turns, int segments, double radius) {
  const int sides = appearance_.wire_sides, rings = segments + 1;
  const int first = static_cast<int>(shaft_.size() + end_.size()) + sides * static_cast<int>(wire_.size());
  const double phi_rate = 2.0 * M_PI * turns;
  const auto ring = [&](int k, double cap) {
    const double share = static_cast<double>(k) / segments;
    wire_.push_back({radius, phi_rate * share, phi_rate, share, cap});
  };
  ring(0, -1.0);
  for (int k = 0; k < rings; ++k) ring(k, 0.0);
  ring(rings - 1, 1.0);

  const int begin_cap = first, around = first + sides, end_cap = around + rings * sides;
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    for (int k = 0; k + 1 < rings; ++k) {
      const int a = around + k * sides, b = a + sides;
      add_quad(a + i, a + next, b + next, b + i, spring_triangles_);
    }
    if (i == 0 || next == 0) continue;
    spring_triangles_.emplace_back(begin_cap, begin_cap + next, begin_cap + i);
    spring_triangles_.emplace_back(end_cap, end_cap + i, end_cap + next);
  }
}

/// The centre of the ring follows the deformed cylinder; the wire keeps a circular cross section around it.
void ForkModel::add_ring(const WireRing& ring, const ForkCurve& curve, double wire_end, double diameter,
                         ForkMesh& mesh) const {
  const CurvePoint at = curve.at(wire_end * ring.z);
  const Vector3d out(std::cos(ring.phi), std::sin(ring.phi), 0.0), around(-out.y(), out.x(), 0.0);
  const Vector3d from_axis = ring.r * diameter * out;
  const Vector3d centre = at.p + at.R * from_axis;
  const Vector3d along =
      (at.p_rate + at.R * (at.turn_rate.cross(from_axis) + ring.r * diameter * ring.phi_rate / wire_end * around))
          .normalized();
  const Vector3d side = along.cross(at.R * out).normalized();
  const Vector3d outward = side.cross(along);
  for (int i = 0; i < appearance_.wire_sides; ++i) {
    const double angle = 2.0 * M_PI * i / appearance_.wire_sides;
    const Vector3d direction = std::cos(angle) * outward + std::sin(angle) * side;
    mesh.vertices.push_back(centre + appearance_.wire_radius * diameter * direction);
    mesh.normals.push_back(ring.cap == 0.0 ? direction : Vector3d(ring.cap * along));
  }
}

void ForkModel::deform(const ForkCurve& curve, double diameter, ForkMesh& mesh) const {
  mesh.vertices.clear();
  mesh.normals.clear();
  const auto add_rigid = [&](const Vertices& part, const RigidTransform& X) {
    for (const CylindricalVertex& v : part) {
      const double c = std::cos(v.phi), s = std::sin(v.phi);
      mesh.vertices.push_back(X * (diameter * Vector3d(v.r * c, v.r * s, v.z)));
      mesh.normals.push_back(
          X.linear() * Vector3d(v.normal_r * c - v.normal_phi * s, v.normal_r * s + v.normal_phi * c, v.normal_z));
    }
  };
  add_rigid(shaft_, curve.begin());
  add_rigid(end_, curve.end());
  // The wire ends at the base of the needle; a spring shorter than the needle lies inside it.
  const double needle = appearance_.end == ForkAppearance::End::needle ? appearance_.needle_length * diameter : 0.0;
  const double wire_end = std::max(1.0 - needle / curve.at(1.0).p_rate.norm(), 1e-3);
  for (const WireRing& ring : wire_) add_ring(ring, curve, wire_end, diameter, mesh);
}

}  // namespace spring_workbench::fork_mesh
