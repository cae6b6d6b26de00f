#pragma once

#include <string>

/// Paths on this machine. Only paths.cpp is compiled with them, so that the object files of all other tests are the
/// same in every checkout.
namespace spring_workbench::test_support {

/// A file of this checkout by its path from the root, such as "scenes/single_box.urdf".
std::string checkout(const std::string& path);

/// A file of the folder that SPRING_WORKBENCH_TEST_DATA names, such as "reference/stylus.csv"; empty if it names none.
std::string extra_data(const std::string& path);

/// A program of this build by its name, such as "replay".
std::string program(const std::string& name);

}  // namespace spring_workbench::test_support
