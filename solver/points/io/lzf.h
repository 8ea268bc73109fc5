// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace geotherm::io {

/// The most bytes that LZF can make of one.
inline constexpr std::size_t kMaxByLzf = 88;

/// Unpacks bytes that LZF packed (Lehmann's LibLZF, the compression of .pcd): a control byte below
/// 32 is followed by so many bytes and one more as they are; any other holds the length and, with
/// the byte behind it, the distance of what is repeated. `size`: that of the answer, with `padding`
/// zero bytes behind it. Returns nothing where the bytes are damaged or make another size. Throws
/// std::bad_alloc. Cost: O(size).
std::vector<char> unpack_lzf(std::string_view packed, std::size_t size, std::size_t padding);

}  // namespace geotherm::io
