# The nodes as a user runs them, on a ROS master of their own. The scenes that come with the package have contact mode
# stop.
find_package(rostest REQUIRED)
set(nodes bad_start left_out tracker_driver)
if(SPRING_WORKBENCH_FCL_FOUND)
  list(APPEND nodes beside_work checkpoint contact_sound displayed ended_nodes fastrak faults killed_nodes launch_files
    limits live_replay machine_link manipulation many_objects master moved_by_messages
    played_recordings
    register_tracker rviz study tools two_benches)
endif()
foreach(name ${nodes})
  add_rostest(integration/${name}.test)
endforeach()
# It compares delays of milliseconds, with a master and without: no other test may cause them.
if(SPRING_WORKBENCH_FCL_FOUND)
  set_tests_properties(_ctest_${PROJECT_NAME}_rostest_test_integration_master.test PROPERTIES RUN_SERIAL ON)
endif()
# Nodes whose wall clocks are set: a clock that is preloaded.
add_library(shifted_clock SHARED support/shifted_clock.cpp)
target_link_libraries(shifted_clock ${CMAKE_DL_LIBS})
set_target_properties(shifted_clock PROPERTIES
  LIBRARY_OUTPUT_DIRECTORY ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_BIN_DESTINATION})
if(SPRING_WORKBENCH_FCL_FOUND)
  add_rostest(integration/clocks.test)
endif()
if(dynamic_reconfigure_FOUND AND SPRING_WORKBENCH_FCL_FOUND)
  add_rostest(integration/live_tuning.test)
  add_rostest(integration/tutorials.test DEPENDENCIES replay)
endif()

# The study of tools with people: its plan, records and questionnaire.
add_test(NAME study_plan COMMAND ${PYTHON_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/integration/study_plan_test.py
  $<TARGET_FILE:assembly_trials> ${PROJECT_SOURCE_DIR})
# Its analysis, on numbers of known distributions.
add_test(NAME study_analysis COMMAND ${PYTHON_EXECUTABLE}
  ${CMAKE_CURRENT_SOURCE_DIR}/integration/study_analysis_test.py ${PROJECT_SOURCE_DIR})

# A package of another name in a catkin workspace, on top of this one as it is installed.
add_test(NAME catkin_workspace COMMAND ${PYTHON_EXECUTABLE}
  ${CMAKE_CURRENT_SOURCE_DIR}/integration/catkin_workspace_test.py ${CMAKE_COMMAND} ${CMAKE_BINARY_DIR}
  ${PYTHON_EXECUTABLE})
set_tests_properties(catkin_workspace PROPERTIES TIMEOUT 900)

if(SPRING_WORKBENCH_FCL_FOUND)
  # Tracker, manipulation and a viewer on three hosts; status 77: no network namespaces here, which need root.
  add_test(NAME hosts COMMAND ${CATKIN_ENV} ${PYTHON_EXECUTABLE}
    ${CMAKE_CURRENT_SOURCE_DIR}/integration/hosts_test.py ${CATKIN_DEVEL_PREFIX})
  set_tests_properties(hosts PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 900)

  # The demo and replay from an install folder.
  add_test(NAME installed COMMAND ${CATKIN_ENV} ${PYTHON_EXECUTABLE}
    ${CMAKE_CURRENT_SOURCE_DIR}/integration/installed_test.py ${CMAKE_COMMAND} ${CMAKE_BINARY_DIR})
  set_tests_properties(installed PROPERTIES TIMEOUT 600)

  # What rviz shows while nodes, rviz and the master come and go; status 77: no plugins or no virtual display.
  add_test(NAME rviz_recovery COMMAND ${CATKIN_ENV} ${PYTHON_EXECUTABLE}
    ${CMAKE_CURRENT_SOURCE_DIR}/integration/rviz_recovery_test.py ${CATKIN_DEVEL_PREFIX})
  set_tests_properties(rviz_recovery PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 900)
endif()
