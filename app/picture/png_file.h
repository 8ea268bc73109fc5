// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>

#include "app/picture/drawing.h"
#include "geotherm/error.h"

namespace geotherm::app {

/// The bytes of a PNG file: sRGB, 8 bits a channel, RGB where every pixel is opaque and RGBA
/// elsewhere; texts as tEXt chunks, or iTXt where ASCII does not do. Errors: kOutOfMemory,
/// kBadInput (what libpng refuses). `dpi`: pixels an inch, as whole pixels a metre; absent: not
/// said.
Result<std::string> png_bytes(const DrawnPicture& picture, std::span<const FileText> texts = {},
                              std::optional<int> dpi = {});

}  // namespace geotherm::app
