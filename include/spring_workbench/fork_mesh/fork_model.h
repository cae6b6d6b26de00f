#pragma once

#include <vector>

#include "spring_workbench/fork_mesh/fork_curve.h"

namespace spring_workbench::fork_mesh {

/// How the fork looks at rest. Lengths along the spring are in parts of the spring's length, all others in diameters of
/// the coil (the paper's normalised space), so that one model serves forks of every size.
struct ForkLook {
  int turns = 10;             ///< of the coil, ≥ 1
  int points_per_turn = 12;   ///< ≥ 3
  int wire_sides = 6;         ///< ≥ 3: of the wire's cross section
  int round_sides = 16;       ///< ≥ 3: of shaft, hub and prongs
  double wire_radius = 0.07;  ///< keeps its thickness however the fork is deformed
  double shaft_radius = 0.4;
  double shaft_length = 3.0;  ///< behind the handle frame
  double prong_radius = 0.085;
  double prong_gap = 0.36;    ///< of the outer two of the three prongs from the middle one
  double prong_length = 1.1;  ///< beyond the tip
};

/// The coil's diameter of a fork of this rest length [m].
inline double coil_diameter(double length) { return 0.16 * length; }

/// The deformed fork: vertices [m] and outward unit normals, one each; the model's triangles belong to it.
struct ForkMesh {
  std::vector<Vector3d> vertices;
  std::vector<Vector3d> normals;
};

/// The fork of the paper's section 4: a rigid shaft in the hand, a coil spring, and a rigid end with three prongs. Made
/// once, in normalised cylindrical coordinates with normals; deformed along a curve as often as wanted (figures 5 to
/// 7). Shaft and end are rigid: aligned with the first and the last local frame. Immutable.
class ForkModel {
 public:
  using Triangles = std::vector<Eigen::Vector3i>;  ///< indices of vertices, counter-clockwise from outside

  /// Throws InputError for a look that is no surface.
  explicit ForkModel(const ForkLook& look);

  std::size_t vertex_count() const;
  const Triangles& spring() const { return spring_triangles_; }
  const Triangles& shaft_and_end() const { return rigid_triangles_; }

  /// Bends, stretches and twists the fork along the curve; `diameter` [m] > 0 of the coil between the wire's centres.
  /// Overwrites `mesh`, whose memory is used again.
  void deform(const ForkCurve& curve, double diameter, ForkMesh& mesh) const;

 private:
  struct CylindricalVertex {
    double r, phi, z;  ///< about the fork's axis, z from the first or last local frame [diameters]
    double normal_r, normal_phi, normal_z;
  };
  struct WireRing {
    double r, phi;     ///< the wire's centre [diameters, rad]
    double z;          ///< share of the spring's length
    double cap = 0.0;  ///< −1, 1: closes the wire at its begin, end, facing out; 0: around it
  };
  using Vertices = std::vector<CylindricalVertex>;

  void make_shaft();
  void make_end();
  void make_spring();
  void revolve(const std::vector<Eigen::Vector2d>& profile, double centre, Vertices& part);
  void add_ring(const WireRing& ring, const ForkCurve& curve, double diameter, ForkMesh& mesh) const;

  ForkLook look_;
  Vertices shaft_, end_;  ///< rigid: their vertices come first, shaft before end
  std::vector<WireRing> wire_;
  Triangles spring_triangles_, rigid_triangles_;
};

}  // namespace spring_workbench::fork_mesh
