# Manual pages and shell completion, written by every build from the help of the program that it
# built: they cannot say anything else. Not where the program cannot run.
if(CMAKE_CROSSCOMPILING)
  return()
endif()
find_program(PYTHON3_PROGRAM python3 REQUIRED)
set(pages ${PROJECT_BINARY_DIR}/pages)
add_custom_command(OUTPUT ${pages}/man1/lightproof.1
  COMMAND ${PYTHON3_PROGRAM} ${PROJECT_SOURCE_DIR}/cmake/write_pages.py
    $<TARGET_FILE:lightproof> ${pages}
  DEPENDS lightproof ${PROJECT_SOURCE_DIR}/cmake/write_pages.py
  COMMENT "Writing manual pages and completions" VERBATIM)
add_custom_target(lightproof_pages ALL DEPENDS ${pages}/man1/lightproof.1)
install(DIRECTORY ${pages}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT runtime)
install(FILES ${pages}/bash/lightproof COMPONENT runtime
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
# Debian's zsh looks below /usr in a folder of its own.
foreach(folder site-functions vendor-completions)
  install(FILES ${pages}/zsh/_lightproof COMPONENT runtime
    DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${folder})
endforeach()
