// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// Names of files and what is found in files, made fit to be shown to people.
namespace geotherm {

/// Bytes of the character at the front of a text in UTF-8 where it can be shown on a line; 0 where
/// it cannot: a control character (U+0000-U+001F, U+007F-U+009F), one that ends lines or turns
/// their direction (U+2028-U+202E, U+2066-U+2069), a noncharacter (U+FFFE, U+FFFF), or bytes that
/// are no UTF-8.
std::size_t printable_length(std::string_view text);

/// The text with '?' for each byte that cannot be shown: one line of UTF-8, whatever it was.
std::string printable(std::string_view text);

}  // namespace geotherm
