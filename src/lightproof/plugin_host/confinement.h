// What the process of a plug-in may not do to others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lightproof {

/// Descriptors of this process, under numbers that are out of the way.
struct HostFiles {
  int socket;  ///< that the standard input was
  int prints;  ///< from which what is printed is read
};

/// Puts this process into a group of its own, and sends what is printed into a pipe.
HostFiles confine_plugin();

/// Ends this process with kPluginStuck a moment after the other end of the socket is closed,
/// whatever it is doing; and ends it if it starts another process, or becomes another program.
/// Keeps in `log` the beginning of what is printed, and drops the rest, so that nobody who prints
/// fails or waits for long.
void watch(const HostFiles& files, std::span<std::byte> log);

/// Lets the process hold no more private memory than this. Beyond it allocations fail.
void limit_memory(std::uint64_t bytes);

/// Private memory that the process holds now, in bytes.
std::uint64_t held_memory();

/// Whether this process has children.
bool has_children();

}  // namespace lightproof
