// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace geotherm::engine {

/// What stands for bytes that are not UTF-8; no letter.
inline constexpr char32_t kMalformed = 0xFFFFFFFF;

/// Takes the first letter off a text that is not empty. Bytes that are not UTF-8 (cut off,
/// overlong, surrogates, beyond U+10FFFF) are taken as one kMalformed each or, where they begin
/// like a longer letter, together.
char32_t take_letter(std::string_view& text);

}  // namespace geotherm::engine
