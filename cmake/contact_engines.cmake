# What contact is computed with. Each engine is left out where it is not found or not wanted: its contact mode is then
# refused.
option(SPRING_WORKBENCH_WITH_FCL "Contact modes stop and dynamic, where FCL is found" ON)
option(SPRING_WORKBENCH_WITH_BULLET "Contact mode dynamic, where Bullet and FCL are found" ON)

set(SPRING_WORKBENCH_FCL_FOUND OFF)
if(SPRING_WORKBENCH_WITH_FCL)
  find_package(fcl QUIET)   # FCL 0.5 is not found by this
  if(fcl_FOUND)
    set(SPRING_WORKBENCH_FCL_FOUND ON)
  endif()
endif()

# Bullet in double precision. Its other build, in single precision, has the same symbols: nothing that links it may
# link this.
set(SPRING_WORKBENCH_BULLET_FOUND OFF)
set(SPRING_WORKBENCH_BULLET_LIBRARIES)
if(SPRING_WORKBENCH_WITH_BULLET AND SPRING_WORKBENCH_FCL_FOUND)
  find_path(SPRING_WORKBENCH_BULLET_INCLUDE btBulletDynamicsCommon.h PATH_SUFFIXES bullet)
  foreach(part BulletDynamics BulletCollision LinearMath)
    find_library(SPRING_WORKBENCH_${part}_LIBRARY ${part}-float64)
    list(APPEND SPRING_WORKBENCH_BULLET_LIBRARIES ${SPRING_WORKBENCH_${part}_LIBRARY})
  endforeach()
  if(SPRING_WORKBENCH_BULLET_INCLUDE AND NOT SPRING_WORKBENCH_BULLET_LIBRARIES MATCHES "NOTFOUND")
    set(SPRING_WORKBENCH_BULLET_FOUND ON)
  endif()
endif()

# add_engines(<target>): builds the engine of mode `dynamic` with a target that opens it. It is part of `all`, not of
# `demo`, which does not run it.
function(add_engines target)
  if(SPRING_WORKBENCH_BULLET_FOUND)
    add_dependencies(${target} spring_workbench_rigid_bodies_engine)
  endif()
endfunction()

if(NOT SPRING_WORKBENCH_FCL_FOUND)
  message(STATUS "FCL 0.6 or later (libfcl-dev) left out: no contact mode stop")
endif()
if(NOT SPRING_WORKBENCH_BULLET_FOUND)
  message(STATUS "Bullet (libbullet-dev) left out: no contact mode dynamic")
endif()
