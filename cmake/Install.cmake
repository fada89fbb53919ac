# The libraries, their headers and a package file: find_package(lightproof) in another project gives
# lightproof::lightproof, which stands for all parts, and each part by its folder's name.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

get_property(modules GLOBAL PROPERTY LIGHTPROOF_MODULES)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/lightproof)
install(TARGETS ${modules} lightproof_all EXPORT lightproof COMPONENT development)
install(TARGETS lightproof RUNTIME COMPONENT runtime)
# Where core/companion_program.cpp looks for them.
install(TARGETS lightproof-decode lightproof-plugin-host
  RUNTIME DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/lightproof COMPONENT runtime)
install(EXPORT lightproof NAMESPACE lightproof:: FILE lightproofTargets.cmake
  DESTINATION ${package_folder} COMPONENT development)
# What lives in src/lightproof, but for programs, kernels, files that are built in, and headers that say at
# their head that they are private to their folder.
file(GLOB headers RELATIVE ${PROJECT_SOURCE_DIR}/src CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/lightproof/*/*.h)
set(excluded "")
foreach(header IN LISTS headers)
  file(READ src/${header} head LIMIT 1200)
  string(REGEX REPLACE "#pragma once.*" "" head "${head}")
  string(REPLACE "\n// " " " head "${head}")
  if(head MATCHES "Private to ")
    list(APPEND excluded PATTERN ${header} EXCLUDE)
  endif()
endforeach()
install(DIRECTORY src/lightproof DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
  FILES_MATCHING PATTERN "*.h" PATTERN "*-inl.h" EXCLUDE PATTERN "cli" EXCLUDE PATTERN "decoder" EXCLUDE
  PATTERN "plugin_host" EXCLUDE PATTERN "skeletons" EXCLUDE PATTERN "assets" EXCLUDE ${excluded})
install(DIRECTORY reference DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lightproof
  COMPONENT development
  FILES_MATCHING PATTERN "*.h")
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/lightproofConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
configure_package_config_file(cmake/lightproofConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/lightproofConfig.cmake INSTALL_DESTINATION ${package_folder})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/lightproofConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/lightproofConfigVersion.cmake DESTINATION ${package_folder}
  COMPONENT development)
include(PkgConfig)
include(Pages)
if(PROJECT_IS_TOP_LEVEL)
  include(Package)
endif()
