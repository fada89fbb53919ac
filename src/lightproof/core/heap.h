// What the heap does with freed memory.
#pragma once

namespace lightproof {

/// From now on large blocks come from the system and go back to it when they are freed. Left to
/// itself glibc's heap keeps blocks of up to 32 MB as soon as one of that size has been freed: what
/// ran before decides then what a program takes, in memory and in time.
void keep_no_freed_memory();

/// Gives back what small blocks that are freed by now leave between those that are not. Some
/// milliseconds of work.
void give_back_freed_memory();

}  // namespace lightproof
