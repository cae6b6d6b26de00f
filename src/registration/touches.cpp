#include "spring_workbench/registration/touches.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "millimetres.h"
#include "spring_workbench/config/yaml_fields.h"

namespace spring_workbench::registration {
namespace {

Vector3d read_point(const YAML::Node& node, const std::string& where, const std::string& key) {
  const std::vector<double> p = config::read_numbers(node, where, key, 3);
  return {p[0], p[1], p[2]};
}

std::string file_text(const RigidTransform& X_BT, const Vector3d& tip, const std::string& comment) {
  const Vector3d p = X_BT.translation();
  const Quaterniond q(X_BT.linear());
  std::ostringstream out;
  out << comment << std::setprecision(9) << "offset: [" << p.x() << ", " << p.y() << ", " << p.z() << ", " << q.x()
      << ", " << q.y() << ", " << q.z() << ", " << q.w() << "]\n"
      << "tip: [" << tip.x() << ", " << tip.y() << ", " << tip.z() << "]\n";
  return out.str();
}

}  // namespace

StoredRegistration read_registration(const YAML::Node& map, const std::string& where) {
  StoredRegistration result;
  if (!map.IsMap()) return result;
  if (map["offset"]) result.X_BT = config::read_pose(map["offset"], where, "offset");
  if (map["tip"]) result.p_ST = read_point(map["tip"], where, "tip");
  return result;
}

StoredRegistration read_registration_file(const std::string& path) {
  const YAML::Node map = config::load_yaml_file(path);
  config::check_keys(map, path, "", {"offset", "tip"});
  StoredRegistration result = read_registration(map, path);
  result.p_ST = config::read_required(map, path, "", "tip", read_point);
  return result;
}

std::vector<Landmark> read_landmarks(const std::string& path) {
  const YAML::Node map = config::load_yaml_file(path);
  config::check_keys(map, path, "", {"landmarks"});
  const std::string rule = "a list of {name, position}";
  if (!map["landmarks"]) validation::refuse_missing(config::place(map, path), "landmarks", rule);
  if (!map["landmarks"].IsSequence()) validation::refuse(config::place(map["landmarks"], path), "landmarks", rule);
  std::vector<Landmark> landmarks;
  for (const YAML::Node& entry : map["landmarks"]) {
    config::check_keys(entry, path, "landmarks.", {"name", "position"});
    landmarks.push_back({config::read_required(entry, path, "landmarks.", "name", config::read_string),
                         config::read_required(entry, path, "landmarks.", "position", read_point),
                         {}});
  }
  return landmarks;
}

std::vector<std::vector<motion::StylusSample>> presses(const std::vector<motion::StylusSample>& samples) {
  std::vector<std::vector<motion::StylusSample>> result;
  bool was_down = false;
  for (const motion::StylusSample& sample : samples) {
    if (sample.button && !was_down) result.emplace_back();
    if (sample.button) result.back().push_back(sample);
    was_down = sample.button;
  }
  return result;
}

std::vector<Landmark> touched_landmarks(std::vector<Landmark> landmarks,
                                        const std::vector<std::vector<motion::StylusSample>>& touches,
                                        double largest_residual) {
  if (touches.size() != landmarks.size()) {
    validation::refuse(
        "registration", "touches",
        "one per landmark (" + std::to_string(landmarks.size()) + "), got " + std::to_string(touches.size()));
  }
  for (std::size_t i = 0; i < touches.size(); ++i) {
    Vector3d mean = Vector3d::Zero();
    for (const motion::StylusSample& sample : touches[i]) {
      mean += sample.X.translation() / static_cast<double>(touches[i].size());
    }
    for (const motion::StylusSample& sample : touches[i]) {
      const double off = (sample.X.translation() - mean).norm();
      if (off <= largest_residual) continue;
      validation::refuse("registration", "touch of " + landmarks[i].name,
                         "at most " + millimetres(largest_residual) + " from its mean while the button is down, got " +
                             millimetres(off));
    }
    landmarks[i].p_T = mean;
  }
  return landmarks;
}

std::vector<motion::StylusSample> as_sent(std::vector<motion::StylusSample> samples,
                                          const StoredRegistration& registration) {
  for (motion::StylusSample& sample : samples) {
    sample.X = registration.X_BT * sample.X * Eigen::Translation3d(registration.p_ST);
  }
  return samples;
}

std::string find_tip(const std::vector<motion::StylusSample>& samples, const StoredRegistration& present,
                     double largest_residual) {
  std::vector<RigidTransform> poses;
  for (const motion::StylusSample& sample : samples) {
    if (sample.button) poses.push_back(sample.X);
  }
  const PivotCalibration found = calibrate_tip(poses, largest_residual);
  std::ostringstream report;
  report << "# tip: rms " << 1e3 * found.rms << " mm over " << poses.size() << " poses\n";
  return file_text(present.X_BT, present.p_ST + found.p_ST, report.str());
}

std::string find_tracker(const std::vector<motion::StylusSample>& samples, const std::vector<Landmark>& known,
                         const StoredRegistration& present, double largest_residual) {
  const std::vector<Landmark> landmarks = touched_landmarks(known, presses(samples), largest_residual);
  const Registration found = register_tracker(landmarks, largest_residual);
  std::ostringstream report;
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    report << "# " << landmarks[i].name << ": residual " << 1e3 * found.residuals[i] << " mm\n";
  }
  report << "# residuals' rms " << 1e3 * found.rms << " mm; a touch is off by " << 1e3 * found.touch_error
         << " mm along an axis\n# expected error: position " << 1e3 * found.position_error
         << " mm at the landmarks' middle, angle " << 1e3 * found.angle_error
         << " mrad\n# check: no other order of the touches fits\n";
  return file_text(found.X_BT * present.X_BT, present.p_ST, report.str());
}

}  // namespace spring_workbench::registration
