// SPDX-License-Identifier: MIT
#include "app/picture/figure.h"

#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

#include "app/text/text.h"

namespace geotherm::app {
namespace {

template <auto kDestroy>
struct Destroy {
  template <class T>
  void operator()(T* what) const {
    kDestroy(what);
  }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroy<cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Destroy<cairo_destroy>>;
using Gradient = std::unique_ptr<cairo_pattern_t, Destroy<cairo_pattern_destroy>>;
using FontFace = std::unique_ptr<cairo_font_face_t, Destroy<cairo_font_face_destroy>>;

constexpr int kUsualDpi = 96;
/// The longest side of a PDF's page, points, that all readers show.
constexpr double kLongestPage = 14400;

cairo_status_t append(void* to, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

/// The font from memory, where it stays for as long as the program runs.
class MemoryFont {
 public:
  explicit MemoryFont(std::span<const std::byte> file) {
    if (FT_Init_FreeType(&library_) != 0) return;
    if (FT_New_Memory_Face(library_, reinterpret_cast<const FT_Byte*>(file.data()),
                           static_cast<FT_Long>(file.size()), 0, &face_) != 0) {
      return;
    }
    own_.reset(cairo_ft_font_face_create_for_ft_face(face_, 0));
  }
  ~MemoryFont() {
    own_.reset();
    if (face_ != nullptr) FT_Done_Face(face_);
    if (library_ != nullptr) FT_Done_FreeType(library_);
  }
  MemoryFont(const MemoryFont&) = delete;
  MemoryFont& operator=(const MemoryFont&) = delete;

  cairo_font_face_t* face() const { return own_.get(); }

 private:
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
  FontFace own_;
};

/// Cairo's pixels: native words, colours multiplied by alpha; none is kept where all is opaque.
Surface image_of(const DrawnPicture& picture) {
  bool opaque = true;
  for (std::size_t i = 3; i < picture.pixels.size(); i += 4) opaque &= picture.pixels[i] == 255;
  Surface image(cairo_image_surface_create(opaque ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32,
                                           picture.width, picture.height));
  if (cairo_surface_status(image.get()) != CAIRO_STATUS_SUCCESS) return image;
  cairo_surface_flush(image.get());
  unsigned char* rows = cairo_image_surface_get_data(image.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(image.get()));
  const auto width = static_cast<std::size_t>(picture.width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height); ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint8_t* from = &picture.pixels[4 * (y * width + x)];
      const std::uint32_t alpha = from[3];
      const auto part = [alpha](std::uint32_t c) { return (c * alpha + 127) / 255; };
      const std::uint32_t word =
          alpha << 24U | part(from[0]) << 16U | part(from[1]) << 8U | part(from[2]);
      std::memcpy(rows + y * stride + 4 * x, &word, sizeof word);
    }
  }
  cairo_surface_mark_dirty(image.get());
  return image;
}

class FigurePainter {
 public:
  explicit FigurePainter(cairo_t* on) : on_(on) { cairo_set_line_join(on_, CAIRO_LINE_JOIN_ROUND); }

  void paint(const DrawnPicture& picture, const MemoryFont& font) {
    const Surface image = image_of(picture);
    cairo_set_source_surface(on_, image.get(), 0, 0);
    cairo_paint(on_);
    for (const Figure::Stroke& stroke : picture.figure->strokes) paint(stroke);
    for (const Figure::Box& box : picture.figure->boxes) paint(box);
    cairo_set_font_face(on_, font.face());
    for (const Figure::Letters& letters : picture.figure->letters) paint(letters);
  }

 private:
  void use(const Figure::Colour& c) { cairo_set_source_rgba(on_, c[0], c[1], c[2], c[3]); }

  void paint(const Figure::Stroke& stroke) {
    cairo_save(on_);
    if (!stroke.clip.isEmpty()) {
      const Eigen::Vector2d size = stroke.clip.sizes();
      cairo_rectangle(on_, stroke.clip.min().x(), stroke.clip.min().y(), size.x(), size.y());
      cairo_clip(on_);
    }
    use(stroke.colour);
    cairo_set_line_width(on_, stroke.width);
    const bool dashed = stroke.dash > 0;
    const double dash[] = {kDashShare * stroke.dash, (1 - kDashShare) * stroke.dash};
    cairo_set_dash(on_, dash, dashed ? 2 : 0, 0);
    cairo_set_line_cap(on_, dashed ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);
    for (const Outline& part : stroke.parts) {
      cairo_new_sub_path(on_);
      for (const Eigen::Vector2d& p : part) cairo_line_to(on_, p.x(), p.y());
    }
    cairo_stroke(on_);
    cairo_restore(on_);
  }

