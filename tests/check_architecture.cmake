# Does ci/architecture see what it is there to see? A small tree of three folders that is in order, and
# then one fault after the other in it, each of which must be named. Usage: cmake -DSOURCE=… -DFOLDER=…
# -DNODE=… -P check_architecture.cmake

# write_tree(): core, and image, which stands on it.
function(write_tree)
  file(REMOVE_RECURSE ${FOLDER})
  file(WRITE ${FOLDER}/src/lightproof/core/CMakeLists.txt "# Measures.\nlightproof_module(core SOURCES a.cpp)\n")
  file(WRITE ${FOLDER}/src/lightproof/core/angle.h
    "#pragma once\nnamespace lightproof {\nstruct Angle {};\n}\n")
  file(WRITE ${FOLDER}/src/lightproof/core/secret.h
    "// Tables. Private to\n// the module.\n#pragma once\nnamespace lightproof {\nstruct Secret {};\n}\n")
  file(WRITE ${FOLDER}/src/lightproof/image/CMakeLists.txt
    "# Maps.\nlightproof_module(image SOURCES a.cpp PUBLIC lightproof::core)\n")
  file(WRITE ${FOLDER}/src/lightproof/image/map.h
    "#pragma once\n#include \"lightproof/core/angle.h\"\nnamespace lightproof {\nstruct Map {};\n}\n")
  file(WRITE ${FOLDER}/reference/CMakeLists.txt "# Oracles.\nlightproof_module(reference SOURCES a.cpp)\n")
  file(MAKE_DIRECTORY ${FOLDER}/docs)
  run("" )
endfunction()

# run(FAULT [--check]): the script over the tree must name FAULT, or pass if that is empty.
function(run fault)
  execute_process(COMMAND ${NODE} ${SOURCE}/ci/architecture.mjs ${ARGN} ${FOLDER}
    RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  string(FIND "${said}" "${fault}" at)
  if((fault STREQUAL "" AND NOT status EQUAL 0) OR (NOT fault STREQUAL "" AND (status EQUAL 0 OR at EQUAL -1)))
    message(FATAL_ERROR "expected '${fault}', status ${status}, and it said:\n${said}")
  endif()
endfunction()

write_tree()
run("" --check)
file(APPEND ${FOLDER}/docs/architecture.md "more\n")
run("" --check)  # what stands outside of the generated part is the page's own
file(WRITE ${FOLDER}/src/lightproof/image/CMakeLists.txt
  "# Maps and more.\nlightproof_module(image SOURCES a.cpp PUBLIC lightproof::core)\n")
run("is not what ci/architecture writes" --check)

write_tree()
file(APPEND ${FOLDER}/src/lightproof/core/angle.h "#include \"lightproof/image/map.h\"\n")
run("includes image/, which src/lightproof/core/CMakeLists.txt does not link to")

write_tree()
file(APPEND ${FOLDER}/src/lightproof/core/angle.h "#include \"lightproof/lenses/lens.h\"\n")
run("includes lenses/, which is no folder of this project")

write_tree()
file(WRITE ${FOLDER}/src/lightproof/core/CMakeLists.txt
  "# Measures.\nlightproof_module(core SOURCES a.cpp PUBLIC lightproof::image)\n")
run("links to image, which no file of core includes")
file(APPEND ${FOLDER}/src/lightproof/core/angle.h "#include \"lightproof/image/map.h\"\n")
run("a circle: ")

write_tree()
file(WRITE ${FOLDER}/src/lightproof/image/CMakeLists.txt
  "# Maps.\nlightproof_module(image SOURCES a.cpp PRIVATE lightproof::core)\n")
run("which src/lightproof/image/CMakeLists.txt links to PRIVATE")

write_tree()
file(APPEND ${FOLDER}/src/lightproof/image/map.h "#include \"lightproof/core/secret.h\"\n")
run("includes lightproof/core/secret.h, which is private")

write_tree()
file(APPEND ${FOLDER}/src/lightproof/core/secret.h "namespace lightproof {\nclass Map {};\n}\n")
run("lightproof::Map is declared in src/lightproof/core/secret.h and src/lightproof/image/map.h")

write_tree()
file(WRITE ${FOLDER}/src/lightproof/image/CMakeLists.txt
  "lightproof_module(image SOURCES a.cpp PUBLIC lightproof::core)\n")
run("does not begin with what lives in image")
