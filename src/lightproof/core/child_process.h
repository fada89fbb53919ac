// Another program, run to its end.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lightproof {

/// Runs `program` with the arguments; its standard output is dropped. Throws InputError if it
/// cannot be started or does not end with 0, with the last line of its standard error. If an
/// interrupt is requested meanwhile, the program is ended too, and Interrupted thrown.
void run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments);

}  // namespace lightproof
