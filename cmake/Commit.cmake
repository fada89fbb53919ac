# lightproof_names_its_commit(TARGET): its sources may include lightproof_commit.h, which defines
# LIGHTPROOF_COMMIT. The header is written at every build: a commit that was found when CMake last
# ran would be an old one.
set(lightproof_commit_folder ${PROJECT_BINARY_DIR}/commit)
add_custom_target(lightproof_commit
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR}
    -DOUTPUT=${lightproof_commit_folder}/lightproof_commit.h
    -P ${PROJECT_SOURCE_DIR}/cmake/write_commit.cmake
  BYPRODUCTS ${lightproof_commit_folder}/lightproof_commit.h)

function(lightproof_names_its_commit target)
  add_dependencies(${target} lightproof_commit)
  target_include_directories(${target} PRIVATE ${lightproof_commit_folder})
endfunction()
