set(SPRING_WORKBENCH_TEST_DATA "$ENV{SPRING_WORKBENCH_TEST_DATA}" CACHE PATH
  "Folder with data that does not come with the project (CONTRIBUTING.md); tests that need it are skipped without it")
if(SPRING_WORKBENCH_TESTING)
  find_package(GTest REQUIRED)
  if(NOT TARGET tests)
    add_custom_target(tests)
  endif()

  # What all tests share. paths.cpp alone knows where the checkout and the build are.
  set(folder ${PROJECT_SOURCE_DIR}/test/support)
  add_library(spring_workbench_test_support STATIC EXCLUDE_FROM_ALL ${folder}/gtest_main.cpp ${folder}/paths.cpp)
  target_include_directories(spring_workbench_test_support PUBLIC ${PROJECT_SOURCE_DIR}/test)
  target_compile_options(spring_workbench_test_support PRIVATE ${SPRING_WORKBENCH_WARNINGS})
  target_link_libraries(spring_workbench_test_support PUBLIC GTest::GTest)
  set_property(SOURCE ${folder}/paths.cpp APPEND PROPERTY COMPILE_DEFINITIONS
    "SPRING_WORKBENCH_SOURCE_DIR=\"${PROJECT_SOURCE_DIR}\""
    "SPRING_WORKBENCH_PROGRAMS=\"${CMAKE_RUNTIME_OUTPUT_DIRECTORY}\""
    "SPRING_WORKBENCH_TEST_DATA=\"${SPRING_WORKBENCH_TEST_DATA}\"")
endif()

# add_gtest(<name> <sources>...): an executable of gtest, built with the target `tests`.
function(add_gtest name)
  if(SPRING_WORKBENCH_ROS)
    catkin_add_gtest(${name} ${ARGN})
  else()
    add_executable(${name} EXCLUDE_FROM_ALL ${ARGN})
    add_dependencies(tests ${name})
    add_test(NAME ${name} COMMAND ${name})
  endif()
  target_link_libraries(${name} spring_workbench_test_support)
  target_compile_options(${name} PRIVATE ${SPRING_WORKBENCH_WARNINGS} ${SPRING_WORKBENCH_COLD})
  add_engines(${name})
endfunction()
