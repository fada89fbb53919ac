// Another program, run to its end.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lightproof {

/// Runs `program` with the arguments; its standard output is dropped. Throws InputError if it
/// cannot be started, does not end with 0, or if nobody knows how it ended, with the last line of
/// its standard error. If an interrupt is requested meanwhile, the program is ended too, and
/// Interrupted thrown. A program that ends with a code of core/failure.h fails in the same way
/// here: OutOfMemory for lack of memory, std::runtime_error for a fault of its own. SIGCHLD is not
/// ignored while the program runs, even if it was before.
void run_child(const std::filesystem::path& program, const std::vector<std::string>& arguments);

}  // namespace lightproof
