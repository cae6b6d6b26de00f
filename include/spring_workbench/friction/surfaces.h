#pragma once

#include <array>
#include <map>
#include <vector>

#include "spring_workbench/friction/contact_problem.h"
#include "spring_workbench/math/state_archive.h"

namespace spring_workbench::friction {

/// Compliant surfaces between pairs of bodies. A surface is a body without mass that all contact forces between the two
/// bodies from one side indent together. Two bodies that carry no load yet and approach fast collide first, as if they
/// were rigid. Bodies are numbered from 0; -1 is the ground.
class Surfaces {
 public:
  /// `compliance` [m/N]: compliance of each body's material, 0 if it is rigid; the last one is that of the ground.
  explicit Surfaces(std::vector<double> compliance);
  bool none() const { return none_; }  ///< whether all materials are rigid

  /// Begins a step of `h` [s]; restores the indentations before it.
  void begin_step(double h);
  void undo_step() { indented_ = indented_before_; }
  void archive(math::StateArchive& state) { state(indented_); }
  /// Returns the indentation of the surface between two bodies at the end of the last step [m].
  double indentation(std::size_t a, std::size_t b) const;

  /// Removes the surfaces of the contacts that were solved last.
  void clear() { surfaces_.clear(); }
  /// Returns whether contacts with these normals are on the same side, and so indent the same surface.
  static bool is_one(const Eigen::Vector3d& n, const Eigen::Vector3d& other_n);
  /// Returns the index of the surface between two bodies at a contact with the normal `n` from the lower to the higher
  /// index, or -1 if both bodies are rigid. `fast`: the contact closes faster than the speed above which bodies bounce.
  int between(int a, int b, const Eigen::Vector3d& n, bool fast);
  /// Returns whether there is a surface and it yields to contact, because its bodies do not collide.
  bool complies(int surface) const { return surface >= 0 && !at(surface).collides; }
  bool collides(int surface) const { return surface >= 0 && at(surface).collides; }
  /// Ends a collision: from now on the surface yields.
  void stop(int surface);

  /// Adds the surfaces to a problem of velocities and impulses over the step; `unloaded`: they carry no load yet.
  void add_to(ContactProblem& problem, bool unloaded);
  /// Makes the contact that was added last, with the normal `n` from the body with the lower index, move with a surface
  /// that yields.
  void add_part(ContactProblem& problem, int surface, const Eigen::Vector3d& n) const;
  /// Adds the normal impulse of a contact [N·s] to the load of its surface.
  void add_load(int surface, const Eigen::Vector3d& n, double impulse);
  /// Returns the velocity of a surface along `n` under its load [m/s].
  double motion(int surface, const Eigen::Vector3d& n) const;
  /// Records that a contact presses, and how deep it is, so that its bodies count as loaded in the next step.
  void note_pressed(int surface, const Eigen::Vector3d& n);

 private:
  using Pair = std::array<int, 2>;  ///< indices of two bodies, ascending
  struct Surface {
    Pair bodies;
    Eigen::Vector3d n;  ///< normal of its first contact
    double response;    ///< velocity per impulse over the step [1/kg]
    bool collides = false;
    Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
  };
  const Surface& at(int surface) const { return surfaces_[static_cast<std::size_t>(surface)]; }
  double compliance_of(int body) const;

  std::vector<double> compliance_;
  bool none_;
  double h_ = 1.0;
  std::vector<Surface> surfaces_;
  std::size_t first_ = 0;                              ///< index of the first surface's body in the problem
  std::map<Pair, double> indented_, indented_before_;  ///< indentations of the pairs that press on each other [m]
};

}  // namespace spring_workbench::friction
