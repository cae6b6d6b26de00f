#pragma once

#include <memory>
#include <string>
#include <vector>

#include "spring_workbench/math/pack.h"
#include "spring_workbench/rod/settings.h"

namespace spring_workbench::rod {

/// Largest number of strain coordinates of a shape model.
constexpr int max_strain_coordinates = 6;

using StrainVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_strain_coordinates, 1>;
using StrainMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_strain_coordinates, max_strain_coordinates>;
using StrainJacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, max_strain_coordinates>;

/// Pose of the fork's tip E in the handle frame H and its motion with the strain; all vectors in H axes.
struct TipKinematics {
  Matrix3d R_HE = Matrix3d::Identity();
  Vector3d p_HE = Vector3d::Zero();          ///< [m]
  StrainJacobian angular;                    ///< tip's angular velocity = angular · q̇
  StrainJacobian linear;                     ///< tip's velocity = linear · q̇
  Vector3d angular_bias = Vector3d::Zero();  ///< angular acceleration = angular · q̈ + angular_bias [rad/s²]
  Vector3d linear_bias = Vector3d::Zero();   ///< acceleration = linear · q̈ + linear_bias [m/s²]
};

/// TipKinematics for one strain (`S` = double) or several at once.
template <typename S>
struct TipOf {
  math::ThreeByThree<S> R_HE;
  math::Three<S> p_HE;
  math::Three<S> angular[max_strain_coordinates];
  math::Three<S> linear[max_strain_coordinates];
  math::Three<S> angular_bias, linear_bias;
};

/// The strain coordinates of a DOF: [begin, begin + count).
struct CoordinateRange {
  int begin = 0;
  int count = 0;
};

/// The curve of the fork's spring part as a function of a few strain coordinates q (doc/model.md, "Shape models";
/// paper, section 4). Clamped to the handle at H, and straight along z of H for q = 0. Immutable; knows neither time
/// nor mass.
class ShapeModel {
 public:
  virtual ~ShapeModel() = default;

  /// Number of strain coordinates: bend first, then torsion, then stretch.
  virtual int size() const = 0;
  virtual CoordinateRange bend() const = 0;
  CoordinateRange torsion() const { return {size() - 2, 1}; }
  CoordinateRange stretch() const { return {size() - 1, 1}; }
  /// The unit of each coordinate on this rod: changes by it move or turn the tip by about length() or 1 rad.
  virtual StrainVector units() const = 0;

  /// Diagonal of the stiffness matrix K, `U = ½ qᵀ K q` [J], for the stiffness of the DOFs [N/m, N/m, N·m/rad].
  virtual StrainVector stiffness(const PerDof& k) const = 0;
  /// Diagonal of the damping matrix D for the damping coefficients `c` of the DOFs [N·s/m, N·s/m, N·m·s/rad]. Within
  /// each DOF, D is c / k times K for the stiffness `k`, or its limit if k is zero.
  virtual StrainVector damping(const PerDof& c, const PerDof& k) const;

  /// Computes the tip for strain `q` and strain rate `q_dot`, both of length size().
  void tip(const StrainVector& q, const StrainVector& q_dot, TipKinematics& out) const;
  /// The same for arrays of size() coordinates.
  virtual void tip(const double* q, const double* q_dot, TipOf<double>& out) const = 0;
  virtual void tip(const math::Pack* q, const math::Pack* q_dot, TipOf<math::Pack>& out) const = 0;

  /// Whether the strain is the tip's displacement from (0, 0, length()) and its rotation vector: (dx, dy, φx, φy, φz,
  /// dz).
  virtual bool strain_is_pose() const { return false; }

  /// Extension of the rod [m] and twist angle [rad].
  virtual double extension(const StrainVector& q) const = 0;
  virtual double twist(const StrainVector& q) const = 0;

  /// Pose in H of the rod's cross section at arc length `s` of the rest shape, 0 ≤ s ≤ length() [m].
  virtual RigidTransform section(const StrainVector& q, double s) const = 0;

  /// Changes to equivalent coordinates with less strain, if there are any, and converts the rates accordingly (a
  /// rotation vector beyond half a turn becomes that of the shorter rotation). Returns whether it did.
  virtual bool rechart(StrainVector& q, StrainVector& q_dot) const;

  /// Whether the strain is possible: finite, not inverted, and within the rod's range.
  bool admissible(const StrainVector& q) const { return q.allFinite() && range_used(q) < 1.0; }
  /// Fraction of the rod's range that this strain uses: 0 at rest, 1 at the limit; a convex function of `q`.
  virtual double range_used(const StrainVector& q) const = 0;

  double length() const { return length_; }

 protected:
  explicit ShapeModel(double length) : length_(length) {}

 private:
  double length_;  ///< [m]
};

/// A shape model's rod while it cannot bend. It then turns and stretches along its own axis only, which needs no
/// quadrature however often it is wound up.
class StraightRod {
 public:
  explicit StraightRod(const ShapeModel& shape);

  /// ShapeModel::tip for the strain `q` without bend. The columns of the bend coordinates are set to zero. Defined in
  /// straight_rod.h.
  template <typename S>
  void tip(const S* q, TipOf<S>& out) const;

 private:
  int torsion_, stretch_;
  double length_;
  double twist_, extension_;  ///< by unit of their coordinates
};

/// `length` [m] > 0; `slope_stiffness` as in ForkSettings. Throws InputError for an invalid length.
std::shared_ptr<const ShapeModel> make_shape_model(ShapeKind kind, double length,
                                                   std::optional<double> slope_stiffness = std::nullopt);

}  // namespace spring_workbench::rod
