# find_package(lightproof): the libraries that Lightproof stands on, then its own targets.
include(${CMAKE_CURRENT_LIST_DIR}/Dependencies.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/lightproofTargets.cmake)
target_include_directories(lightproof::core SYSTEM INTERFACE ${RANDOM123_INCLUDE_DIR})
