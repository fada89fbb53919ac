// Where the program that runs lies.
#pragma once

#include <filesystem>

namespace lightproof {

/// The path of the running program; empty if the system does not say. Without /proc it is the one
/// by which the program was started.
std::filesystem::path running_program();

/// A file that holds the bytes of the running program, even if another one has taken its place
/// since, where the system has such a file; else running_program().
std::filesystem::path running_program_file();

}  // namespace lightproof
