# Module rviz_plugin: panel, display and view of rviz. Built only where rviz and Qt 5 are found.
option(SPRING_WORKBENCH_WITH_RVIZ "Plugins for rviz, where it is found" ON)
if(NOT SPRING_WORKBENCH_WITH_RVIZ)
  # of a build that had it
  file(REMOVE ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_LIB_DESTINATION}/libspring_workbench_rviz.so)
  message(STATUS "no rviz plugins: rviz shows ~markers")
  return()
endif()
find_package(rviz QUIET)
find_package(Qt5 QUIET COMPONENTS Widgets)
if(NOT rviz_FOUND OR NOT Qt5_FOUND)
  message(STATUS "rviz or Qt 5 (librviz-dev, qtbase5-dev) not found: no rviz plugins; rviz shows ~markers")
  return()
endif()

file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/rviz_plugin/*.cpp
  ${PROJECT_SOURCE_DIR}/src/rviz_plugin/*.h)
add_library(spring_workbench_rviz SHARED ${sources})
set_target_properties(spring_workbench_rviz PROPERTIES AUTOMOC ON UNITY_BUILD_BATCH_SIZE 0)
target_compile_options(spring_workbench_rviz PRIVATE ${SPRING_WORKBENCH_WARNINGS} ${SPRING_WORKBENCH_COLD})
target_compile_definitions(spring_workbench_rviz PRIVATE QT_NO_KEYWORDS)
target_include_directories(spring_workbench_rviz SYSTEM PUBLIC
  ${catkin_INCLUDE_DIRS} ${rviz_INCLUDE_DIRS} ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION})
add_library(spring_workbench_rviz_plugin ALIAS spring_workbench_rviz)   # the module's name, for its tests
target_link_libraries(spring_workbench_rviz PUBLIC
  spring_workbench_fork_mesh spring_workbench_ros_common spring_workbench_tools
  ${catkin_LIBRARIES} ${rviz_LIBRARIES} Qt5::Widgets)
# The thread that ends rviz must not come back to code that is gone.
target_link_options(spring_workbench_rviz PRIVATE LINKER:-z,nodelete)
add_dependencies(spring_workbench_rviz ${PROJECT_NAME}_generate_messages_cpp)
set(SPRING_WORKBENCH_RVIZ_FOUND TRUE)

install(TARGETS spring_workbench_rviz LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
install(FILES plugin_description.xml DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
