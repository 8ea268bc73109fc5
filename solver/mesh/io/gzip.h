// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

#include "solver/core/memory.h"

namespace geotherm::io {

/// Whether the bytes begin as those of gzip do.
inline bool is_gzip(std::string_view start) { return start.starts_with("\x1f\x8b"); }

/// What was made of the beginning of a stream of gzip.
struct Unpacked {
  std::size_t bytes;
  bool ended;  ///< the stream, with its checksum
};
/// Unpacks one stream until the room is filled, it ends, or it is damaged. Throws std::bad_alloc.
Unpacked unpack_gzip_stream(std::string_view packed, char* to, std::size_t room);

/// What is packed in one stream of gzip or several, and behind it `padding` zero bytes. `most`: so
/// many bytes it may be. Throws ReadFailure (damaged, cut off, more than `most` or than models are
/// packed to) and std::bad_alloc.
RawVector<char> unpack_gzip(std::string_view packed, std::size_t most, std::size_t padding);

}  // namespace geotherm::io
