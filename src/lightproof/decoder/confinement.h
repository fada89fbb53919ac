// What this program may take: it works on bytes that anybody may have made.
#pragma once

#include <cstdint>

namespace lightproof {

/// For good: no files to be opened or written, no network, no other programs (a filter of system
/// calls, where the system has it), no memory dumps, no descriptors beside the first four. Signals
/// that are meant for whoever started this program are ignored: its end is that of the socket.
void confine();

/// From now on: so many bytes of memory, beside those of libraries, and so many seconds of
/// processor time, counted from the start of the program. Memory that is not there is
/// std::bad_alloc; time that is over ends the program by SIGXCPU.
void limit(std::uint64_t bytes, double seconds);

/// Seconds of processor time that this program has taken.
double seconds_taken();

/// Threads that decode or encode at once.
int threads_to_use();

}  // namespace lightproof
