// SPDX-License-Identifier: MIT
// Nearly raw raster data (Teem: https://teem.sourceforge.net/nrrd/format.html): lines of text up to
// an empty one, then the samples, or in a file of their own. The first axis is the fastest. Words
// have the same meaning in capitals, as Teem reads them.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "solver/core/text.h"
#include "solver/grid/io/raw_grid.h"
#include "solver/mesh/io/gzip.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/text_scanner.h"

namespace geotherm::io {
namespace {

constexpr struct {
  std::string_view name;
  NumberType type;
} kNrrdTypes[] = {
    {"signed char", NumberType::kInt8},
    {"int8", NumberType::kInt8},
    {"int8_t", NumberType::kInt8},
    {"uchar", NumberType::kUint8},
    {"unsigned char", NumberType::kUint8},
    {"uint8", NumberType::kUint8},
    {"uint8_t", NumberType::kUint8},
    {"short", NumberType::kInt16},
    {"short int", NumberType::kInt16},
    {"signed short", NumberType::kInt16},
    {"signed short int", NumberType::kInt16},
    {"int16", NumberType::kInt16},
    {"int16_t", NumberType::kInt16},
    {"ushort", NumberType::kUint16},
    {"unsigned short", NumberType::kUint16},
    {"unsigned short int", NumberType::kUint16},
    {"uint16", NumberType::kUint16},
    {"uint16_t", NumberType::kUint16},
    {"int", NumberType::kInt32},
    {"signed int", NumberType::kInt32},
    {"int32", NumberType::kInt32},
    {"int32_t", NumberType::kInt32},
    {"uint", NumberType::kUint32},
    {"unsigned int", NumberType::kUint32},
    {"uint32", NumberType::kUint32},
    {"uint32_t", NumberType::kUint32},
    {"longlong", NumberType::kInt64},
    {"long long", NumberType::kInt64},
    {"long long int", NumberType::kInt64},
    {"signed long long", NumberType::kInt64},
    {"signed long long int", NumberType::kInt64},
    {"int64", NumberType::kInt64},
    {"int64_t", NumberType::kInt64},
    {"ulonglong", NumberType::kUint64},
    {"unsigned long long", NumberType::kUint64},
    {"unsigned long long int", NumberType::kUint64},
    {"uint64", NumberType::kUint64},
    {"uint64_t", NumberType::kUint64},
    {"float", NumberType::kFloat32},
    {"double", NumberType::kFloat64},
};

/// A line that says something of each axis, and of how many; 0: there is none.
struct PerAxis {
  std::string_view text;
  std::size_t count = 0;
};

class NrrdHeaderReader {
 public:
  explicit NrrdHeaderReader(std::string_view text) : text_(text) {}

  NrrdHeader read() {
    if (!text_.starts_with("NRRD000")) {
      fail_at_line(text_, text_.data(), "a file of NRRD starts with NRRD000");
    }
    next_line();
    while (at_ < text_.size()) {
      const std::string_view line = next_line();
      if (line.empty()) break;
      if (line.starts_with('#')) continue;
      const std::size_t colon = line.find(':');
      if (colon == line.npos) fail_at_line(text_, line.data(), "there is no : in the header");
      if (line.substr(colon).starts_with(":=")) continue;  // a remark of the writer's
      std::string_view value = line.substr(colon + 1);
      value.remove_prefix(std::min(value.find_first_not_of(" \t"), value.size()));
      while (value.ends_with(' ') || value.ends_with('\t')) value.remove_suffix(1);
      take(lower_case(line.substr(0, colon)), value);
    }
    header_.data_begins = std::min(at_, text_.size());
    if (!typed_ || sizes_.count == 0) throw ReadFailure{"the header has no type or no sizes"};
    check_axes();
    check_spacings();
    check_order();
    check_kinds();
    return std::move(header_);
  }

 private:
  std::string_view next_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view line = text_.substr(at_, end - at_);
    at_ = end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  [[noreturn]] void fail(std::string_view value, const std::string& cause, Hint hint = {}) const {
    fail_at_line(text_, value.data(), cause, std::move(hint));
  }

