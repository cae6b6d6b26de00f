#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

namespace spring_workbench::friction {

/// Projection into the cone |(x1, x2)| ≤ μ x0.
Eigen::Vector3d into_cone(const Eigen::Vector3d& x, double friction);

/// De Saxcé's shift of a motion: with it, what the law of sliding says is that the motion is in the dual cone.
inline double shift(const Eigen::Vector3d& motion, double friction) {
  return friction == 0.0 ? 0.0 : friction * motion.tail<2>().norm();
}

/// The contacts of a problem in coordinates in which every body's response is the identity, and every contact's has the
/// trace 3: then no mass, no stiffness and no unit is far from any other.
class ReducedContacts {
 public:
  struct Body {
    Eigen::Index first, size;  ///< of its reduced coordinates
    Eigen::Index dofs;
    std::size_t factor;  ///< where its factor, dofs × size, begins: response = factor · factorᵀ
  };
  struct Part {
    std::size_t body;
    Eigen::Index first, size;  ///< reduced coordinates
    std::size_t jacobian;      ///< where its Jacobian by them, 3 × size, begins
  };
  struct Contact {
    std::size_t parts_begin, parts_end;
    double friction;
    Eigen::Vector3d motion;  ///< without loads, scaled
    Eigen::Vector3d load;    ///< scaled
    double scale = 0.0;      ///< of the motion; zero if nothing moves the contact, which then has no load
    Eigen::Matrix3d response, inverse;
    double across;  ///< largest response across the normal
    bool open;      ///< in the last iteration on the way forward
  };

  void clear();
  std::size_t add_body(const Eigen::Ref<const Eigen::MatrixXd>& response);
  std::size_t add_contact(double friction, const Eigen::Vector3d& motion, const Eigen::Vector3d& load);
  void add_part(std::size_t body, const Eigen::Ref<const Eigen::Matrix3Xd>& jacobian);
  /// Scales the contacts, once they are all there, and finds the motion under the loads assumed. Returns the largest
  /// motion of a contact that can be moved, without loads; infinite if one is not finite.
  double prepare();

  /// One symmetric Gauss–Seidel iteration; returns the largest residual met on the way forward.
  double iterate();
  /// See ContactProblem::Result.
  double residual() const;
  /// Takes scaled loads, three per contact, and the motion under them.
  void set_loads(const Eigen::VectorXd& loads);
  Eigen::VectorXd loads() const;
  Eigen::VectorXd change(std::size_t body) const;

  Eigen::Index size() const { return size_; }
  const std::vector<Body>& bodies() const { return bodies_; }
  const std::vector<Part>& parts() const { return parts_; }
  const std::vector<Contact>& contacts() const { return contacts_; }
  Eigen::Map<const Eigen::Matrix3Xd> jacobian(const Part& part) const {
    return {jacobians_.data() + part.jacobian, 3, part.size};
  }
  const Eigen::VectorXd& reduced() const { return reduced_; }
  /// Change of a contact's motion if the bodies' motion changes by `reduced`; and the motion itself.
  Eigen::Vector3d change(const Contact& contact, const Eigen::VectorXd& reduced) const;
  Eigen::Vector3d motion(const Contact& contact, const Eigen::VectorXd& reduced) const {
    return contact.motion + change(contact, reduced);
  }
  /// Adds what a load does to the bodies.
  void apply(const Contact& contact, const Eigen::Vector3d& load, Eigen::VectorXd& reduced) const;

 private:
  void relax(Contact& contact, Eigen::Vector3d motion);

  std::vector<Body> bodies_;
  std::vector<Part> parts_;
  std::vector<Contact> contacts_;
  std::vector<double> factors_, jacobians_;
  Eigen::VectorXd reduced_;
  Eigen::Index size_ = 0;
};

/// Whether a contact that moves by `u` without a load needs none.
inline bool is_open(const ReducedContacts::Contact& contact, const Eigen::Vector3d& u) {
  return contact.load[0] == 0.0 && u[0] >= 0.0;
}
/// Residual of a contact that moves by `u`.
double residual_at(const ReducedContacts::Contact& contact, Eigen::Vector3d u);

}  // namespace spring_workbench::friction
