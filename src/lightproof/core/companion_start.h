// The start of the programs that Lightproof starts itself, with a socket for their standard input.
#pragma once

namespace lightproof {

/// Whether an open descriptor is a socket: whether Lightproof started this program.
bool is_socket(int descriptor);

/// Answers somebody who started such a program by hand: --version and --help to the standard
/// output, the usage to the standard error for anything else. `name` is that of the program.
/// Returns the exit status.
int explain_companion(const char* name, const char* usage, int argc, char** argv);

}  // namespace lightproof
