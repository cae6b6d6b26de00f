# Headers of other libraries that most sources read, compiled once for each group of targets whose sources are compiled
# with the same options. In a unity build only: one without tells whether each source includes what it needs.
set(standard_headers <algorithm> <array> <cmath> <deque> <functional> <limits> <map> <memory> <optional> <set> <sstream>
  <string> <utility> <variant> <vector>)
set(SPRING_WORKBENCH_HEADERS_OF_arithmetic ${standard_headers} <Eigen/Cholesky> <Eigen/Geometry> <Eigen/LU>)
set(SPRING_WORKBENCH_HEADERS_OF_core ${SPRING_WORKBENCH_HEADERS_OF_arithmetic} <yaml-cpp/yaml.h>)
set(SPRING_WORKBENCH_HEADERS_OF_tests ${SPRING_WORKBENCH_HEADERS_OF_core} <gtest/gtest.h>)
set(SPRING_WORKBENCH_HEADERS_OF_ros ${SPRING_WORKBENCH_HEADERS_OF_core} <ros/ros.h> <tf2_msgs/TFMessage.h>
  <visualization_msgs/MarkerArray.h>)

# GCC frees memory only beyond a gigabyte, which saves a twentieth of the time.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  add_compile_options(--param=ggc-min-heapsize=1048576)
endif()

# ccache leaves out sources with precompiled headers unless it is told that macros from elsewhere do not matter.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache$")
  list(PREPEND CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros)
endif()

# precompile_headers(<target> <group>)
function(precompile_headers target group)
  if(NOT CMAKE_UNITY_BUILD)
    return()
  endif()
  get_property(first GLOBAL PROPERTY SPRING_WORKBENCH_FIRST_OF_${group})
  if(first)
    target_precompile_headers(${target} REUSE_FROM ${first})
  else()
    set_property(GLOBAL PROPERTY SPRING_WORKBENCH_FIRST_OF_${group} ${target})
    target_precompile_headers(${target} PRIVATE ${SPRING_WORKBENCH_HEADERS_OF_${group}})
  endif()
endfunction()
