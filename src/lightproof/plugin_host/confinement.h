// What the process of a plug-in may not do to others.
#pragma once

#include <cstdint>

namespace lightproof {

/// Puts this process into a group of its own, and sends what is printed to kPluginLogFile. Returns
/// the descriptor of the socket that the standard input was, under a number of its own.
int confine_plugin();

/// Ends this process with kPluginStuck a moment after the other end of the socket is closed,
/// whatever it is doing; and ends it if it starts another process, or becomes another program.
void end_with(int socket);

/// Lets the process hold no more private memory than this. Beyond it allocations fail.
void limit_memory(std::uint64_t bytes);

/// Private memory that the process holds now, in bytes.
std::uint64_t held_memory();

/// Whether this process has children.
bool has_children();

}  // namespace lightproof