  void paint(const Figure::Box& box) {
    const Eigen::Vector2d size = box.max - box.min;
    cairo_rectangle(on_, box.min.x(), box.min.y(), size.x(), size.y());
    if (box.colours.size() < 2) {
      use(box.colours.front());
      return cairo_fill(on_);
    }
    const Gradient colours(cairo_pattern_create_linear(0, box.min.y(), 0, box.max.y()));
    for (std::size_t i = 0; i < box.colours.size(); ++i) {
      const Figure::Colour& c = box.colours[i];
      const double at = static_cast<double>(i) / static_cast<double>(box.colours.size() - 1);
      cairo_pattern_add_color_stop_rgba(colours.get(), at, c[0], c[1], c[2], c[3]);
    }
    cairo_set_source(on_, colours.get());
    cairo_fill(on_);
  }

  /// As wide as they were laid out.
  void paint(const Figure::Letters& letters) {
    constexpr double kUnit = 100;
    cairo_set_font_size(on_, kUnit);
    cairo_text_extents_t extents;
    cairo_text_extents(on_, letters.text.c_str(), &extents);
    if (!(extents.x_advance > 0)) return;
    cairo_set_font_size(on_, kUnit * letters.width / extents.x_advance);
    use(letters.colour);
    cairo_move_to(on_, letters.base.x(), letters.base.y());
    cairo_show_text(on_, letters.text.c_str());
  }

  cairo_t* on_;
};

void describe(cairo_surface_t* pdf, const std::vector<FileText>& texts) {
  // A date would be all in which two files of one picture differ.
  cairo_pdf_surface_set_metadata(pdf, CAIRO_PDF_METADATA_CREATE_DATE, "");
  for (const FileText& text : texts) {
    const auto set = [&](const char* key, cairo_pdf_metadata_t as) {
      if (text.keyword == key) cairo_pdf_surface_set_metadata(pdf, as, text.text.c_str());
    };
    set("Title", CAIRO_PDF_METADATA_TITLE);
    set("Description", CAIRO_PDF_METADATA_SUBJECT);
    set("Software", CAIRO_PDF_METADATA_CREATOR);
    set("geotherm:command", CAIRO_PDF_METADATA_KEYWORDS);
  }
}

}  // namespace

void Figure::append(Figure other, const Eigen::AlignedBox2d& cell) {
  const Eigen::Vector2d by = cell.min();
  for (Stroke& stroke : other.strokes) {
    stroke.clip = cell;
    for (Outline& part : stroke.parts) {
      for (Eigen::Vector2d& point : part) point += by;
    }
    strokes.push_back(std::move(stroke));
  }
  for (Box& box : other.boxes) {
    box.min += by;
    box.max += by;
    boxes.push_back(std::move(box));
  }
  for (Letters& text : other.letters) {
    text.base += by;
    letters.push_back(std::move(text));
  }
  font = other.font;
}

Result<std::string> figure_bytes(const DrawnPicture& picture, FigureFormat format,
                                 const std::vector<FileText>& texts, std::optional<int> dpi) {
  const MemoryFont font(picture.figure->font);
  if (font.face() == nullptr) return Error{ErrorCode::kBadFile, "the font cannot be read"};
  std::string bytes;
  // A PDF is measured in points, an SVG in millimetres on paper and in pixels elsewhere.
  double scale = 1;
  if (format == FigureFormat::kPdf) {
    scale = 72.0 / dpi.value_or(kUsualDpi);
  } else if (dpi) {
    scale = 25.4 / *dpi;
  }
  const double width = scale * picture.width, height = scale * picture.height;
  if (format == FigureFormat::kPdf && std::max(width, height) > kLongestPage) {
    return Error{ErrorCode::kBadInput,
                 "a PDF page of " + fixed(width, 0) + " x " + fixed(height, 0) +
                     " points is larger than the " + fixed(kLongestPage, 0) + " that readers show",
                 {"ask for a larger ", SettingHint{"dpi"}, " or a smaller ", SettingHint{"size"}}};
  }
  Surface page;
  if (format == FigureFormat::kPdf) {
    page.reset(cairo_pdf_surface_create_for_stream(append, &bytes, width, height));
    describe(page.get(), texts);
  } else {
    page.reset(cairo_svg_surface_create_for_stream(append, &bytes, width, height));
    cairo_svg_surface_set_document_unit(page.get(), dpi ? CAIRO_SVG_UNIT_MM : CAIRO_SVG_UNIT_PX);
  }
  const Context context(cairo_create(page.get()));
  cairo_scale(context.get(), scale, scale);
  FigurePainter(context.get()).paint(picture, font);
  cairo_show_page(context.get());
  cairo_surface_finish(page.get());
  const cairo_status_t status = cairo_status(context.get());
  if (status == CAIRO_STATUS_SUCCESS) return bytes;
  return Error{ErrorCode::kOutOfMemory,
               std::string("the figure cannot be made: ") + cairo_status_to_string(status)};
}

}  // namespace geotherm::app
