# lightproof.pc, for builds that ask pkg-config: all libraries, each before those that it calls, as
# linkers want static ones.
set(ordered "")

# lightproof_put_before(MODULE): puts MODULE before all modules that it links to.
function(lightproof_put_before module)
  if(module IN_LIST ordered)
    return()
  endif()
  get_target_property(needed ${module} LINK_LIBRARIES)
  foreach(target IN LISTS needed)
    string(REPLACE "lightproof::" "lightproof_" target "${target}")
    if(target IN_LIST modules)
      lightproof_put_before(${target})
    endif()
  endforeach()
  list(PREPEND ordered ${module})
  set(ordered ${ordered} PARENT_SCOPE)
endfunction()

foreach(module IN LISTS modules)
  lightproof_put_before(${module})
endforeach()
list(TRANSFORM ordered PREPEND "-l")
list(JOIN ordered " " pkg_config_libraries)

# Relative to the file, so that the folder may be moved.
set(pkg_config_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH pkg_config_prefix /${pkg_config_folder} /)
string(REGEX REPLACE "/$" "" pkg_config_prefix ${pkg_config_prefix})
# Random123 has no file of its own, and may lie where the compiler does not look.
set(pkg_config_flags "")
if(NOT RANDOM123_INCLUDE_DIR IN_LIST CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES)
  set(pkg_config_flags " -isystem ${RANDOM123_INCLUDE_DIR}")
endif()
configure_file(cmake/lightproof.pc.in ${CMAKE_CURRENT_BINARY_DIR}/lightproof.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/lightproof.pc DESTINATION ${pkg_config_folder}
  COMPONENT development)
