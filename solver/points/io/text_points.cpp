// SPDX-License-Identifier: MIT
// Points as lines of numbers: .xyz and .pts.
#include <cmath>
#include <string>
#include <utility>

#include "solver/core/text.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/text_scanner.h"
#include "solver/points/io/raw_points.h"

namespace geotherm::io {
namespace {

bool is_gap(char c) { return c == ' ' || c == '\t' || c == ',' || c == '\r'; }

/// The lines of a text that hold something, and the numbers in them.
class NumberLines {
 public:
  explicit NumberLines(std::string_view text)
      : text_(text), p_(text.data()), end_(text.data() + text.size()) {}

  /// Goes to the next line that is neither blank nor a comment; false where there is none.
  bool next_line() {
    for (; p_ != end_; ++p_) {
      skip_gaps();
      if (!ends()) return start_ = p_, true;
      skip_rest();
      if (p_ == end_) return false;
    }
    return false;
  }

  /// Takes a number of the line; false at its end, and before what is none.
  bool number(double& value) {
    skip_gaps();
    last_ = p_;
    if (ends()) return false;
    const char* const after = parse_double(p_, value);
    if (after == nullptr || after > end_) return false;
    const char* const before = p_;
    p_ = after;
    if (is_gap(*after) || ends()) return true;
    return p_ = before, false;
  }

  /// Whether nothing else stands in the line.
  bool ends() const {
    return p_ == end_ || *p_ == '\n' || *p_ == '#' || (*p_ == '/' && p_ + 1 < end_ && p_[1] == '/');
  }

  void skip_rest() {
    const std::size_t newline = std::string_view(p_, bytes_left()).find('\n');
    p_ = newline == std::string_view::npos ? end_ : p_ + newline;
  }

  /// Takes x, y and z. Throws where they are not there or not finite.
  Vec3 position() {
    Vec3 out;
    for (int axis = 0; axis < 3; ++axis) {
      if (!number(out[axis])) {
        if (!ends()) fail(quoted(text_, last_) + " is not a number (a point needs 3)");
        fail("a point has " +
             counted_text(static_cast<std::size_t>(axis), "coordinate", "coordinates") +
             " instead of 3");
      }
      if (!std::isfinite(out[axis])) {
        fail("the coordinate " + quoted(text_, last_) + " is not finite");
      }
    }
    return out;
  }

  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - p_); }

  [[noreturn]] void fail(const std::string& cause, Hint hint = {}) const {
    fail_at_line(text_, start_, cause, std::move(hint));
  }

  static constexpr std::size_t kShortest = 6;  ///< bytes of a point: "0 0 0" and the line's end

 private:
  void skip_gaps() {
    while (p_ != end_ && is_gap(*p_)) ++p_;
  }

  std::string_view text_;
  const char* p_;
  const char* end_;
  const char* start_ = p_;  ///< of the line
  const char* last_ = p_;   ///< start of the last number
};

/// Whether a vector is one that normals are: of length 1 as far as rounded digits say, or 0.
bool is_unit_or_zero(const Vec3& v) {
  constexpr double kRounded = 0.01;
  const double length = v.norm();
  return length == 0 || std::abs(length - 1) < kRounded;
}

}  // namespace

RawPoints read_xyz_points(std::string_view text) {
  NumberLines lines(text);
  RawPoints out;
  bool may_have_normals = true, more_than_points = false, more_than_normals = false;
  while (lines.next_line()) {
    out.positions.push_back(lines.position());
    more_than_points |= !lines.ends();
    if (may_have_normals) {
      Vec3 normal;
      may_have_normals = lines.number(normal[0]) && lines.number(normal[1]) &&
                         lines.number(normal[2]) && is_unit_or_zero(normal);
      if (may_have_normals) {
        out.normals.push_back(normal);
      } else {
        out.normals = {};
      }
    }
    more_than_normals |= !lines.ends();
    lines.skip_rest();
  }
  if (out.normals.empty() ? more_than_points : more_than_normals) {
    out.notes.push_back("what stands behind the points was left out");
  }
  return out;
}

RawPoints read_pts_points(std::string_view text) {
  NumberLines lines(text);
  RawPoints out;
  bool has_more = false;
  while (lines.next_line()) {
    double announced = 0;
    const bool is_count = lines.number(announced) && lines.ends() && announced >= 0 &&
                          announced == std::floor(announced) && announced < 1e15;
    if (!is_count) {
      lines.fail(out.positions.empty()
                     ? "a PTS file starts with a line that holds the number of its points alone"
                     : "more points follow than were announced");
    }
    const auto count = static_cast<std::size_t>(announced);
    if (count > (lines.bytes_left() + 1) / NumberLines::kShortest) {
      lines.fail("the line announces " + counted_text(count, "point", "points") + ", but only " +
                 counted_text(lines.bytes_left(), "byte", "bytes") + " follow");
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (!lines.next_line()) {
        lines.fail("the file ends after " + std::to_string(i) + " of " + std::to_string(count) +
                   " points");
      }
      out.positions.push_back(lines.position());
      has_more |= !lines.ends();
      lines.skip_rest();
    }
  }
  if (has_more) out.notes.push_back("intensities and colours were left out");
  return out;
}

}  // namespace geotherm::io
