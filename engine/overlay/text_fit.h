// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/overlay/overlay.h"

namespace geotherm::engine {

inline constexpr std::string_view kEllipsis = "\xE2\x80\xA6";

/// The text, or as many of its letters as fit into `width` pixels with an ellipsis after them;
/// empty where not even that fits. The atlas must hold kEllipsis.
std::string cut_to_width(const GlyphAtlas& atlas, std::string_view text, float width);

/// The text in lines of at most `width` pixels, broken at blanks. Words that are longer, and the
/// last of `most` lines where text remains, are cut.
std::vector<std::string> wrapped_lines(const GlyphAtlas& atlas, std::string_view text, float width,
                                       std::size_t most);

}  // namespace geotherm::engine
