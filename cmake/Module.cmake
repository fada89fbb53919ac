# One library target per folder. Warnings and optimisation settings stay private to Lightproof.
add_library(lightproof_settings INTERFACE)
target_compile_features(lightproof_settings INTERFACE cxx_std_20)
target_compile_options(lightproof_settings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor
  -Wold-style-cast -Wdouble-promotion -Werror
  -Wno-restrict  # false alarms of GCC 12 in std::string (GCC bug 105651)
  -ffp-contract=off
  -fno-math-errno -fno-trapping-math  # change no value, but allow vectors
  $<$<BOOL:${LIGHTPROOF_NATIVE}>:-march=native>)

# Beside the settings, where much is compiled and nothing runs long: command line, JSON, HTML. It
# halves the time of the compiler.
add_library(lightproof_glue INTERFACE)
target_compile_options(lightproof_glue INTERFACE $<$<CONFIG:Release>:-O1>)

# Beside the settings, for sources with vectors, which Highway compiles once for each of AVX-512,
# AVX2, SSE4 and plain C++; the one that fits the processor is taken at run time.
add_library(lightproof_vectors INTERFACE)
target_compile_definitions(lightproof_vectors INTERFACE HWY_DISABLED_TARGETS=HWY_SSSE3)

# lightproof_module(NAME SOURCES … [PUBLIC targets …] [PRIVATE targets …])
function(lightproof_module name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(lightproof_${name} STATIC ${ARG_SOURCES})
  add_library(lightproof::${name} ALIAS lightproof_${name})
  target_compile_features(lightproof_${name} PUBLIC cxx_std_20)
  target_include_directories(lightproof_${name} PUBLIC
    ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR})
  target_link_libraries(lightproof_${name}
    PUBLIC ${ARG_PUBLIC} PRIVATE lightproof_settings ${ARG_PRIVATE})
endfunction()
