# cmake -DSOURCE=… -DOUTPUT=… -P write_commit.cmake: the commit that is being compiled, as a header,
# which changes only when the commit does. "-dirty" says that files differ from it. Empty where there
# is no git or no repository.
execute_process(
  COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=40 --exclude=*
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define LIGHTPROOF_COMMIT \"${commit}\"\n")