  void take(std::string_view field, std::string_view value) {
    const std::string word = lower_case(value);
    if (field == "type") {
      const auto* const known =
          std::find_if(std::begin(kNrrdTypes), std::end(kNrrdTypes),
                       [&word](const auto& each) { return each.name == word; });
      if (known == std::end(kNrrdTypes)) {
        fail(value, "the type of numbers " + quoted(value, value.data()) + " is unknown");
      }
      header_.type = known->type;
      typed_ = true;
    } else if (field == "dimension") {
      if (value != "2" && value != "3") {
        fail(value, "the dimension is " + quoted(value, value.data()) + "; a grid has 2 or 3");
      }
      dimension_ = value == "2" ? 2 : 3;
    } else if (field == "sizes") {
      read_sizes(value);
    } else if (field == "kinds") {
      kinds_ = value;
    } else if (field == "encoding") {
      using Encoding = NrrdHeader::Encoding;
      if (word != "raw" && word != "gzip" && word != "gz" && word != "ascii" && word != "text" &&
          word != "txt") {
        fail(value, "the encoding " + quoted(value, value.data()) + " is not supported",
             {"save it raw or gzip"});
      }
      header_.encoding = word == "raw"           ? Encoding::kRaw
                         : word.starts_with('g') ? Encoding::kGzip
                                                 : Encoding::kText;
    } else if (field == "endian") {
      if (word != "big" && word != "little") {
        fail(value, "the endian " + quoted(value, value.data()) + " is unknown",
             {"it is big or little"});
      }
      header_.order = word == "big" ? std::endian::big : std::endian::little;
      ordered_ = true;
    } else if (field == "spacings") {
      spacings_ = {value, 0};
      for (double each : reals(value, 3)) header_.grid.spacing[spacings_.count++] = each;
    } else if (field == "space directions") {
      read_directions(value);
    } else if (field == "space origin") {
      for (int e = 0; double each : reals(value, 3)) header_.grid.origin[e++] = each;
    } else if (field == "data file" || field == "datafile") {
      if (value.starts_with("LIST") || value.find('%') != value.npos) {
        fail(value, "the samples are in several files", {"save them as one"});
      }
      const std::filesystem::path file(value);
      const bool goes_up = std::ranges::find(file, std::filesystem::path("..")) != file.end();
      if (file.is_absolute() || goes_up) {
        fail(value, "the samples are in " + printable(value) + ", outside the folder of the header",
             {"move them beside it, and name the file alone"});
      }
      header_.data_file = std::string(value);
    } else if (field == "line skip" || field == "lineskip") {
      header_.line_skip = whole(value, 0);
    } else if (field == "byte skip" || field == "byteskip") {
      header_.byte_skip = whole(value, -1);
    }
  }

  [[noreturn]] void fail_of_axis(std::string_view where, std::size_t axis,
                                 const std::string& what) const {
    const std::int64_t size = header_.grid.size[std::min<std::size_t>(axis, 2)];
    fail(where,
         "axis " + std::to_string(axis) + " of " + std::to_string(size) + " values " + what +
             "; a grid has one value a sample",
         {"save the brightness or one of them alone"});
  }

  /// What is said of each axis is said of as many as there are.
  void check_axes() const {
    if (dimension_ != sizes_.count) {
      fail(sizes_.text,
           "there are " + counted_text(sizes_.count, "size", "sizes") + ", and the dimension is " +
               (dimension_ == 0 ? "not given" : std::to_string(dimension_)),
           {"give a size for each axis"});
    }
    for (const PerAxis& each : {spacings_, directions_}) {
      if (each.count == 0 || each.count == sizes_.count) continue;
      fail(each.text, "there are " + counted_text(sizes_.count, "size", "sizes") +
                          ", but this is said of " + counted_text(each.count, "axis", "axes"));
    }
  }

