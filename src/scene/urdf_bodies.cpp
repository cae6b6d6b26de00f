#include "urdf_bodies.h"

#include <filesystem>

#include "mass.h"
#include "spring_workbench/scene/number_rules.h"

namespace spring_workbench::scene {
namespace {

RigidTransform to_transform(const urdf::Pose& pose, const std::string& where) {
  const urdf::Rotation& q = pose.rotation;
  const Vector3d p(pose.position.x, pose.position.y, pose.position.z);
  const Quaterniond rotation(q.w, q.x, q.y, q.z);
  if (!p.allFinite() || !rotation.coeffs().allFinite() || !(rotation.norm() > 0.0)) {
    validation::refuse(where, "origin", "a finite pose");
  }
  return make_transform(p, rotation);
}

/// The links of a body: its first link and those attached to it by fixed joints, each with its pose in the first link's
/// frame.
struct LinkGroup {
  const urdf::Link* first = nullptr;
  bool movable = false;
  RigidTransform X_WL = RigidTransform::Identity();
  std::vector<std::pair<const urdf::Link*, RigidTransform>> links;
};

/// Divides the tree of links into groups.
class Grouping {
 public:
  Grouping(const UrdfFile& file, std::vector<std::string>& warnings) : file_(file), warnings_(warnings) {}

  std::vector<LinkGroup> run(const RigidTransform& X_WR) {
    const urdf::Link* root = file_.model->getRoot().get();
    start(root, X_WR, !is_bench_scene(file_) && carries_mass(*root));
    walk(root, RigidTransform::Identity(), 0);
    return std::move(groups_);
  }

 private:
  bool carries_mass(const urdf::Link& root) {
    const bool mass = file_.unreadable_inertials.count(root.name) > 0 || (root.inertial && root.inertial->mass != 0.0);
    if (!mass) warnings_.push_back(file_.where(root.name) + ": the root has no mass: the body is fixed");
    return mass;
  }

  std::size_t start(const urdf::Link* link, const RigidTransform& X_WL, bool movable) {
    groups_.push_back({link, movable, X_WL, {{link, RigidTransform::Identity()}}});
    return groups_.size() - 1;
  }

  /// `X_LK`: pose of the link in the frame of its group's first link.
  void walk(const urdf::Link* link, const RigidTransform& X_LK, std::size_t group) {
    const bool on_bench = is_bench_scene(file_) && link == file_.model->getRoot().get();
    for (const urdf::LinkSharedPtr& child : link->child_links) {
      const urdf::Joint& joint = *child->parent_joint;
      const RigidTransform X_LC = X_LK * to_transform(joint.parent_to_joint_origin_transform, file_.where(child->name));
      const bool floats = joint.type == urdf::Joint::FLOATING;
      if (!floats && joint.type != urdf::Joint::FIXED) {
        warnings_.push_back(file_.where(child->name) + ": joint '" + joint.name +
                            "' is neither fixed nor floating: it is held at zero");
      }
      if (floats || on_bench) {
        const std::size_t own = start(child.get(), groups_[group].X_WL * X_LC, floats);
        walk(child.get(), RigidTransform::Identity(), own);
      } else {
        groups_[group].links.emplace_back(child.get(), X_LC);
        walk(child.get(), X_LC, group);
      }
    }
  }

  const UrdfFile& file_;
  std::vector<std::string>& warnings_;
  std::vector<LinkGroup> groups_;
};

/// Makes the body of a group of links.
class BodyBuilder {
 public:
  BodyBuilder(const UrdfFile& file, MeshCache& meshes, std::vector<std::string>& warnings)
      : file_(file),
        folder_(std::filesystem::path(file.path).parent_path().string()),
        meshes_(meshes),
        warnings_(warnings) {}

  Body build(const LinkGroup& group, const Material& material) {
    Body body;
    body.name = group.first->name;
    body.movable = group.movable;
    body.material = material;
    RigidMass mass_L;
    for (const auto& [link, X_LK] : group.links) {
      const std::vector<geometry::Shape> collision = make_shapes(*link, X_LK, link->collision_array);
      const std::vector<geometry::Shape> visual = make_shapes(*link, X_LK, link->visual_array);
      if (group.movable) {
        mass_L = sum(mass_L, link_mass(*link, X_LK, collision.empty() ? visual : collision, material.density));
      }
      body.collision.insert(body.collision.end(), collision.begin(), collision.end());
      const std::vector<geometry::Shape>& seen = visual.empty() ? collision : visual;
      body.visual.insert(body.visual.end(), seen.begin(), seen.end());
    }
    body.X_WO = group.X_WL;
    if (group.movable) place_at_centre_of_mass(mass_L, body);
    return body;
  }

 private:
  void place_at_centre_of_mass(const RigidMass& given_L, Body& body) {
    const std::string where = file_.where(body.name);
    const std::vector<geometry::Shape>& shapes = body.collision.empty() ? body.visual : body.collision;
    const RigidMass mass = repaired_mass(given_L, shapes, body.material.density, where, warnings_);
    if (body.collision.empty()) warnings_.push_back(where + ": no collision shape: the body touches nothing");
    validation::check_number(where, "mass", mass.mass, mass_rule());
    body.mass_properties = {mass.mass, mass.inertia};
    body.X_OL.translation() = -mass.centre;
    body.X_WO = body.X_WO * body.X_OL.inverse();
    for (geometry::Shape& shape : body.collision) shape.X_OS = body.X_OL * shape.X_OS;
    for (geometry::Shape& shape : body.visual) shape.X_OS = body.X_OL * shape.X_OS;
  }

