// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm {

/// From now on this process keeps memory that it frees for what it asks for next: blocks of up to
/// 32 MB, as long as no more than half a GB is free at the end of the heap (of each arena, 64 MB).
/// Otherwise glibc hands the answers of every batch back to the system and has them cleared page by
/// page in the next, which at 4 million faces takes up to a quarter of a batch. For programs that
/// ask again and again, best after their set-ups, whose memory would be kept, too; the library
/// itself leaves its caller's heap alone. Does nothing without glibc, or where addresses have 32
/// bits.
void keep_freed_memory();

/// Gives back what is free in whole pages, kept or not. Cost: a pass over the free blocks.
void release_freed_memory();

}  // namespace geotherm
