#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "spring_workbench/motion/stylus_source.h"
#include "spring_workbench/registration/registration.h"

namespace spring_workbench::registration {

/// The driver's parameters for the tracker's pose and the stylus' tip: `offset` and `tip`.
struct StoredRegistration {
  RigidTransform X_BT = RigidTransform::Identity();  ///< `offset`: the tracker's frame in the workbench
  Vector3d p_ST = Vector3d::Zero();                  ///< `tip`: in the tracked frame of the stylus [m]
};

/// Reads `offset` and `tip`, each where it is given; other keys are not looked at. Throws InputError with `where`.
StoredRegistration read_registration(const YAML::Node& map, const std::string& where);
/// The known points, `landmarks: [{name: …, position: x y z}, …]` [m in the workbench], in the order in which they are
/// touched. Throws InputError with file:line, key, value and rule.
std::vector<Landmark> read_landmarks(const std::string& path);

/// The samples of each time that the button was down.
std::vector<std::vector<motion::StylusSample>> presses(const std::vector<motion::StylusSample>& samples);
/// The landmarks with the mean position of one press each as its touch. Throws InputError when there are not as many
/// presses as landmarks, or when the samples of one lie farther than `largest_residual` [m] from their mean.
std::vector<Landmark> touched_landmarks(std::vector<Landmark> landmarks,
                                        const std::vector<std::vector<motion::StylusSample>>& touches,
                                        double largest_residual);

/// What the driver sends of these samples, which the tracker measured, with this registration.
std::vector<motion::StylusSample> as_sent(std::vector<motion::StylusSample> samples,
                                          const StoredRegistration& registration);

// The file that `registration:=` of the launch files takes, with what was found in place of `present`, and how good
// that is as comments before it; from samples as sent. They throw InputError as calibrate_tip and as touched_landmarks
// and register_tracker do.
/// `tip`, from turning about it while the button is down.
std::string find_tip(const std::vector<motion::StylusSample>& samples, const StoredRegistration& present,
                     double largest_residual);
/// `offset`, from touches of the landmarks `known`, in their order.
std::string find_tracker(const std::vector<motion::StylusSample>& samples, const std::vector<Landmark>& known,
                         const StoredRegistration& present, double largest_residual);

}  // namespace spring_workbench::registration
