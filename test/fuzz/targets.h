#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

/// Each target takes arbitrary bytes, processes them like external input, and aborts if a requirement is violated:
/// invalid input must be refused in one line, nothing else may be thrown, and accepted input must lead to finite
/// results.
namespace spring_workbench::fuzz {

/// Bytes of a FASTRAK's line, whole and in parts, in the mode that the first two bytes select.
void fastrak(std::string_view bytes);
/// A recorded motion or, with the first line `%script`, a script.
void motion(std::string_view bytes);
/// A YAML file of settings for a simulation, which is then run.
void settings(std::string_view bytes);
/// The URDF of a scene and, after a line `%yaml`, the file next to it; the scene is then simulated.
void scene(std::string_view bytes);
/// Calls of services, samples and buttons on a running simulation: a byte selects the call, the following ones its
/// numbers.
void calls(std::string_view bytes);
/// Steps of a held body: the first bytes select fork, mass and integrator, the following ones the steps and a hand.
void steps(std::string_view bytes);

inline void require(bool law, const std::string& text) {
  if (law) return;
  std::fprintf(stderr, "broken: %s\n", text.c_str());
  std::abort();
}

}  // namespace spring_workbench::fuzz
