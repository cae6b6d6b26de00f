# SPRING_WORKBENCH_SANITIZE: "address,undefined" or "thread" builds everything with these sanitizers; scripts/sanitize
# runs it.
set(SPRING_WORKBENCH_SANITIZE "" CACHE STRING "Sanitizers to build with: address,undefined or thread; empty: none")
if(SPRING_WORKBENCH_SANITIZE)
  # Not vptr: it wants to be linked with the classes of the contact engines, which are opened.
  add_compile_options(-fsanitize=${SPRING_WORKBENCH_SANITIZE} -fno-sanitize=vptr -fno-sanitize-recover=undefined
    -fno-omit-frame-pointer -g1)
  if(SPRING_WORKBENCH_SANITIZE STREQUAL thread AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    add_compile_options(-Wno-tsan)   # Boost.Asio's fences, which the thread sanitizer does not see
  endif()
  add_link_options(-fsanitize=${SPRING_WORKBENCH_SANITIZE})
endif()
