#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "spring_workbench/motion/stylus_source.h"
#include "spring_workbench/registration/registration.h"

namespace spring_workbench::registration {

/// Parameters of the driver for the pose of the tracker and the tip of the stylus: `offset` and `tip`.
struct StoredRegistration {
  RigidTransform X_BT = RigidTransform::Identity();  ///< `offset`: pose of the tracker's frame in the workbench
  Vector3d p_ST = Vector3d::Zero();                  ///< `tip`: in the tracked frame of the stylus [m]
};

/// Reads the optional keys `offset` and `tip`; ignores other keys. Throws InputError with `where` if one is invalid.
StoredRegistration read_registration(const YAML::Node& map, const std::string& where);
/// Reads a file as find_tip() and find_tracker() write it; `offset` may be missing. Throws InputError with file:line,
/// key, value and rule if `tip` is missing, if one of the two is invalid, or if there is another key.
StoredRegistration read_registration_file(const std::string& path);
/// Reads the landmarks, `landmarks: [{name: …, position: x y z}, …]` [m, in the workbench frame], in the order in which
/// they are touched. Throws InputError with file:line, key, value and rule.
std::vector<Landmark> read_landmarks(const std::string& path);

/// Returns the samples of each press of the button.
std::vector<std::vector<motion::StylusSample>> presses(const std::vector<motion::StylusSample>& samples);
/// Returns the landmarks, each with the mean position of one press as its touch. Throws InputError if the numbers of
/// presses and landmarks differ, or if a sample of a press is farther than `largest_residual` [m] from the mean.
std::vector<Landmark> touched_landmarks(std::vector<Landmark> landmarks,
                                        const std::vector<std::vector<motion::StylusSample>>& touches,
                                        double largest_residual);

/// Transforms raw tracker samples into the samples that the driver would publish with this registration.
std::vector<motion::StylusSample> as_sent(std::vector<motion::StylusSample> samples,
                                          const StoredRegistration& registration);

// Both return the text of a file for the launch argument `registration:=`: `present` with the new value filled in,
// preceded by comments on the quality of the fit. `samples` are as published by the driver. They throw the InputErrors
// of calibrate_tip, or of touched_landmarks and register_tracker.
/// Finds `tip` from samples of a stylus that pivots about its tip while the button is down.
std::string find_tip(const std::vector<motion::StylusSample>& samples, const StoredRegistration& present,
                     double largest_residual);
/// Finds `offset` from touches of the landmarks `known`, in their order.
std::string find_tracker(const std::vector<motion::StylusSample>& samples, const std::vector<Landmark>& known,
                         const StoredRegistration& present, double largest_residual);

}  // namespace spring_workbench::registration
