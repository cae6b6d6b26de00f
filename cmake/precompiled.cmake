# Precompiled headers: what nearly every source includes of Eigen, gtest, ROS and the standard library is parsed once
# for all targets with the same flags. No source relies on it: scripts/tidy looks at all of them without.
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES ccache AND NOT CMAKE_CXX_COMPILER_LAUNCHER MATCHES pch_defines)
  message(STATUS "ccache without the sloppiness for precompiled headers (scripts/build sets it): none are used")
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()
if(CMAKE_DISABLE_PRECOMPILE_HEADERS)
  return()
endif()

set(SPRING_WORKBENCH_PRECOMPILED <Eigen/Core> <Eigen/Geometry> <Eigen/LU> <Eigen/Cholesky> <Eigen/Eigenvalues>
  <algorithm> <array> <cmath> <deque> <fstream> <functional> <limits> <map> <memory> <optional> <random> <set> <sstream>
  <string> <vector>)

# add_precompiled(<name> [HEADERS <further headers>...] [LIBRARIES <libraries>...] [OPTIONS <compile options>...])
function(add_precompiled name)
  cmake_parse_arguments(SET "" "" "HEADERS;LIBRARIES;OPTIONS" ${ARGN})
  set(source ${CMAKE_BINARY_DIR}/precompiled.cpp)
  if(NOT EXISTS ${source})
    file(WRITE ${source} "")
  endif()
  add_library(${name} OBJECT EXCLUDE_FROM_ALL ${source})
  target_compile_options(${name} PRIVATE ${SPRING_WORKBENCH_WARNINGS} ${SET_OPTIONS})
  target_link_libraries(${name} PRIVATE Eigen3::Eigen ${SET_LIBRARIES})
  target_precompile_headers(${name} PRIVATE ${SPRING_WORKBENCH_PRECOMPILED} ${SET_HEADERS})
endfunction()
add_precompiled(precompiled)
add_precompiled(precompiled_arithmetic OPTIONS ${SPRING_WORKBENCH_ARITHMETIC})
if(SPRING_WORKBENCH_ROS)
  add_precompiled(precompiled_ros HEADERS <ros/ros.h> <tf2_msgs/TFMessage.h> <visualization_msgs/MarkerArray.h>
    LIBRARIES Boost::headers)
  target_include_directories(precompiled_ros SYSTEM PRIVATE ${catkin_INCLUDE_DIRS})
endif()
if(SPRING_WORKBENCH_TESTING)
  add_precompiled(precompiled_test HEADERS <gtest/gtest.h> LIBRARIES GTest::gtest)
  set_target_properties(precompiled_test PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  target_compile_options(precompiled_test PRIVATE -fPIE)   # as the tests, which are programs
endif()

# Every library and every test takes the one that was made with its flags.
function(use_precompiled folder)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    get_target_property(options ${target} COMPILE_OPTIONS)
    if(target MATCHES "^test_" AND type STREQUAL EXECUTABLE)
      set(precompiled precompiled_test)
    elseif(target MATCHES "_(ros_common|manipulation|tracker_driver|contact_sound|register_tracker)$" AND
      type STREQUAL STATIC_LIBRARY)
      set(precompiled precompiled_ros)
      target_link_libraries(${target} PRIVATE Boost::headers)   # whose definition is in what is precompiled
    elseif(target MATCHES "^spring_workbench_" AND type MATCHES "STATIC_LIBRARY|SHARED_LIBRARY" AND NOT target MATCHES
      "_(rviz|core)$")
      if("-fno-math-errno" IN_LIST options)
        set(precompiled precompiled_arithmetic)
      else()
        set(precompiled precompiled)
      endif()
    else()
      continue()
    endif()
    target_precompile_headers(${target} REUSE_FROM ${precompiled})
    target_compile_options(${target} PRIVATE -Wno-error=invalid-pch)   # one that does not fit is told, and not used
  endforeach()
  get_property(folders DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(inner ${folders})
    use_precompiled(${inner})
  endforeach()
endfunction()
use_precompiled(${PROJECT_SOURCE_DIR})
