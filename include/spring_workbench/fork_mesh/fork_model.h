#pragma once

#include <string>
#include <vector>

#include "spring_workbench/fork_mesh/constants.h"
#include "spring_workbench/fork_mesh/fork_curve.h"

namespace spring_workbench::fork_mesh {

/// Appearance of a tool at rest. Lengths along the spring are fractions of the spring's length, all others are in coil
/// diameters (the paper's normalised space), so one model serves forks of every size.
struct ForkAppearance {
  enum class Spring { coil, beam, none };            ///< beam: a straight line
  enum class End { prongs, needle, ball, diamond };  ///< beyond the tip; the needle's point is the tip itself
  Spring spring = Spring::coil;
  End end = End::prongs;
  bool shaft = true;
  int turns = 10;             ///< turns of the coil, ≥ 1
  int points_per_turn = 12;   ///< ≥ 3
  int wire_sides = 6;         ///< number of sides of the wire's cross section, ≥ 3
  int round_sides = 16;       ///< number of sides of shaft, hub and prongs, ≥ 3
  double wire_radius = 0.07;  ///< stays constant under deformation
  double shaft_radius = 0.4;
  double shaft_length = 3.0;  ///< behind the handle frame
  double prong_radius = 0.085;
  double prong_gap = 0.36;    ///< distance of the outer two of the three prongs from the middle one
  double prong_length = 1.1;  ///< length beyond the tip
  double needle_length = 1.3;
  double ball_radius = 0.45;  ///< also of the diamond

  bool operator==(const ForkAppearance& other) const {
    return spring == other.spring && end == other.end && shaft == other.shaft;
  }
};

/// The appearance of a tool: the paper's fork (figure 5), a spring with a ball, a probe with a needle, a cursor without
/// a shaft for `direct`, a beam for `ray`. Throws InputError if `tool` is not the name of a tool.
ForkAppearance appearance_of(const std::string& tool);

/// The diameter [m] with which a tool of rest length `length` [m] is drawn: `share` times the length, or a fixed value
/// for rigid tools.
double drawn_diameter(const std::string& tool, double length, double share = default_diameter);

/// The deformed fork: vertices [m] and outward unit normals, one per vertex. The triangles are those of the model.
struct ForkMesh {
  std::vector<Vector3d> vertices;
  std::vector<Vector3d> normals;
};

/// The fork of the paper's section 4: a rigid shaft in the hand, a coil spring, and a rigid end with three prongs;
/// other tools have other parts. It is built once, in normalised cylindrical coordinates with normals, and then
/// deformed along a curve for each picture (figures 5 to 7). Shaft and end are rigid and aligned with the first and the
/// last local frame. Immutable.
class ForkModel {
 public:
  using Triangles = std::vector<Eigen::Vector3i>;  ///< indices of vertices, counter-clockwise from outside

  /// Throws InputError if `appearance` does not describe a surface.
  explicit ForkModel(const ForkAppearance& appearance);

  std::size_t vertex_count() const;
  const Triangles& spring() const { return spring_triangles_; }
  const Triangles& shaft_and_end() const { return rigid_triangles_; }

  /// Bends, stretches and twists the fork along the curve. `diameter` [m], > 0: of the coil, measured between the
  /// centres of the wire. Overwrites `mesh` and reuses its memory.
  void deform(const ForkCurve& curve, double diameter, ForkMesh& mesh) const;

 private:
  struct CylindricalVertex {
    double r = 0.0, phi = 0.0, z = 0.0;  ///< about the fork's axis; z from the first or last local frame [diameters]
    double normal_r = 0.0, normal_phi = 0.0, normal_z = 0.0;
  };
  struct WireRing {
    double r = 0.0, phi = 0.0;  ///< the wire's centre [diameters, rad]
    double phi_rate = 0.0;      ///< along the wire [rad]
    double z = 0.0;             ///< fraction of the spring's length
    double cap = 0.0;  ///< −1 or 1: cap that closes the wire at its start or end, facing out; 0: ring around it
  };
  using Vertices = std::vector<CylindricalVertex>;

  void make_shaft();
  void make_end();
  void make_wire(int turns, int segments, double radius);
  void revolve(const std::vector<Eigen::Vector2d>& profile, double centre, Vertices& part);
  void add_ring(const WireRing& ring, const ForkCurve& curve, double wire_end, double diameter, ForkMesh& mesh) const;

  ForkAppearance appearance_;
  Vertices shaft_, end_;  ///< rigid; their vertices come first, shaft before end
  std::vector<WireRing> wire_;
  Triangles spring_triangles_, rigid_triangles_;
};

}  // namespace spring_workbench::fork_mesh
