# catkin: what the package leans on, its messages and services.
set(SPRING_WORKBENCH_MESSAGE_PACKAGES diagnostic_msgs geometry_msgs sensor_msgs std_msgs std_srvs tf2_msgs
  visualization_msgs)
# catkin writes the tests' environment while it is found, and leaves out of it the folders that are not there yet.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/devel/lib/python3/dist-packages ${CMAKE_BINARY_DIR}/devel/lib/pkgconfig)
# catkin installs its setup files into the prefix of the configuration. Here they go where all else goes, also with
# `cmake --install build --prefix DIR`.
if(CMAKE_SOURCE_DIR STREQUAL PROJECT_SOURCE_DIR AND NOT CATKIN_BUILD_BINARY_PACKAGE AND NOT CMAKE_INSTALL_PREFIX
  STREQUAL "/usr")
  set(CATKIN_INSTALL_INTO_PREFIX_ROOT FALSE)
  set(setup ${CMAKE_BINARY_DIR}/catkin_generated/installspace)
  file(WRITE ${setup}/.catkin "")   # marks what is installed
  install(PROGRAMS ${CMAKE_BINARY_DIR}/devel/_setup_util.py ${setup}/env.sh DESTINATION .)
  install(FILES ${setup}/.catkin ${setup}/setup.sh ${setup}/setup.bash ${setup}/setup.zsh DESTINATION .)
endif()
find_package(catkin REQUIRED COMPONENTS
  interactive_markers message_generation rosbag rosconsole roscpp tf2 tf2_ros ${SPRING_WORKBENCH_MESSAGE_PACKAGES})

add_message_files(FILES Accepted.msg BodyDescription.msg Change.msg Contact.msg Contacts.msg ForkState.msg
  MeshDescription.msg ObjectState.msg ObjectStates.msg PlacementState.msg SceneDescription.msg ShapeDescription.msg
  ProbeReading.msg StepReport.msg
  TaskState.msg)
add_service_files(FILES Calibrate.srv EditObject.srv LoadScene.srv Release.srv SaveScene.srv SelectTool.srv
  SetClutch.srv SetForkDamping.srv SetForkDofs.srv SetForkStiffness.srv SetIntegrator.srv)
generate_messages(DEPENDENCIES geometry_msgs std_msgs)

find_package(dynamic_reconfigure QUIET)   # optional: live tuning
if(dynamic_reconfigure_FOUND)
  generate_dynamic_reconfigure_options(cfg/Manipulation.cfg)
endif()

catkin_package(
  INCLUDE_DIRS include
  LIBRARIES spring_workbench_core
  DEPENDS EIGEN3
  CFG_EXTRAS library.cmake
  CATKIN_DEPENDS
  interactive_markers message_runtime rosbag rosconsole roscpp tf2 tf2_ros ${SPRING_WORKBENCH_MESSAGE_PACKAGES})

# Where things are installed, below the prefix, and where they are built.
set(SPRING_WORKBENCH_BIN ${CATKIN_PACKAGE_BIN_DESTINATION})
set(SPRING_WORKBENCH_LIB ${CATKIN_PACKAGE_LIB_DESTINATION})
set(SPRING_WORKBENCH_SHARE ${CATKIN_PACKAGE_SHARE_DESTINATION})
set(SPRING_WORKBENCH_CONFIG ${CATKIN_PACKAGE_SHARE_DESTINATION}/cmake)
set(SPRING_WORKBENCH_PYTHON ${CATKIN_PACKAGE_PYTHON_DESTINATION})
set(SPRING_WORKBENCH_BUILT ${CATKIN_DEVEL_PREFIX})
set(SPRING_WORKBENCH_TESTING ${CATKIN_ENABLE_TESTING})