  /// A spacing that is not known is nan; where none is known, all are 1.
  void check_spacings() {
    if (directions_.count > 0) return;
    bool known = false, unknown = false;
    for (std::size_t e = 0; e < 3; ++e) {
      double& spacing = header_.grid.spacing[e];
      if (header_.grid.size[e] > 1) (std::isnan(spacing) ? unknown : known) = true;
      if (std::isnan(spacing)) spacing = 1;
    }
    if (!known || !unknown) return;
    fail(spacings_.text, "the spacing along one axis is nan, and that along another is not",
         {"give all of them"});
  }

  void check_order() const {
    const std::size_t bytes = size_of(header_.type);
    if (ordered_ || bytes == 1 || header_.encoding == NrrdHeader::Encoding::kText) return;
    throw ReadFailure{"the samples have " + std::to_string(bytes) +
                          " bytes each, and the header has no endian, the order of them",
                      0,
                      {},
                      {"add the line endian: little, or endian: big"}};
  }

  /// Axes are places, or numbers of one sample such as a colour's, which have no direction. One
  /// value is none too many.
  void check_kinds() const {
    if (!no_direction_.empty()) {
      fail_of_axis(no_direction_, axis_without_direction_, "has no direction");
    }
    constexpr std::string_view kPlaces[] = {"domain", "space", "time", "none", "???"};
    std::size_t axis = 0;
    for (std::string_view rest = kinds_; axis < sizes_.count; ++axis) {
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
      const std::string_view kind = rest.substr(0, rest.find_first_of(" \t"));
      if (kind.empty()) return;
      rest.remove_prefix(kind.size());
      if (std::ranges::count(kPlaces, lower_case(kind)) > 0 || header_.grid.size[axis] == 1)
        continue;
      fail_of_axis(kind, axis, "is " + printable(kind));
    }
  }

  std::int64_t whole(std::string_view value, std::int64_t least) const {
    std::int64_t out = 0;
    if (parse_integer(value.data(), out) != value.data() + value.size() || out < least) {
      fail(value, quoted(value, value.data()) + " is no number of lines or bytes");
    }
    return out;
  }

  void read_sizes(std::string_view value) {
    std::size_t& count = sizes_.count;
    sizes_ = {value, 0};
    const char* p = value.data();
    const char* const end = p + value.size();
    while (p < end) {
      std::int64_t size = 0;
      p = parse_integer(p, size);
      if (p == nullptr || p > end || count == 3) fail(value, "the sizes cannot be read");
      header_.grid.size[count++] = size;
      while (p < end && (*p == ' ' || *p == '\t')) ++p;
    }
    if (count < 2) fail(value, "there is one size; a grid has 2 or 3");
  }

  /// Numbers between blanks, commas and brackets, at most so many.
  std::vector<double> reals(std::string_view value, std::size_t most) const {
    std::vector<double> out;
    const char* p = value.data();
    const char* const end = p + value.size();
    while (p < end) {
      if (std::string_view(" \t(),").find(*p) != std::string_view::npos) {
        ++p;
        continue;
      }
      double number = 0;
      p = parse_double(p, number);
      if (p == nullptr || p > end || out.size() == most || std::isinf(number)) {
        fail(value, quoted(value, value.data()) + " cannot be read; it has " +
                        std::to_string(most) + " numbers at most");
      }
      out.push_back(number);
    }
    return out;
  }

