// SPDX-License-Identifier: MIT
// Masks: which vertices or faces of a mesh a file leaves out.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "geotherm/io.h"
#include "geotherm/mesh.h"
#include "solver/core/text.h"
#include "solver/mesh/io/formats.h"
#include "solver/mesh/io/gifti_reader.h"
#include "solver/mesh/io/input_file.h"
#include "solver/mesh/io/mask_numbers.h"
#include "solver/mesh/io/npy_header.h"
#include "solver/mesh/io/ply_body.h"
#include "solver/mesh/io/text_scanner.h"

namespace geotherm {
namespace io {

MaskText parse_mask_text(std::string text) {
  MaskText out;
  const auto take = [&text](std::string_view word) {
    if (!text.starts_with(word)) return false;
    text.erase(0, word.size());
    return true;
  };
  out.keeps = take("keep:");
  out.of_faces = take("faces:");
  const std::size_t colon = text.rfind(':');
  std::error_code unknown;
  const bool named = colon != text.npos && !std::filesystem::exists(text, unknown) &&
                     model_extension(text.substr(0, colon)) == ".ply";
  out.path = named ? text.substr(0, colon) : text;
  if (named) out.property = text.substr(colon + 1);
  return out;
}

namespace {

MaskNumbers numbers_in_text(std::string_view text) try {
  MaskNumbers out;
  TextScanner scanner(text, '#');
  while (!scanner.at_end()) {
    scanner.now_reading("number", std::ssize(out.values) + 1);
    out.values.push_back(scanner.coordinate());
  }
  return out;
} catch (ReadFailure& failure) {
  failure.hint = {"write numbers with blanks or ends of lines between them"};
  throw;
}

/// A .label of FreeSurfer: a line of words, the number of vertices, and a line for each: its
/// number, its place, a value.
MaskNumbers numbers_in_label(std::string_view text) {
  MaskNumbers out;
  out.ids = true;
  TextScanner scanner(text, '\0');
  scanner.now_reading("the header");
  if (scanner.peek().starts_with('#')) scanner.skip_line();
  const std::int64_t count = scanner.integer();
  checked_count(scanner, count, "vertices", (scanner.bytes_left() + 1) / 2,
                "the header announces ");
  for (std::int64_t i = 0; i < count; ++i) {
    scanner.skip_line();
    scanner.now_reading("line", i + 1, count);
    out.values.push_back(static_cast<double>(scanner.integer()));
  }
  return out;
}

MaskNumbers numbers_in_npy(std::string_view bytes) {
  const NpyHeader header = read_npy_header(bytes);
  MaskNumbers out;
  out.flags = header.type == "b1";
  const std::string_view data = bytes.substr(header.begins);
  const auto type = number_type_of(header);
  if (!type) {
    fail_at_byte(bytes, bytes.data() + header.type_place,
                 "numbers of the type " + printable(header.type) + " are no mask");
  }
  out.values = decode_numbers(data, data.size() / size_of(*type), *type, header.order);
  std::int64_t count = 1;
  for (const std::int64_t length : header.shape) {
    const auto most = static_cast<std::int64_t>(bytes.size());
    count = length < 0 || length > most || count > most ? -1 : count * length;
  }
  if (count != std::ssize(out.values)) {
    fail_at_byte(bytes, bytes.data() + header.shape_place,
                 "the file has " + std::to_string(out.values.size()) +
                     " numbers, which is not what its shape says");
  }
  return out;
}

MaskNumbers numbers_in_ply(std::string_view bytes, const std::string& name) {
  const PlyHeader header = read_ply_header(bytes);
  const PlyElement* const vertex = header.find("vertex");
  const int found = vertex == nullptr || name.empty() ? -1 : vertex->find(name, false);
  if (found < 0) {
    std::vector<std::string> names;
    for (const auto& p : vertex ? vertex->properties : std::vector<PlyProperty>()) {
      if (!p.is_list) names.push_back(p.name);
    }
    std::string listed;
    for (const auto& each : names) listed += (listed.empty() ? "" : ", ") + printable(each);
    fail_at_line(bytes, header.body - 1,
                 name.empty() ? "the property that is the mask is not named"
                              : "the vertices have no property " + printable(name),
                 {"write FILE.ply:NAME with one of " + listed});
  }
  MaskNumbers out;
  out.flags = true;
  with_ply_body(bytes, header, [&](auto body) {
    for (const PlyElement& element : header.elements) {
      if (&element != vertex) {
        skip_rows(body, element);
        continue;
      }
      return read_rows(body, element, [&](std::int64_t, std::size_t k) {
        const PlyProperty& property = element.properties[k];
        if (static_cast<int>(k) != found) return skip(body, property);
        out.values.push_back(body.number(property.type));
      });
    }
  });
  return out;
}

}  // namespace

MaskNumbers read_mask_numbers(std::string_view bytes, const std::string& extension,
                              const std::string& property) {
  if (extension == ".npy") return numbers_in_npy(bytes);
  if (extension == ".label") return numbers_in_label(bytes);
  if (extension == ".ply") return numbers_in_ply(bytes, property);
  if (extension == ".gii") return {read_gifti_numbers(bytes), true, false};
  return numbers_in_text(bytes);
}

namespace {

/// A list of flags of numbers. `count`: how many there are of what they number.
Result<std::vector<char>> flags_of(const MaskNumbers& numbers, const MaskText& text, bool of_flags,
                                   Index count) {
  const char unmarked = text.keeps ? 1 : 0, marked = text.keeps ? 0 : 1;
  std::vector<char> out(static_cast<std::size_t>(count), unmarked);
  for (std::size_t i = 0; i < numbers.values.size(); ++i) {
    const double value = numbers.values[i];
    if (of_flags) {
      if (value != 0) out[i] = marked;
      continue;
    }
    if (!(value >= 0 && value < count && value == std::floor(value))) {
      return Error{ErrorCode::kBadFile,
                   printable(text.path) + ": number " + std::to_string(i + 1) + " of the mask is " +
                       number_text(value) + ", and " + (text.of_faces ? "faces" : "vertices") +
                       " are 0 to " + std::to_string(count - 1),
                   {"give a 0 or 1 for each, or numbers of those there are"}};
    }
    char& flag = out[static_cast<std::size_t>(value)];
    if (flag == marked && !numbers.ids) {
      return Error{ErrorCode::kBadFile,
                   printable(text.path) + ": number " + std::to_string(i + 1) + " of the " +
                       std::to_string(numbers.values.size()) + " of the mask names " +
                       (text.of_faces ? "face " : "vertex ") + number_text(value) +
                       " again, and the mesh has " + std::to_string(count) +
                       (text.of_faces ? " faces" : " vertices"),
                   {"name each once, or give a 0 or 1 for all of them"}};
    }
    flag = marked;
  }
  return out;
}

}  // namespace
}  // namespace io

Result<Mask> read_mask(const std::string& text, const TriangleMesh& mesh) {
  const io::MaskText what = io::parse_mask_text(text);
  if (what.path.empty()) {
    return Error{ErrorCode::kBadInput,
                 "the mask '" + io::printable(text) + "' names no file",
                 {"write FILE, keep:FILE or faces:FILE"}};
  }
  const auto file = io::InputFile::open(what.path);
  if (!file) return file.error();
  return io::read_unchanged(*file, file->shown(), "mask", [&]() -> Result<Mask> {
    const io::FileBytes bytes(*file);
    const std::string extension = io::file_extension(what.path);
    const io::MaskNumbers numbers = io::read_mask_numbers(bytes.bytes(), extension, what.property);
    const auto is_flag = [](double value) { return value == 0 || value == 1; };
    const bool binary = !numbers.ids && std::ranges::all_of(numbers.values, is_flag);
    const bool flags = numbers.flags || binary;
    const auto size = static_cast<Index>(numbers.values.size());
    constexpr Index kMaxIds = 2;  // of a list of ids in which there are only 0 and 1
    const Index vertices = mesh.vertex_count(), faces = mesh.face_count();
    const bool of_faces = what.of_faces || (flags && size == faces && size != vertices);
    const Index count = of_faces ? faces : vertices;
    if ((numbers.flags || (binary && size > kMaxIds)) && size != count) {
      return Error{ErrorCode::kBadFile,
                   io::printable(what.path) + ": the mask has " + std::to_string(size) +
                       " numbers, and the mesh " + std::to_string(vertices) + " vertices and " +
                       std::to_string(faces) + " faces",
                   {"take the mask of this mesh"}};
    }
    auto list = io::flags_of(numbers, what, flags && size == count, count);
    if (!list) return list.error();
    Mask mask;
    (of_faces ? mask.faces : mask.vertices) = *std::move(list);
    return mask;
  });
}

}  // namespace geotherm
