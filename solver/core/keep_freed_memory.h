// SPDX-License-Identifier: MIT
#pragma once

namespace geotherm {

/// From now on this process keeps memory that it frees for what it asks for next: blocks of up to
/// 32 MB, half a GB in all at the end of the heap. Otherwise glibc hands the answers of every batch
/// back to the system and has them cleared page by page in the next, which at 4 million faces takes
/// up to a quarter of a batch. For main() of programs that ask again and again, before their first
/// threads; the library itself leaves its caller's heap alone. Does nothing without glibc.
void keep_freed_memory();

}  // namespace geotherm
