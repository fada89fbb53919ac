# `cpack -G DEB`: two Debian packages, the program, and what is needed to build with the libraries.
set(CPACK_PACKAGE_NAME lightproof)
set(CPACK_PACKAGE_VENDOR Lightproof)
set(CPACK_PACKAGE_CONTACT "The Lightproof developers <lightproof@localhost>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME lightproof)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
"Given an environment map, it asks of every importance sampler whether it draws
the right distribution, how fast it converges and how fast it runs; it tests
samples that other programs drew, and makes prefiltered maps with known errors.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME liblightproof-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# Static libraries: their users link to the same libraries as the program, and need its decoder.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "lightproof (= ${PROJECT_VERSION}), libembree-dev, libfmt-dev, libglm-dev, libhwy-dev, librandom123-dev, libsqlite3-dev, libtbb-dev, nlohmann-json3-dev, pkg-config")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
"This package has headers, static libraries, a CMake package and a pkg-config
file, with which another program tests its own samplers.")
foreach(package lightproof liblightproof-dev)
  set(component runtime)
  if(package MATCHES "-dev$")
    set(component development)
  endif()
  install(FILES cmake/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
    COMPONENT ${component})
endforeach()
include(CPack)
