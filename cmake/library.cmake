# The target spring_workbench::core, for find_package(spring_workbench).
if(NOT TARGET spring_workbench::core)   # which is there in a workspace that is built as one
  include(CMakeFindDependencyMacro)
  find_dependency(Eigen3)
  include(${spring_workbench_DIR}/spring_workbenchTargets.cmake)
endif()
