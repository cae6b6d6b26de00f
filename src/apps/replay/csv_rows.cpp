#include "csv_rows.h"

#include <limits>
#include <locale>
#include <sstream>

#include "spring_workbench/validation/names.h"

namespace spring_workbench::replay {
namespace {

/// A row of a CSV file.
class Row {
 public:
  Row() {
    line_.imbue(std::locale::classic());
    line_.precision(17);
  }
  Row& add(double value) {
    separate();
    line_ << value;
    return *this;
  }
  Row& add(const Eigen::Ref<const Eigen::VectorXd>& values) {
    for (Eigen::Index i = 0; i < values.size(); ++i) add(values[i]);
    return *this;
  }
  Row& add(const RigidTransform& X) {
    Quaterniond q(X.linear());
    if (q.w() < 0.0) q.coeffs() = -q.coeffs();
    return add(X.translation()).add(q.coeffs());
  }
  /// Adds a text, quoted if necessary (RFC 4180).
  Row& add(const std::string& text) {
    separate();
    if (text.find_first_of(",\"\r\n") == std::string::npos) {
      line_ << text;
      return *this;
    }
    line_ << '"';
    for (const char c : text) line_ << (c == '"' ? "\"\"" : std::string(1, c));
    line_ << '"';
    return *this;
  }
  std::string end() const { return line_.str() + "\n"; }

 private:
  void separate() {
    if (!empty_) line_ << ',';
    empty_ = false;
  }
  std::ostringstream line_;
  bool empty_ = true;
};

}  // namespace

std::string object_header() { return "t,object,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n"; }

std::string object_rows(double t, const simulation::Simulation& simulation) {
  std::string rows;
  for (const auto& object : simulation.objects()) {
    Row row;
    row.add(t).add(object.name).add(object.X_WO).add(object.V_WO_W.linear).add(object.V_WO_W.angular);
    rows += row.end();
  }
  return rows;
}

std::string fork_header() {
  return "t,fork,tool,held,stretch,bend_x,bend_y,torsion,"
         "handle_x,handle_y,handle_z,handle_qx,handle_qy,handle_qz,handle_qw,"
         "proxy_x,proxy_y,proxy_z,proxy_qx,proxy_qy,proxy_qz,proxy_qw,tip_x,tip_y,tip_z,tip_qx,tip_qy,tip_qz,tip_qw,"
         "tip_fx,tip_fy,tip_fz,tip_mx,tip_my,tip_mz,handle_fx,handle_fy,handle_fz,handle_mx,handle_my,handle_mz,"
         "elastic_energy,kinetic_energy,stretching_force,bending_force,force_angle,weight,weight_mean,weight_"
         "uncertainty,"
         "torque,torque_mean,torque_uncertainty,material_stiffness,material_stiffness_uncertainty,error_bound\n";
}

std::string fork_row(double t, const tools::ToolState& fork, std::size_t hand) {
  Row row;
  row.add(t)
      .add(hand == 0 ? "fork" : "fork_" + std::to_string(hand + 1))
      .add(validation::name_of(fork.tool))
      .add(fork.held_object);
  row.add(fork.stretch).add(fork.bend).add(fork.torsion);
  row.add(fork.X_WH).add(fork.X_WH_proxy).add(fork.X_WE);
  row.add(fork.tip_wrench_W.force).add(fork.tip_wrench_W.moment);
  row.add(fork.handle_wrench_H.force).add(fork.handle_wrench_H.moment);
  row.add(fork.elastic_energy).add(fork.kinetic_energy);
  row.add(fork.stretching_force).add(fork.bending_force).add(fork.force_angle);
  row.add(fork.weight).add(fork.weight_average.mean).add(fork.weight_average.uncertainty);
  row.add(fork.torque).add(fork.torque_average.mean).add(fork.torque_average.uncertainty);
  row.add(fork.material_stiffness).add(fork.material_stiffness_uncertainty);
  row.add(fork.error_bound.value_or(std::numeric_limits<double>::infinity()));
  return row.end();
}

}  // namespace spring_workbench::replay
