# What others link: the modules up to a hand and its recordings in one shared library, and the contact engines that it
# opens. find_package(spring_workbench) gives the target spring_workbench::core.
set(objects)
foreach(module math exponential friction validation config geometry motion rod dynamics stepping scene bodies tools
    instruments contact objects simulation hand_input motion_files)
  list(APPEND objects $<TARGET_OBJECTS:spring_workbench_${module}>)
endforeach()
add_library(spring_workbench_core SHARED ${objects})
add_library(spring_workbench::core ALIAS spring_workbench_core)
set_target_properties(spring_workbench_core PROPERTIES EXPORT_NAME core LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
target_include_directories(spring_workbench_core INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
target_compile_features(spring_workbench_core INTERFACE cxx_std_17)
# Eigen's types are as they were when the library was built, whatever processor a user compiles for.
target_compile_definitions(spring_workbench_core INTERFACE EIGEN_MAX_ALIGN_BYTES=16)
target_compile_options(spring_workbench_core INTERFACE -Wno-psabi)
target_link_options(spring_workbench_core PRIVATE -Wl,-Bsymbolic-functions)
target_link_libraries(spring_workbench_core
  PUBLIC Eigen3::Eigen
  PRIVATE ${YAML_CPP_LIBRARIES} urdfdom_model console_bridge tinyxml assimp ${CMAKE_DL_LIBS})

install(TARGETS spring_workbench_core EXPORT spring_workbenchTargets LIBRARY DESTINATION ${SPRING_WORKBENCH_LIB})
foreach(engine spring_workbench_collision_engine spring_workbench_rigid_bodies_engine)
  if(TARGET ${engine})
    install(TARGETS ${engine} LIBRARY DESTINATION ${SPRING_WORKBENCH_LIB})
  endif()
endforeach()
install(EXPORT spring_workbenchTargets NAMESPACE spring_workbench:: DESTINATION ${SPRING_WORKBENCH_CONFIG})
export(EXPORT spring_workbenchTargets NAMESPACE spring_workbench::
  FILE ${SPRING_WORKBENCH_BUILT}/share/spring_workbench/cmake/spring_workbenchTargets.cmake)
if(NOT SPRING_WORKBENCH_ROS)   # catkin has made its own, which includes library.cmake
  include(CMakePackageConfigHelpers)
  write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/spring_workbenchConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
  install(FILES cmake/library.cmake DESTINATION ${SPRING_WORKBENCH_CONFIG} RENAME spring_workbenchConfig.cmake)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/spring_workbenchConfigVersion.cmake
    DESTINATION ${SPRING_WORKBENCH_CONFIG})
endif()

# What an outside program may include, each with all that it includes.
set(SPRING_WORKBENCH_HEADERS
  bodies/body_state.h
  contact/contact_state.h
  dynamics/active_coordinates.h
  dynamics/coupling.h
  dynamics/held_body.h
  dynamics/integrator.h
  dynamics/settings.h
  geometry/shapes.h
  hand_input/input_filter.h
  hand_input/local_time.h
  hand_input/reacquisition.h
  hand_input/sample_gate.h
  hand_input/settings.h
  math/pack.h
  math/rigid_transform.h
  math/state_archive.h
  motion/motion_segment.h
  motion/pose_track.h
  motion/stylus_source.h
  motion_files/open_motion.h
  rod/settings.h
  rod/shape_model.h
  scene/scene.h
  simulation/settings.h
  simulation/simulation.h
  tools/settings.h
  tools/tool.h
  tools/tool_state.h
  validation/input_error.h
  spring_workbench.h)
foreach(header ${SPRING_WORKBENCH_HEADERS})
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES include/spring_workbench/${header} DESTINATION include/spring_workbench/${folder})
endforeach()