  /// Mass of a link from the URDF, in the frame of the group's first link; zero if the URDF gives none, and from its
  /// shapes if the URDF's cannot be read or is not positive.
  RigidMass link_mass(const urdf::Link& link, const RigidTransform& X_LK, const std::vector<geometry::Shape>& shapes,
                      double density) {
    const std::string where = file_.where(link.name);
    const auto unreadable = file_.unreadable_inertials.find(link.name);
    if (unreadable != file_.unreadable_inertials.end()) {
      const RigidMass solid = solid_mass(shapes, density, where, warnings_);
      const double mass = unreadable->second.value_or(solid.mass);
      if (!(solid.mass > 0.0)) return {mass, X_LK.translation(), Matrix3d::Zero()};
      return {mass, solid.centre, solid.inertia * (mass / solid.mass)};
    }
    if (!link.inertial) return {};
    const urdf::Inertial& i = *link.inertial;
    if (!(i.mass > 0.0)) {
      const RigidMass solid = solid_mass(shapes, density, where, warnings_);
      warnings_.push_back(
          where + ": mass " + validation::number_text(i.mass) + " is not positive: " +
          (solid.mass > 0.0 ? "mass and inertia of its shapes are used" : "the link is treated as massless"));
      return solid;
    }
    Matrix3d inertia;
    inertia << i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz;
    return transformed(X_LK * to_transform(i.origin, where), {i.mass, Vector3d::Zero(), inertia});
  }

  /// Shapes of collision or visual elements, in the frame of the group's first link. A visual element whose mesh does
  /// not exist is left out, with a warning.
  template <typename Element>
  std::vector<geometry::Shape> make_shapes(const urdf::Link& link, const RigidTransform& X_LK,
                                           const std::vector<Element>& elements) {
    constexpr bool visual = std::is_same_v<Element, urdf::VisualSharedPtr>;
    const std::string where = file_.where(link.name);
    std::vector<geometry::Shape> shapes;
    for (const Element& element : elements) {
      geometry::Shape& shape = shapes.emplace_back();
      shape.X_OS = X_LK * to_transform(element->origin, where);
      try {
        shape.geometry = make_geometry(*element->geometry, where);
      } catch (const MissingFile& missing) {
        if (!visual) throw;
        warnings_.push_back(missing.what() + std::string(": it is not drawn"));
        shapes.pop_back();
        continue;
      }
      if constexpr (visual) {
        if (!element->material || !element->material->texture_filename.empty()) continue;
        const urdf::Color& c = element->material->color;  // urdfdom accepts only 0 … 1
        shape.color = Eigen::Vector4f(c.r, c.g, c.b, c.a).cast<double>();
        shape.color_given = true;
      }
    }
    return shapes;
  }

  geometry::Geometry make_geometry(const urdf::Geometry& geometry, const std::string& where) {
    switch (geometry.type) {
      case urdf::Geometry::BOX: {
        const urdf::Vector3& d = static_cast<const urdf::Box&>(geometry).dim;
        for (const double edge : {d.x, d.y, d.z})
          validation::check_number(where, "box size", edge, validation::positive().in("m"));
        return geometry::Box{Vector3d(d.x, d.y, d.z)};
      }
      case urdf::Geometry::SPHERE: {
        const double radius = static_cast<const urdf::Sphere&>(geometry).radius;
        validation::check_number(where, "sphere radius", radius, validation::positive().in("m"));
        return geometry::Sphere{radius};
      }
      case urdf::Geometry::CYLINDER: {
        const auto& c = static_cast<const urdf::Cylinder&>(geometry);
        validation::check_number(where, "cylinder radius", c.radius, validation::positive().in("m"));
        validation::check_number(where, "cylinder length", c.length, validation::positive().in("m"));
        return geometry::Cylinder{c.radius, c.length};
      }
      case urdf::Geometry::MESH:
        break;
    }
    const auto& m = static_cast<const urdf::Mesh&>(geometry);
    return meshes_.load(m.filename, Vector3d(m.scale.x, m.scale.y, m.scale.z), folder_, where);
  }

  const UrdfFile& file_;
  std::string folder_;
  MeshCache& meshes_;
  std::vector<std::string>& warnings_;
};

}  // namespace

bool is_bench_scene(const UrdfFile& file) {
  const std::string& root = file.model->getRoot()->name;
  return root == "world" || root == "workbench";
}

std::vector<Body> build_bodies(const UrdfFile& file, const RigidTransform& X_WR, const MaterialOf& material_of,
                               MeshCache& meshes, std::vector<std::string>& warnings) {
  BodyBuilder builder(file, meshes, warnings);
  std::vector<Body> bodies;
  for (const LinkGroup& group : Grouping(file, warnings).run(X_WR)) {
    Body body = builder.build(group, material_of(group.first->name));
    const bool empty = body.collision.empty() && body.visual.empty();
    if (empty && !body.movable) {
      if (!is_bench_scene(file)) warnings.push_back(file.where(body.name) + ": skipped: neither mass nor shape");
      continue;
    }
    bodies.push_back(std::move(body));
  }
  return bodies;
}

}  // namespace spring_workbench::scene
