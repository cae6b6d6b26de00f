#pragma once

#include <memory>
#include <string>
#include <vector>

#include "spring_workbench/math/pack.h"
#include "spring_workbench/rod/settings.h"

namespace spring_workbench::rod {

/// Largest number of strain coordinates of a shape model.
constexpr int max_strain_coordinates = 6;

/// One number per strain coordinate. There are at most six, so it needs no heap.
using StrainVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_strain_coordinates, 1>;
/// A square matrix over the strain coordinates.
using StrainMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_strain_coordinates, max_strain_coordinates>;
/// A vector [x; y; z] per strain coordinate, one in each column.
using StrainJacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, max_strain_coordinates>;
/// A twist [linear; angular] per strain coordinate, one in each column.
using TwistJacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, max_strain_coordinates>;

/// Pose of the fork's tip E in the handle frame H and its motion with the strain; all vectors in H axes.
struct TipKinematics {
  Matrix3d R_HE = Matrix3d::Identity();      ///< rotation of the tip
  Vector3d p_HE = Vector3d::Zero();          ///< position of the tip [m]
  StrainJacobian angular;                    ///< tip's angular velocity = angular · q̇
  StrainJacobian linear;                     ///< tip's velocity = linear · q̇
  Vector3d angular_bias = Vector3d::Zero();  ///< angular acceleration = angular · q̈ + angular_bias [rad/s²]
  Vector3d linear_bias = Vector3d::Zero();   ///< acceleration = linear · q̈ + linear_bias [m/s²]
};

/// TipKinematics for one strain (`S` double) or for several at once (`S` a math::Pack).
template <typename S>
struct TipOf {
  math::Mat3x3<S> R_HE;                           ///< rotation of the tip
  math::Vec3<S> p_HE;                             ///< position of the tip [m]
  math::Vec3<S> angular[max_strain_coordinates];  ///< columns of TipKinematics::angular
  math::Vec3<S> linear[max_strain_coordinates];   ///< columns of TipKinematics::linear
  math::Vec3<S> angular_bias;                     ///< TipKinematics::angular_bias [rad/s²]
  math::Vec3<S> linear_bias;                      ///< TipKinematics::linear_bias [m/s²]
};

/// The strain coordinates of a DOF: from `begin` to `begin + count - 1`.
struct CoordinateRange {
  int begin = 0;  ///< index of the first coordinate
  int count = 0;  ///< number of coordinates
};

/// The curve of the fork's spring part as a function of a few strain coordinates q (doc/model.md, "Shape models";
/// paper, section 4). The rod is clamped to the handle at H. With q = 0 it is straight along z of H. A shape model is
/// immutable and knows neither time nor mass. Units of q: bend (curvatures) and torsion (twist per length) [1/m],
/// stretch [–]. The coordinates of a `bushing`, also called strain, are displacements [m] and a rotation vector [rad].
/// Rates are in these units per second.
class ShapeModel {
 public:
  virtual ~ShapeModel() = default;

  /// Number of strain coordinates. Their order is bend, torsion, stretch.
  virtual int size() const = 0;
  virtual CoordinateRange bend() const = 0;                    ///< coordinates of the bend
  CoordinateRange torsion() const { return {size() - 2, 1}; }  ///< coordinate of the torsion
  CoordinateRange stretch() const { return {size() - 1, 1}; }  ///< coordinate of the stretch
  /// Scale of each coordinate, in its own unit. A change by the scale moves the tip by about length() or turns it by
  /// about 1 rad.
  virtual StrainVector units() const = 0;

  /// Returns the diagonal of the stiffness matrix K, `U = ½ qᵀ K q` [J], for the stiffness `k` [N/m, N/m, N·m/rad].
  virtual StrainVector stiffness(const PerDof& k) const = 0;
  /// Returns the diagonal of the damping matrix D for the coefficients `c` [N·s/m, N·s/m, N·m·s/rad]. Within each DOF,
  /// D is c / k times K for the stiffness `k`, or the limit of this product if k is zero.
  virtual StrainVector damping(const PerDof& c, const PerDof& k) const;

  /// Computes the tip for strain `q` and strain rate `q_dot`, both of length size().
  void tip(const StrainVector& q, const StrainVector& q_dot, TipKinematics& out) const;
  /// Computes the tip for arrays of size() coordinates and rates.
  virtual void tip(const double* q, const double* q_dot, TipOf<double>& out) const = 0;
  /// Computes several tips, one in each lane of a pack, for arrays of size() coordinates and rates.
  virtual void tip(const math::Pack* q, const math::Pack* q_dot, TipOf<math::Pack>& out) const = 0;

  /// Optional. Whether the strain is (dx, dy, φx, φy, φz, dz): the tip's displacement from (0, 0, length()) and its
  /// rotation vector. If not overridden: false.
  virtual bool strain_is_pose() const { return false; }

  virtual double extension(const StrainVector& q) const = 0;      ///< change of the rod's length [m]
  virtual double torsion_angle(const StrainVector& q) const = 0;  ///< twist of the tip about the rod [rad]

  /// Returns the pose in H of the rod's cross section at arc length `s` of the rest shape, 0 ≤ s ≤ length() [m].
  virtual RigidTransform section(const StrainVector& q, double s) const = 0;

  /// Optional. Replaces a strain and its rates by equivalent ones with less strain, if there are any. For example, a
  /// rotation vector beyond half a turn becomes the vector of the shorter rotation. Returns whether it changed them. If
  /// not overridden: returns false.
  virtual bool rechart(StrainVector& q, StrainVector& q_dot) const;

  /// Returns whether the strain is possible: finite, not inverted, and within the rod's range.
  bool admissible(const StrainVector& q) const { return q.allFinite() && range_used(q) < 1.0; }
  /// Returns the fraction of the rod's range that this strain uses: 0 at rest, 1 at the limit. It is convex in `q`.
  virtual double range_used(const StrainVector& q) const = 0;

  double length() const { return length_; }  ///< length at rest [m]

 protected:
  /// `length` [m] > 0: length at rest.
  explicit ShapeModel(double length) : length_(length) {}

 private:
  double length_;  ///< [m]
};

/// Internal: a shape model's rod while it cannot bend. It only turns about its axis and stretches along it. Its tip
/// therefore needs no quadrature, however often the rod is wound up.
class StraightRod {
 public:
  explicit StraightRod(const ShapeModel& shape);  ///< the rod of `shape`, which is not needed afterwards

  /// ShapeModel::tip for the strain `q` without bend. The columns of the bend coordinates are set to zero.
  template <typename S>
  void tip(const S* q, TipOf<S>& out) const;

 private:
  int torsion_, stretch_;
  double length_;
  double twist_, extension_;  ///< by unit of their coordinates
};

/// Makes a shape model. `length` [m] > 0: length at rest. `slope_stiffness`: see ForkSettings. Throws InputError if the
/// length is invalid.
std::shared_ptr<const ShapeModel> make_shape_model(ShapeKind kind, double length,
                                                   std::optional<double> slope_stiffness = std::nullopt);

}  // namespace spring_workbench::rod
