// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/picture/drawing.h"
#include "app/picture/line_sight.h"
#include "app/picture/png_file.h"

namespace geotherm::app {

/// What lies over the pixels of a picture in a file that keeps shapes: strokes, boxes on them,
/// letters on these. Places and widths in pixels from the picture's top left corner.
struct Figure {
  using Colour = std::array<float, 4>;  ///< sRGB and alpha
  struct Stroke {
    std::vector<Outline> parts;
    Colour colour{};
    double width = 1;
    double dash = 0;             ///< from dash to dash; 0: none
    Eigen::AlignedBox2d clip{};  ///< nothing is drawn beyond it; empty: beyond the picture
  };
  struct Box {
    Eigen::Vector2d min, max;
    std::vector<Colour> colours;  ///< from its top down, evenly; 1 or more
  };
  struct Letters {
    Eigen::Vector2d base;  ///< left end of the base line
    double width = 0;      ///< of the whole text
    std::string text;
    Colour colour{};
  };
  std::vector<Stroke> strokes;
  std::vector<Box> boxes;
  std::vector<Letters> letters;
  std::span<const std::byte> font;  ///< a TrueType file

  /// Puts all of another one on top, into this part of the picture: strokes end there.
  void append(Figure other, const Eigen::AlignedBox2d& cell);
};

/// The same picture has the same bytes.
enum class FigureFormat { kSvg, kPdf };

/// Dashes and the gaps between them, of what it is from dash to dash.
inline constexpr double kDashShare = 0.6;

/// A file with the picture's pixels as an image and its shapes over it, one page. `texts`: Title,
/// Description and others, which a PDF holds. `dpi`: pixels an inch, which say how large the page
/// is; absent: 96 in a PDF, and an SVG is as large as its pixels.
/// Precondition: picture.figure. Errors: kOutOfMemory, kBadFile (the font), kBadInput (a page that
/// readers of PDF do not show).
Result<std::string> figure_bytes(const DrawnPicture& picture, FigureFormat format,
                                 const std::vector<FileText>& texts, std::optional<int> dpi = {});

}  // namespace geotherm::app
