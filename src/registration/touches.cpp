#include "spring_workbench/registration/touches.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "spring_workbench/config/yaml_fields.h"

namespace spring_workbench::registration {
namespace {

Vector3d read_point(const YAML::Node& node, const std::string& where, const std::string& key) {
  const std::vector<double> p = config::read_numbers(node, where, key, 3);
  return {p[0], p[1], p[2]};
}

}  // namespace

StoredRegistration read_registration(const YAML::Node& map, const std::string& where) {
  StoredRegistration result;
  if (!map.IsMap()) return result;
  if (map["offset"]) result.X_BT = config::read_pose(map["offset"], where, "offset");
  if (map["tip"]) result.p_ST = read_point(map["tip"], where, "tip");
  return result;
}

std::string write_registration(const StoredRegistration& registration, const std::string& comment) {
  const Vector3d p = registration.X_BT.translation(), tip = registration.p_ST;
  const Quaterniond q(registration.X_BT.linear());
  std::ostringstream out;
  out << comment << std::setprecision(9) << "offset: [" << p.x() << ", " << p.y() << ", " << p.z() << ", " << q.x()
      << ", " << q.y() << ", " << q.z() << ", " << q.w() << "]\n"
      << "tip: [" << tip.x() << ", " << tip.y() << ", " << tip.z() << "]\n";
  return out.str();
}

std::vector<Landmark> read_landmarks(const std::string& path) {
  const YAML::Node map = config::load_yaml_file(path);
  config::check_keys(map, path, "", {"landmarks"});
  if (!map["landmarks"] || !map["landmarks"].IsSequence()) {
    validation::refuse(path, "landmarks", "(no list)", "a list of {name, position}");
  }
  std::vector<Landmark> landmarks;
  for (const YAML::Node& entry : map["landmarks"]) {
    config::check_keys(entry, path, "landmarks.", {"name", "position"});
    if (!entry["name"] || !entry["position"])
      validation::refuse(path, "landmarks", "an entry without them", "{name, position}");
    landmarks.push_back(
        {config::read_string(entry["name"], path, "name"), read_point(entry["position"], path, "position"), {}});
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
    validation::refuse("registration", "touches", std::to_string(touches.size()),
                       "as many as landmarks: " + std::to_string(landmarks.size()));
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
                         "a tip that moved by " + std::to_string(1e3 * off) + " mm",
                         "at rest within " + std::to_string(1e3 * largest_residual) + " mm while the button is down");
    }
    landmarks[i].p_T = mean;
  }
  return landmarks;
}

}  // namespace spring_workbench::registration
