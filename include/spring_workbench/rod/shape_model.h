#pragma once

#include <memory>
#include <string>
#include <vector>

#include "spring_workbench/math/pack.h"
#include "spring_workbench/rod/settings.h"

namespace spring_workbench::rod {

/// Largest number of strain coordinates of a shape model.
constexpr int max_strain_coordinates = 6;

/// One number per strain coordinate; at most six, so that it is not on the heap.
using StrainVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_strain_coordinates, 1>;
/// A square matrix of the strain coordinates.
using StrainMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_strain_coordinates, max_strain_coordinates>;
/// A vector [x; y; z] per strain coordinate, one in each column.
using StrainJacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, max_strain_coordinates>;

/// Pose of the fork's tip E in the handle frame H and its motion with the strain; all vectors in H axes.
struct TipKinematics {
  Matrix3d R_HE = Matrix3d::Identity();      ///< rotation of the tip
  Vector3d p_HE = Vector3d::Zero();          ///< position of the tip [m]
  StrainJacobian angular;                    ///< tip's angular velocity = angular · q̇
  StrainJacobian linear;                     ///< tip's velocity = linear · q̇
  Vector3d angular_bias = Vector3d::Zero();  ///< angular acceleration = angular · q̈ + angular_bias [rad/s²]
  Vector3d linear_bias = Vector3d::Zero();   ///< acceleration = linear · q̈ + linear_bias [m/s²]
};

/// TipKinematics for one strain (`S` = double) or several at once.
template <typename S>
struct TipOf {
  math::ThreeByThree<S> R_HE;                      ///< rotation of the tip
  math::Three<S> p_HE;                             ///< position of the tip [m]
  math::Three<S> angular[max_strain_coordinates];  ///< columns of TipKinematics::angular
  math::Three<S> linear[max_strain_coordinates];   ///< columns of TipKinematics::linear
  math::Three<S> angular_bias;                     ///< TipKinematics::angular_bias [rad/s²]
  math::Three<S> linear_bias;                      ///< TipKinematics::linear_bias [m/s²]
};

/// The strain coordinates of a DOF: [begin, begin + count).
struct CoordinateRange {
  int begin = 0;  ///< the first one
  int count = 0;  ///< how many there are
};

/// The curve of the fork's spring part as a function of a few strain coordinates q (doc/model.md, "Shape models";
/// paper, section 4). Clamped to the handle at H, and straight along z of H for q = 0. Immutable; knows neither time
/// nor mass. Units of q: bend (curvatures) and torsion (twist per length) [1/m], stretch [–]; for `bushing`
/// displacements [m] and a rotation vector [rad], which are called strain as well. Rates are in these units per second.
class ShapeModel {
 public:
  virtual ~ShapeModel() = default;

  /// Number of strain coordinates: bend first, then torsion, then stretch.
  virtual int size() const = 0;
  virtual CoordinateRange bend() const = 0;                    ///< coordinates of the bend
  CoordinateRange torsion() const { return {size() - 2, 1}; }  ///< coordinate of the torsion
  CoordinateRange stretch() const { return {size() - 1, 1}; }  ///< coordinate of the stretch
  /// Scale of each coordinate, in its own unit: changes by it move or turn the tip by about length() or 1 rad.
  virtual StrainVector units() const = 0;

  /// Diagonal of the stiffness matrix K, `U = ½ qᵀ K q` [J], for the stiffness of the DOFs [N/m, N/m, N·m/rad].
  virtual StrainVector stiffness(const PerDof& k) const = 0;
  /// Diagonal of the damping matrix D for the damping coefficients `c` of the DOFs [N·s/m, N·s/m, N·m·s/rad]. Within
  /// each DOF, D is c / k times K for the stiffness `k`, or its limit if k is zero.
  virtual StrainVector damping(const PerDof& c, const PerDof& k) const;

  /// Computes the tip for strain `q` and strain rate `q_dot`, both of length size().
  void tip(const StrainVector& q, const StrainVector& q_dot, TipKinematics& out) const;
  /// Computes the tip for arrays of size() coordinates and rates.
  virtual void tip(const double* q, const double* q_dot, TipOf<double>& out) const = 0;
  /// Computes several tips, one in each lane, for arrays of size() coordinates and rates.
  virtual void tip(const math::Pack* q, const math::Pack* q_dot, TipOf<math::Pack>& out) const = 0;

  /// Whether the strain is the tip's displacement from (0, 0, length()) and its rotation vector: (dx, dy, φx, φy, φz,
  /// dz).
  virtual bool strain_is_pose() const { return false; }

  virtual double extension(const StrainVector& q) const = 0;      ///< change of the rod's length [m]
  virtual double torsion_angle(const StrainVector& q) const = 0;  ///< twist of the tip about the rod [rad]

  /// Pose in H of the rod's cross section at arc length `s` of the rest shape, 0 ≤ s ≤ length() [m].
  virtual RigidTransform section(const StrainVector& q, double s) const = 0;

  /// Changes to equivalent coordinates with less strain, if there are any, and converts the rates accordingly (a
  /// rotation vector beyond half a turn becomes that of the shorter rotation). Returns whether it did.
  virtual bool rechart(StrainVector& q, StrainVector& q_dot) const;

  /// Whether the strain is possible: finite, not inverted, and within the rod's range.
  bool admissible(const StrainVector& q) const { return q.allFinite() && range_used(q) < 1.0; }
  /// Fraction of the rod's range that this strain uses: 0 at rest, 1 at the limit; a convex function of `q`.
  virtual double range_used(const StrainVector& q) const = 0;

  double length() const { return length_; }  ///< length at rest [m]

 protected:
  /// `length` [m] > 0: length at rest.
  explicit ShapeModel(double length) : length_(length) {}

 private:
  double length_;  ///< [m]
};

/// A shape model's rod while it cannot bend. It then turns and stretches along its own axis only, which needs no
/// quadrature however often it is wound up.
class StraightRod {
 public:
  explicit StraightRod(const ShapeModel& shape);  ///< the rod of `shape`, which is not needed afterwards

  /// ShapeModel::tip for the strain `q` without bend. The columns of the bend coordinates are set to zero. Defined in
  /// straight_rod.h.
  template <typename S>
  void tip(const S* q, TipOf<S>& out) const;

 private:
  int torsion_, stretch_;
  double length_;
  double twist_, extension_;  ///< by unit of their coordinates
};

/// Makes a shape model. `length` [m] > 0: length at rest; `slope_stiffness`: see ForkSettings. Throws InputError for an
/// invalid length.
std::shared_ptr<const ShapeModel> make_shape_model(ShapeKind kind, double length,
                                                   std::optional<double> slope_stiffness = std::nullopt);

}  // namespace spring_workbench::rod
