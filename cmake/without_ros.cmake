# Without catkin: the modules below `ros`, the programs, and the library.
include(GNUInstallDirs)
include(CTest)
set(SPRING_WORKBENCH_TESTING ${BUILD_TESTING})
if(NOT PYTHON_EXECUTABLE)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  set(PYTHON_EXECUTABLE ${Python3_EXECUTABLE})
endif()
execute_process(COMMAND ${PYTHON_EXECUTABLE} -c
  "import site, sys; print('lib/python%d.%d/' % sys.version_info[:2] + site.getsitepackages()[0].split('/')[-1])"
  OUTPUT_VARIABLE python_folder OUTPUT_STRIP_TRAILING_WHITESPACE)

# Where things are installed, below the prefix, and where they are built.
set(SPRING_WORKBENCH_BIN ${CMAKE_INSTALL_BINDIR})
set(SPRING_WORKBENCH_LIB ${CMAKE_INSTALL_LIBDIR})
set(SPRING_WORKBENCH_SHARE ${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME})
set(SPRING_WORKBENCH_CONFIG ${CMAKE_INSTALL_LIBDIR}/cmake/${PROJECT_NAME})
set(SPRING_WORKBENCH_PYTHON ${python_folder}/${PROJECT_NAME})
set(SPRING_WORKBENCH_BUILT ${CMAKE_BINARY_DIR})
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${SPRING_WORKBENCH_BUILT}/${SPRING_WORKBENCH_BIN})
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${SPRING_WORKBENCH_BUILT}/${SPRING_WORKBENCH_LIB})