  void read_directions(std::string_view value) {
    for (std::size_t axis = 0, at = 0; (at = value.find_first_of("(n", at)) != value.npos; ++axis) {
      if (value[at] == 'n' && no_direction_.empty()) {
        no_direction_ = value.substr(at);
        axis_without_direction_ = axis;
        return;
      }
      at = std::min(value.find(')', at), value.size());
    }
    const std::vector<double> all = reals(value, 9);
    const std::size_t axes = all.size() == 4 ? 2 : 3;
    bool along = all.size() == 4 || all.size() == 6 || all.size() == 9;
    const std::size_t in_space = along ? (all.size() == 4 ? 2 : 3) : 1;
    for (std::size_t i = 0; i < all.size() && along; ++i) {
      const std::size_t e = i / in_space;
      if (i % in_space != e) {
        along = all[i] == 0;
      } else if (e < axes) {
        header_.grid.spacing[e] = all[i];
      }
    }
    if (!along) {
      fail(value, "the axes are not those of space", {"save it along the axes, or with spacings"});
    }
    directions_ = {value, all.size() / in_space};
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool typed_ = false, ordered_ = false;
  std::size_t dimension_ = 0;  ///< 0: not given
  PerAxis sizes_, spacings_, directions_;
  std::string_view kinds_, no_direction_;
  std::size_t axis_without_direction_ = 0;
  NrrdHeader header_;
};

/// So many bytes out of a stream of gzip.
std::string unzipped(std::string_view packed, std::size_t bytes) {
  constexpr std::size_t kMaxTimes = 1100;  // no stream of deflate unpacks to more
  if (bytes / kMaxTimes > packed.size()) {
    throw ReadFailure{"there are to be " + std::to_string(bytes) + " bytes, but only " +
                      std::to_string(packed.size()) + " compressed ones follow"};
  }
  // One byte more than there are to be, so that the stream is read to its end, its checksum.
  std::string out(bytes + 1, '\0');
  const auto [made, ended] = unpack_gzip_stream(packed, out.data(), out.size());
  if (made < bytes) {
    throw ReadFailure{"the compressed samples are damaged or too few: " + std::to_string(made) +
                      " bytes of " + std::to_string(bytes)};
  }
  if (made > bytes) {
    throw ReadFailure{"there are to be " + std::to_string(bytes) +
                      " bytes, but the compressed samples are more"};
  }
  if (!ended) {
    throw ReadFailure{"the compressed samples are cut off or damaged behind their " +
                      std::to_string(bytes) + " bytes: " + std::to_string(packed.size()) +
                      " compressed ones do not end with their checksum"};
  }
  out.pop_back();
  return out;
}

}  // namespace

NrrdHeader read_nrrd_header(std::string_view text) { return NrrdHeaderReader(text).read(); }

RawGrid read_nrrd_data(const NrrdHeader& header, std::string_view data) {
  RawGrid grid = header.grid;
  const std::size_t count = count_samples(grid.size);
  const std::size_t bytes = count * size_of(header.type);
  for (std::int64_t line = 0; line < header.line_skip; ++line) {
    const std::size_t end = data.find('\n');
    if (end == data.npos) throw ReadFailure{"the file ends in the lines to be skipped"};
    data.remove_prefix(end + 1);
  }
  if (header.byte_skip >= 0) {
    data.remove_prefix(std::min(static_cast<std::size_t>(header.byte_skip), data.size()));
  } else if (data.size() >= bytes && header.encoding == NrrdHeader::Encoding::kRaw) {
    data.remove_prefix(data.size() - bytes);
  }
  switch (header.encoding) {
    case NrrdHeader::Encoding::kRaw:
      grid.values = decode_samples(data, count, header.type, header.order);
      if (data.size() > bytes) {
        grid.notes.push_back(counted_text(data.size() - bytes, "byte", "bytes") +
                             " behind the samples were left out");
      }
      break;
    case NrrdHeader::Encoding::kGzip:
      grid.values = decode_samples(unzipped(data, bytes), count, header.type, header.order);
      break;
    case NrrdHeader::Encoding::kText: {
      if (count > (data.size() + 1) / 2) {
        throw ReadFailure{"there are to be " + std::to_string(count) + " samples, but only " +
                          std::to_string(data.size()) + " bytes follow"};
      }
      TextScanner scanner(data, '\0');
      scanner.now_reading("the samples");
      grid.values.resize(count);
      for (double& value : grid.values) value = scanner.number();
      break;
    }
  }
  grid.type = values_of(header.type);
  return grid;
}

}  // namespace geotherm::io
