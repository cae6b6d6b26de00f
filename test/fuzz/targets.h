#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

/// Each target takes any bytes, does with them what a program does with input from outside, and aborts where a law is
/// broken: bad input is refused in one line, and nothing else is thrown; what is accepted is finite, and stays so.
namespace spring_workbench::fuzz {

/// A FASTRAK's line, all at once and in pieces, in the mode that the first two bytes choose.
void fastrak(std::string_view bytes);
/// A recorded motion; with `%script` as the first line a script.
void motion(std::string_view bytes);
/// A YAML file of settings, for a simulation that then runs.
void settings(std::string_view bytes);
/// A scene's URDF and, after a line `%yaml`, the file beside it; the scene then runs.
void scene(std::string_view bytes);
/// What services, samples and buttons do to a running simulation: a byte chooses the call, those after it the numbers.
void calls(std::string_view bytes);

inline void require(bool law, const std::string& text) {
  if (law) return;
  std::fprintf(stderr, "broken: %s\n", text.c_str());
  std::abort();
}

}  // namespace spring_workbench::fuzz
