include(GNUInstallDirs)

# One library target per folder. Warnings and optimisation settings stay private to Lightproof.
add_library(lightproof_settings INTERFACE)
target_compile_features(lightproof_settings INTERFACE cxx_std_20)
target_compile_options(lightproof_settings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  -Wold-style-cast
  # Clang counts the float INFINITY of <cmath> as a promotion.
  $<$<CXX_COMPILER_ID:GNU>:-Wdouble-promotion>
  $<$<BOOL:${LIGHTPROOF_WERROR}>:-Werror>
  # False alarms of GCC 12 in std::string (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  -ffp-contract=off
  -fno-math-errno -fno-trapping-math  # change no value, but allow vectors
  $<$<BOOL:${LIGHTPROOF_NATIVE}>:-march=native>)

# Beside the settings, where much is compiled and nothing runs long: command line, JSON, HTML, tests. It
# halves the time of the compiler.
add_library(lightproof_glue INTERFACE)
target_compile_options(lightproof_glue INTERFACE $<$<CONFIG:Release>:-O1>)

# Beside the settings, for sources with vectors, which Highway compiles once for each of AVX-512,
# AVX2, SSE4 and plain C++, on ARM for NEON; the one that fits the processor is taken at run time.
# Vectors whose size the compiler does not know (SVE, RISC-V) cannot be members, as the kernels' are.
add_library(lightproof_vectors INTERFACE)
target_compile_definitions(lightproof_vectors INTERFACE
  "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128|HWY_RVV)")

# Beside either, headers of the standard library that most sources include, compiled once for each
# way of optimising: a quarter of the compiler's time. Every source still includes what it uses.
file(CONFIGURE OUTPUT precompiled.cpp CONTENT "")
foreach(headers standard_headers standard_headers_glue)
  add_library(lightproof_${headers} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp)
  target_precompile_headers(lightproof_${headers} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <span>
    <string> <string_view> <vector>)
  target_link_libraries(lightproof_${headers} PRIVATE lightproof_settings)
endforeach()
target_link_libraries(lightproof_standard_headers_glue PRIVATE lightproof_glue)

# lightproof_precompiled(TARGET libraries…): TARGET, which links to these, takes these headers.
function(lightproof_precompiled target)
  if(lightproof_glue IN_LIST ARGN)
    target_precompile_headers(${target} REUSE_FROM lightproof_standard_headers_glue)
  else()
    target_precompile_headers(${target} REUSE_FROM lightproof_standard_headers)
  endif()
endfunction()

# lightproof_in_groups(TARGET): with LIGHTPROOF_UNITY, the sources of TARGET, which are all of the current
# folder, are compiled in the groups that ci/unity.mjs finds.
function(lightproof_in_groups target)
  if(NOT LIGHTPROOF_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources EXCLUDE REGEX "^(/|\\.\\.)|<")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${sources}
    ${PROJECT_SOURCE_DIR}/ci/unity.mjs)
  execute_process(
    COMMAND ${NODE_PROGRAM} ${PROJECT_SOURCE_DIR}/ci/unity.mjs ${sources}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
    OUTPUT_VARIABLE lines OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" lines "${lines}")
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(line ${lines})
    string(REGEX MATCH "^([0-9]+) (.+)$" line "${line}")
    set_source_files_properties(${CMAKE_MATCH_2} PROPERTIES UNITY_GROUP ${target}_${CMAKE_MATCH_1})
  endforeach()
endfunction()

# What only the build of a folder needs: nothing of it is left in what is installed.
set(lightproof_build_only
  lightproof_settings lightproof_glue lightproof_vectors Boost::headers nlohmann_json::nlohmann_json)

# lightproof_module(NAME SOURCES … [PUBLIC targets …] [PRIVATE targets …])
function(lightproof_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(private "")
  foreach(target lightproof_settings ${ARG_PRIVATE})
    if(target IN_LIST lightproof_build_only)
      set(target $<BUILD_INTERFACE:${target}>)
    endif()
    list(APPEND private ${target})
  endforeach()
  add_library(lightproof_${name} STATIC ${ARG_SOURCES})
  add_library(lightproof::${name} ALIAS lightproof_${name})
  set_target_properties(lightproof_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(lightproof_${name} PUBLIC cxx_std_20)
  target_include_directories(lightproof_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src> $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/lightproof>)
  target_link_libraries(lightproof_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${private})
  lightproof_precompiled(lightproof_${name} ${ARG_PRIVATE})
  # The speed of what has vectors is measured: it must not depend on how much the compiler sees at once.
  if(NOT lightproof_vectors IN_LIST ARG_PRIVATE)
    lightproof_in_groups(lightproof_${name})
  endif()
  set_property(GLOBAL APPEND PROPERTY LIGHTPROOF_MODULES lightproof_${name})
endfunction()
