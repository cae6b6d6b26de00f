#include "benchmark/contact/shown.h"

#include "spring_workbench/geometry/shape_queries.h"

namespace spring_workbench::benchmark {
namespace {

void write_points(const std::vector<Vector3d>& points, const RigidTransform& X_WS, std::ostream& out) {
  out << "\"points\": [";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector3d p = X_WS * points[i];
    out << (i > 0 ? ", [" : "[") << p.x() << ", " << p.y() << ", " << p.z() << ']';
  }
  out << ']';
}

void write_shape(const geometry::Shape& shape, const RigidTransform& X_WO, std::ostream& out) {
  const RigidTransform X_WS = X_WO * shape.X_OS;
  if (const auto* box = std::get_if<geometry::Box>(&shape.geometry)) {
    const auto corners = geometry::corners(0.5 * box->size);
    out << "\"kind\": \"box\", ";
    write_points({corners.begin(), corners.end()}, X_WS, out);
  } else if (const auto* sphere = std::get_if<geometry::Sphere>(&shape.geometry)) {
    out << "\"kind\": \"sphere\", \"radius\": " << sphere->radius << ", ";
    write_points({Vector3d::Zero()}, X_WS, out);
  } else if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape.geometry)) {
    out << "\"kind\": \"cylinder\", \"radius\": " << cylinder->radius << ", ";
    const Vector3d end = 0.5 * cylinder->length * Vector3d::UnitZ();
    write_points({-end, end}, X_WS, out);
  } else {
    const geometry::TriangleMesh& mesh = *std::get<geometry::MeshPtr>(shape.geometry);
    out << "\"kind\": \"mesh\", \"triangles\": [";
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const Eigen::Vector3i& t = mesh.triangles[i];
      out << (i > 0 ? ", [" : "[") << t.x() << ", " << t.y() << ", " << t.z() << ']';
    }
    out << "], ";
    write_points(mesh.vertices, X_WS, out);
  }
}

}  // namespace

void show(const ContactTrial& trial, double time, std::ostream& out) {
  TrialRun run(trial);
  while (run.time() < time - 1e-9 && run.advance()) continue;
  const std::vector<RigidTransform> poses = run.poses();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const scene::Body& body = trial.scene.bodies[i];
    for (const geometry::Shape& shape : body.collision) {
      out << "{\"body\": \"" << body.name << "\", \"movable\": " << (body.movable ? "true" : "false")
          << ", \"held\": " << (body.name == trial.settings.grasp.object ? "true" : "false") << ", ";
      write_shape(shape, poses[i], out);
      out << "}\n";
    }
  }
  out.flush();
}

}  // namespace spring_workbench::benchmark
