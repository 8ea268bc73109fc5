// SPDX-License-Identifier: MIT
#include "solver/mesh/io/vtk_xml.h"

#include <algorithm>
#include <utility>

#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/text_scanner.h"

namespace geotherm::io {
namespace {

constexpr std::string_view kXmlSpace = " \t\r\n";

constexpr struct {
  std::string_view name;
  NumberType type;
} kXmlTypes[] = {{"Int8", NumberType::kInt8},       {"UInt8", NumberType::kUint8},
                 {"Int16", NumberType::kInt16},     {"UInt16", NumberType::kUint16},
                 {"Int32", NumberType::kInt32},     {"UInt32", NumberType::kUint32},
                 {"Int64", NumberType::kInt64},     {"UInt64", NumberType::kUint64},
                 {"Float32", NumberType::kFloat32}, {"Float64", NumberType::kFloat64}};

}  // namespace

std::optional<XmlTag> XmlTags::next() {
  for (;;) {
    const std::size_t open = text_.find('<', at_);
    if (open == text_.npos) return {};
    if (text_.substr(open).starts_with("<!--")) {
      pass(open, "-->");
    } else if (text_.substr(open).starts_with("<?") || text_.substr(open).starts_with("<!")) {
      pass(open, ">");
    } else {
      return tag_at(open);
    }
  }
}

void XmlTags::pass(std::size_t open, std::string_view end) {
  const std::size_t close = text_.find(end, open);
  if (close == text_.npos) fail_at_line(text_, text_.data() + open, "a comment does not end");
  at_ = close + end.size();
}

XmlTag XmlTags::tag_at(std::size_t open) {
  std::size_t close = open + 1;
  for (char quote = '\0'; close < text_.size() && (quote != '\0' || text_[close] != '>'); ++close) {
    const char c = text_[close];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    }
  }
  if (close == text_.size()) {
    fail_at_line(text_, text_.data() + open, "a tag does not end: the file ends in it");
  }
  const std::string_view inside = text_.substr(open + 1, close - open - 1);
  const std::size_t length = std::min(inside.find_first_of(kXmlSpace), inside.size());
  at_ = close + 1;
  std::string_view name = inside.substr(0, length);
  if (name.ends_with('/')) name.remove_suffix(1);
  return {name, inside.substr(length), at_};
}

std::optional<std::string_view> attribute(const XmlTag& tag, std::string_view name) {
  std::string_view rest = tag.attributes;
  for (;;) {
    rest.remove_prefix(std::min(rest.find_first_not_of(kXmlSpace), rest.size()));
    const std::size_t equal = rest.find('=');
    if (equal == rest.npos) return {};
    const std::string_view key = rest.substr(0, std::min(equal, rest.find_first_of(kXmlSpace)));
    const std::size_t quote = rest.find_first_of("\"'", equal);
    if (quote == rest.npos) return {};
    const std::size_t end = rest.find(rest[quote], quote + 1);
    if (end == rest.npos) return {};
    if (key == name) return rest.substr(quote + 1, end - quote - 1);
    rest.remove_prefix(end + 1);
  }
}

void fail_at_tag(std::string_view bytes, const XmlTag& tag, const std::string& cause, Hint hint) {
  fail_at_line(bytes, tag.name.data(), cause, std::move(hint));
}

VtuEncoding read_vtk_file_tag(std::string_view bytes, const XmlTag& tag, std::string_view type,
                              Hint hint) {
  const std::string_view held = attribute(tag, "type").value_or("");
  if (held != type) {
    fail_at_tag(bytes, tag,
                "the file holds " + quoted(held, held.data()) + ", not " + std::string(type),
                std::move(hint));
  }
  VtuEncoding encoding;
  if (attribute(tag, "byte_order") == "BigEndian") encoding.order = std::endian::big;
  if (attribute(tag, "header_type") == "UInt64") encoding.size_of_length = 8;
  const auto compressor = attribute(tag, "compressor");
  encoding.compressed = compressor && !compressor->empty();
  if (encoding.compressed && *compressor != "vtkZLibDataCompressor") {
    fail_at_tag(bytes, tag,
                "the compressor " + quoted(*compressor, compressor->data()) + " is not supported",
                {"save it compressed by ZLib or not at all"});
  }
  return encoding;
}

VtuArray read_vtk_array_tag(std::string_view bytes, const XmlTag& tag) {
  VtuArray array;
  const std::string_view type = attribute(tag, "type").value_or("");
  const auto* const known = std::find_if(std::begin(kXmlTypes), std::end(kXmlTypes),
                                         [type](const auto& each) { return each.name == type; });
  if (known == std::end(kXmlTypes)) {
    fail_at_tag(bytes, tag, "the type of numbers " + quoted(type, type.data()) + " is unknown");
  }
  array.type = known->type;
  const std::string_view format = attribute(tag, "format").value_or("ascii");
  if (format == "appended") {
    array.format = VtuArray::Format::kAppended;
    array.place = static_cast<std::uint64_t>(vtk_number(bytes, tag, "offset"));
  } else {
    array.format = format == "ascii" ? VtuArray::Format::kText : VtuArray::Format::kBase64;
    array.place = tag.behind;
  }
  return array;
}

void read_vtk_appended_tag(std::string_view bytes, const XmlTag& tag, VtuEncoding& encoding) {
  const std::size_t mark = bytes.find('_', tag.behind);
  if (mark == bytes.npos) fail_at_tag(bytes, tag, "the appended data have no mark _");
  encoding.appended = mark + 1;
  encoding.appended_base64 = attribute(tag, "encoding").value_or("base64") == "base64";
}

std::int64_t vtk_number(std::string_view bytes, const XmlTag& tag, std::string_view name) {
  const auto text = attribute(tag, name);
  std::int64_t value = -1;
  if (text && parse_integer(text->data(), value) == text->data() + text->size() && value >= 0 &&
      static_cast<std::uint64_t>(value) <= kMaxVtkNumbers * bytes.size()) {
    return value;
  }
  fail_at_tag(bytes, tag,
              std::string(name) + (text ? " is " + quoted(*text, text->data()) : " is missing") +
                  " in a file of " + std::to_string(bytes.size()) + " bytes");
}

}  // namespace geotherm::io
