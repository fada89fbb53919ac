# Installs BUILD into an empty PREFIX, once for all tests that use Lightproof as others do.
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX}
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

# What is installed is what others may call: no header that says that it is private to its folder.
file(GLOB headers ${PREFIX}/include/lightproof/*/*.h)
foreach(header IN LISTS headers)
  file(READ ${header} head LIMIT 1200)
  string(REGEX REPLACE "#pragma once.*" "" head "${head}")
  string(REGEX REPLACE "\n//+ ?" " " head "${head}")
  if(head MATCHES "Private +to ")
    message(FATAL_ERROR "${header} is private, and installed")
  endif()
endforeach()
foreach(header image/reader.h gate/gate.h samplers/alias.h reference/quadrature.h plugin/lightproof_plugin.h)
  if(NOT EXISTS ${PREFIX}/include/lightproof/${header})
    message(FATAL_ERROR "${header} is not installed")
  endif()
endforeach()
