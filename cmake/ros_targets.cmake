# The ROS side of the package: room ros_interface, the nodes, and what is installed beside them.
add_room(ros_interface DEPENDS operator LIBRARIES ${catkin_LIBRARIES})
target_include_directories(spring_workbench_ros_interface SYSTEM PUBLIC
  ${catkin_INCLUDE_DIRS} ${CATKIN_DEVEL_PREFIX}/${CATKIN_GLOBAL_INCLUDE_DESTINATION})
add_dependencies(spring_workbench_ros_interface ${PROJECT_NAME}_generate_messages_cpp)

foreach(node manipulation tracker_driver)
  add_executable(${node} src/nodes/${node}.cpp)
  target_compile_options(${node} PRIVATE ${SPRING_WORKBENCH_WARNINGS})
  target_link_libraries(${node} spring_workbench_ros_interface)
endforeach()

install(TARGETS manipulation tracker_driver RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
foreach(folder config launch rviz scenes)
  if(EXISTS ${PROJECT_SOURCE_DIR}/${folder})
    install(DIRECTORY ${folder} DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
  endif()
endforeach()
install(FILES LICENSE DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
