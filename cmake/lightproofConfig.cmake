# find_package(lightproof): the libraries that Lightproof stands on, then its own targets.
include(CMakeFindDependencyMacro)
include(${CMAKE_CURRENT_LIST_DIR}/Dependencies.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/lightproofTargets.cmake)
