# One CMake target per module; the link line is the law of who may know whom (doc/architecture.md).
set(SPRING_WORKBENCH_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror)
if(CMAKE_UNITY_BUILD)   # a source is a header there: its types are its own, and a name may shadow the next file's
  list(REMOVE_ITEM SPRING_WORKBENCH_WARNINGS -Wshadow)
  list(APPEND SPRING_WORKBENCH_WARNINGS -Wno-subobject-linkage)
endif()

# For modules that compute: without signals from floating point, errno from <cmath>, or complex products that look for
# NaN. Results stay those of IEEE arithmetic.
set(SPRING_WORKBENCH_ARITHMETIC -fno-math-errno -fno-trapping-math)
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-fcx-limited-range SPRING_WORKBENCH_LIMITED_RANGE)   # GCC; clang since 18
if(SPRING_WORKBENCH_LIMITED_RANGE)
  list(APPEND SPRING_WORKBENCH_ARITHMETIC -fcx-limited-range)
endif()

# For plugins that only pass on what the modules compute. Not for what is linked with these: inline functions of the
# headers would come from either.
set(SPRING_WORKBENCH_COLD $<$<CONFIG:Release>:-O1>)

# Faster to compile by a tenth: GCC frees memory only beyond a gigabyte.
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  add_compile_options(--param=ggc-min-heapsize=1048576)
endif()

# Packs of four numbers are passed by reference only, or inlined: the calling convention for them does not matter.
add_compile_options(-Wno-psabi)

# With AVX2 and FMA a pack is one register. Eigen's types keep the alignment that libraries built without them expect.
# Among the flags, so that the report names them.
option(SPRING_WORKBENCH_NATIVE "For processors with AVX2 and FMA only" OFF)
if(SPRING_WORKBENCH_NATIVE)
  string(APPEND CMAKE_CXX_FLAGS " -mavx2 -mfma -DEIGEN_MAX_ALIGN_BYTES=16")
  # GCC takes Eigen's load of four numbers for possible on a matrix of at most four that begins later.
  list(APPEND SPRING_WORKBENCH_WARNINGS -Wno-array-bounds)
endif()

# add_module(<name> [FOLDER <folder>] [OPENED <ON|OFF>] [DEPENDS <modules>...] [LIBRARIES <external libraries>...]
#            [INCLUDES <external folders>...] [DEFINITIONS <of its own sources>...] [OPTIONS <compile options>...])
# Builds src/<folder>/*.cpp, the folder being the name unless it is given, into the library spring_workbench_<name>.
# OPENED: into the shared library spring_workbench_<name>_engine, where ON; it is opened at run time, and who uses the
# module has its headers alone.
function(add_module name)
  cmake_parse_arguments(MODULE "" "FOLDER;OPENED" "DEPENDS;LIBRARIES;INCLUDES;DEFINITIONS;OPTIONS" ${ARGN})
  if(NOT MODULE_FOLDER)
    set(MODULE_FOLDER ${name})
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${MODULE_FOLDER}/*.cpp)
  foreach(source ${sources})   # what is inlined into code for wide processors would round differently
    file(STRINGS ${source} wide REGEX "^ *SPRING_WORKBENCH_WIDE " LIMIT_COUNT 1)
    if(wide)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
  list(TRANSFORM MODULE_DEPENDS PREPEND spring_workbench_)
  set(target spring_workbench_${name})
  if(DEFINED MODULE_OPENED)
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE ${MODULE_DEPENDS})
    set(target ${target}_engine)
    if(NOT MODULE_OPENED)
      file(REMOVE ${CMAKE_LIBRARY_OUTPUT_DIRECTORY}/lib${target}.so)   # of a build that had it
      return()
    endif()
    add_library(${target} SHARED ${sources})
    target_link_options(${target} PRIVATE -Wl,-Bsymbolic)
  elseif(sources)
    add_library(${target} STATIC ${sources})
  else()
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE ${MODULE_DEPENDS} ${MODULE_LIBRARIES})
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE 0)   # all sources together: headers read once
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
  target_include_directories(${target} SYSTEM PRIVATE ${MODULE_INCLUDES})
  target_compile_definitions(${target} PRIVATE ${MODULE_DEFINITIONS})
  target_compile_options(${target} PRIVATE ${SPRING_WORKBENCH_WARNINGS} ${MODULE_OPTIONS})
  target_link_libraries(${target} PUBLIC ${MODULE_DEPENDS} ${MODULE_LIBRARIES})
endfunction()
