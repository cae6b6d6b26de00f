#pragma once

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <vector>

#include "bullet_contacts.h"
#include "bullet_shape.h"
#include "constants.h"
#include "driven_solver.h"
#include "spring_workbench/geometry/box_gap.h"
#include "spring_workbench/rigid_bodies/rigid_world.h"

namespace spring_workbench::rigid_bodies {

/// Bullet turns its trees by where their nodes lie in memory, and the order of new pairs goes with it. Here they are
/// left as they are, as long as they have less than 200 leaves: the same calls give the same bits in any memory.
class BroadphaseOfAnyMemory final : public btDbvtBroadphase {
 public:
  void calculateOverlappingPairs(btDispatcher* dispatcher) override {
    m_dupdates = for_no_pass(m_sets[0].m_leaves);
    m_fupdates = for_no_pass(m_sets[1].m_leaves);
    btDbvtBroadphase::calculateOverlappingPairs(dispatcher);
  }

 private:
  /// Bullet makes 1 + leaves · percentage / 100 passes.
  static int for_no_pass(int leaves) { return leaves > 0 && leaves < 200 ? -(99 + leaves) / leaves : 0; }
};

/// Bullet's world, with what rests taken out of it and driven bodies in its solver.
class BulletWorld final : public RigidWorld {
 public:
  explicit BulletWorld(const scene::Scene& scene);
  ~BulletWorld() override;
  BulletWorld(const BulletWorld&) = delete;
  BulletWorld& operator=(const BulletWorld&) = delete;

  void step(double h, std::vector<DrivenBody>& driven) override;
  void undo_step() override;
  void place(std::size_t body, const RigidTransform& X_WO, const Twist& V_WO_W, bool awake) override;
  const RigidTransform& pose(std::size_t body) const override { return items_[body].X_WO; }
  const Twist& velocity(std::size_t body) const override { return items_[body].V_WO_W; }
  bool awake(std::size_t body) const override { return awake(items_[body]); }
  Bodies movable_near(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO, double h,
                      const Bodies& carried, std::size_t max_count) const override;
  bool may_touch(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO,
                 double margin) const override;
  double collision_free_fraction(std::size_t body, const RigidTransform& X0_WO,
                                 const RigidTransform& X1_WO) const override {
    return free_fraction(body, X0_WO, X1_WO, true, unswept);
  }
  double admissible_fraction(std::size_t body, const RigidTransform& X0_WO,
                             const RigidTransform& X1_WO) const override {
    return std::min(free_fraction(body, X0_WO, X1_WO, false, unswept_of_free),
                    solver_.residual() > solved_to ? 0.5 : 1.0);
  }
  double admissible_fraction_of_free() const override;
  double first_bounce() const override { return solver_.bounces_at(); }
  double path_error() const override { return path_error_; }
  bool solved() const override {
    return solver_.residual() <= solved_to && solver_.deepest() <= deepest_solved && !dispatcher_.contacts_missing;
  }
  const std::vector<WorldContact>& contacts() const override { return contacts_; }
  const std::vector<std::size_t>& bodies_near() const override { return in_world_; }
  void archive(math::StateArchive& state) override;

 private:
  struct Item {
    bool movable = false;
    bool massless = false;  ///< movable, but only by what drives it
    Eigen::AlignedBox3d box_O;
    double radius = 0.0;
    std::vector<geometry::OutlineBox> outline_O;  ///< a box around each shape
    RigidTransform X_WO = RigidTransform::Identity();
    Twist V_WO_W;
    RigidTransform X_OB = RigidTransform::Identity();  ///< principal axes, where Bullet's tensors are diagonal
    btDbvtNode* leaf = nullptr;                        ///< null where there is nothing to touch
    std::unique_ptr<BulletShape> shape;                ///< these two are made when something first comes near
    std::unique_ptr<btRigidBody> bullet;
    bool in_world = false;
    bool driven = false;                                  ///< in the present step
    long near_at = 0;                                     ///< step in which something awake was last near
    btTransform X_at_query = btTransform::getIdentity();  ///< of `bullet`, when contacts were last looked for
  };

  /// Where the last step found a body.
  struct BeforeStep {
    std::size_t body;
    RigidTransform X_WO;
    Twist V_WO_W;
    int activation;
    double slow_for;  ///< [s]
  };

  void make_bullet(std::size_t index);
  void enter(std::size_t index);
  void leave(std::size_t index);
  /// What is near an awake body, and what is near that: what one pushes may push the next one in the same step.
  void enter_what_is_near(double h);
  void put(std::size_t index, const RigidTransform& X_WO, const Twist& V_WO_W);
  void update_box(Item& item);
  std::vector<std::size_t> inside(const Eigen::AlignedBox3d& box_W) const;
  Eigen::AlignedBox3d path_of(std::size_t index, double h) const;
  Eigen::AlignedBox3d swept(const Item& item, const RigidTransform& X0_WO, const RigidTransform& X1_WO,
                            double margin) const;
  /// Fraction of the path on which the body is free; `untouched`: of contact, too. `may_go_unswept`: see unswept.
  double free_fraction(std::size_t body, const RigidTransform& X0_WO, const RigidTransform& X1_WO, bool untouched,
                       double may_go_unswept) const;
  RigidTransform pose_before_step(std::size_t body) const;
  void begin_step();
  void begin_driving(std::vector<DrivenBody>& driven, double h);
  void end_driving(const std::vector<DrivenBody>& driven);
  void take_states(double h);
  void take_contacts(double h);
  btRigidBody& object(int index);  ///< by user index; the bench's is −1
  // Parts of archive(); `objects` by user index, in Bullet's order.
  void archive_body(math::StateArchive& state, int index);
  void archive_pairs(math::StateArchive& state, const std::vector<int>& objects);
  /// Finds the contacts of a pair of bodies, with at least `parts` pairs of parts of their shapes.
  void find_contacts_of(btBroadphasePair& pair, int parts);
  void archive_manifolds(math::StateArchive& state);
  void archive_broadphase(math::StateArchive& state, const std::vector<int>& objects);
  void archive_tree(math::StateArchive& state, btDbvt& tree, const std::vector<int>& objects);
  bool awake(const Item& item) const {
    return item.in_world && item.movable && (item.driven || (item.bullet->isActive() && !item.massless));
  }

  scene::Scene scene_;
  std::vector<Item> items_;            ///< parallel to the scene's bodies
  btDbvt tree_;                        ///< of all of them
  std::vector<std::size_t> in_world_;  ///< those that Bullet has to look at
  ContactConfiguration configuration_;
  DispatcherForSleepers dispatcher_{&configuration_};
  BroadphaseOfAnyMemory broadphase_;
  friction::Surfaces surfaces_{scene::compliances(scene_)};
  DrivenSolver solver_{surfaces_, scene_.gravity};
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btStaticPlaneShape bench_shape_;
  std::unique_ptr<btRigidBody> bench_body_;
  std::vector<WorldContact> contacts_;
  std::vector<BeforeStep> before_step_;
  double path_error_ = 0.0;
  long steps_ = 0;
};

}  // namespace spring_workbench::rigid_bodies
