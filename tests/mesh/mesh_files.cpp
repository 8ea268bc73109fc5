// SPDX-License-Identifier: MIT
#include "tests/mesh/mesh_files.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace geotherm::test {
namespace {

template <class T>
void append(std::string& bytes, T value, std::endian order) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (order != std::endian::native) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

std::string ply_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment a pyramid\nelement vertex 5\nproperty uchar red\nproperty float y\n"
         "property double x\nproperty float32 z\nelement edge 2\nproperty list uint8 short ends\n"
         "element face 5\nproperty float quality\nproperty list ushort uint vertex_index\n"
         "end_header\n";
}

std::string ply_binary(const std::string& format, std::endian order) {
  std::string bytes = ply_header(format);
  for (const Vec3& p : pyramid_positions()) {
    append(bytes, std::uint8_t{200}, order);
    append(bytes, static_cast<float>(p.y()), order);
    append(bytes, p.x(), order);
    append(bytes, static_cast<float>(p.z()), order);
  }
  for (int edge = 0; edge < 2; ++edge) {
    append(bytes, std::uint8_t{2}, order);
    append(bytes, std::int16_t{-1}, order);
    append(bytes, std::int16_t{7}, order);
  }
  const std::vector<std::vector<std::uint32_t>> faces = {
      {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {3, 2, 1, 0}};
  for (const auto& face : faces) {
    append(bytes, 0.5f, order);
    append(bytes, static_cast<std::uint16_t>(face.size()), order);
    for (const std::uint32_t corner : face) append(bytes, corner, order);
  }
  return bytes;
}

std::string stl_binary(std::string header) {
  header.resize(80, '\0');
  append(header, std::uint32_t{6}, std::endian::little);
  const std::vector<Vec3> positions = pyramid_positions();
  for (const Face& face : pyramid_faces()) {
    for (int k = 0; k < 3; ++k) append(header, 0.0f, std::endian::little);
    for (const Index corner : face) {
      for (int axis = 0; axis < 3; ++axis) {
        append(header, static_cast<float>(positions[static_cast<std::size_t>(corner)][axis]),
               std::endian::little);
      }
    }
    append(header, std::uint16_t{0}, std::endian::little);
  }
  return header;
}

/// `beside`: numbers behind the position of a vertex. The last face has no colour.
std::string off_binary(const std::string& keyword, int beside) {
  const auto whole = [](std::string& bytes, std::int32_t number) {
    append(bytes, number, std::endian::big);
  };
  const auto reals = [](std::string& bytes, int count) {
    for (int k = 0; k < count; ++k) append(bytes, 0.5f, std::endian::big);
  };
  std::string bytes = keyword + " BINARY\n";
  for (const std::int32_t count : {5, 5, 0}) whole(bytes, count);
  for (const Vec3& position : pyramid_positions()) {
    for (int axis = 0; axis < 3; ++axis) {
      append(bytes, static_cast<float>(position[axis]), std::endian::big);
    }
    reals(bytes, beside);
  }
  for (std::int32_t side = 0; side < 4; ++side) {
    for (const std::int32_t number : {3, side, (side + 1) % 4, 4, 3}) whole(bytes, number);
    reals(bytes, 3);
  }
  for (const std::int32_t number : {4, 3, 2, 1, 0, 0}) whole(bytes, number);
  return bytes;
}

std::string stl_ascii() {
  std::string text = "solid a pyramid\n";
  const std::vector<Vec3> positions = pyramid_positions();
  for (const Face& face : pyramid_faces()) {
    text += "  facet normal nan 0 0\n    outer loop\n";
    for (const Index corner : face) {
      const Vec3& p = positions[static_cast<std::size_t>(corner)];
      text += "      vertex " + std::to_string(p.x()) + ' ' + std::to_string(p.y()) + ' ' +
              std::to_string(p.z()) + '\n';
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid a pyramid\n";
}

std::string with_crlf(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\n' ? std::string("\r\n") : std::string(1, c);
  return result;
}

}  // namespace

TemporaryDirectory::TemporaryDirectory() {
  path_ = (std::filesystem::temp_directory_path() / "geotherm-test-XXXXXX").string();
  if (::mkdtemp(path_.data()) == nullptr) ADD_FAILURE() << "no temporary directory " << path_;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryDirectory::write(std::string_view name, std::string_view bytes) const {
  std::string file = path(name);
  std::filesystem::remove(file);  // a new file is much faster than one cut short and written again
  std::ofstream(file, std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return file;
}

std::vector<std::string> TemporaryDirectory::names() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(path_)) {
    names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

Result<MeshFile> read_bytes(std::string_view name, std::string_view bytes) {
  const TemporaryDirectory directory;
  return read_mesh(directory.write(name, bytes));
}

void damage(std::string& bytes, std::mt19937_64& random) {
  constexpr std::string_view kWords[] = {
      "2147483647", "-1", "nan", "1e999", "99999999999999999999", "\n", "\\\n", "/", "#", "0"};
  const auto below = [&random](std::size_t bound) { return random() % bound; };
  if (bytes.empty()) bytes.push_back('v');
  const std::size_t at = below(bytes.size());
  switch (below(6)) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
      break;
    case 1:
      bytes[at] = static_cast<char>(random());
      break;
    case 2:
      bytes.resize(at);
      break;
    case 3:
      bytes.insert(at, kWords[below(std::size(kWords))]);
      break;
    case 4:
      bytes.erase(at, 1 + below(8));
      break;
    default: {
      const std::string piece = bytes.substr(at, 1 + below(64));
      bytes.insert(below(bytes.size()), piece);
    }
  }
}

std::vector<Vec3> pyramid_positions() {
  return {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 1.5}};
}

std::vector<Face> pyramid_faces() {
  return {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {3, 2, 1}, {3, 1, 0}};
}

std::vector<Sample> pyramid_samples() {
  const std::string vertices = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 1.5\n";
  const std::string obj = vertices + "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 4 3 2 1\n";
  const std::string off_body =
      "0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1 1.5\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n4 3 2 1 0\n";
  const std::string ply_ascii = ply_header("ascii") +
                                "200 0 0 0\n9 0 2 0\n9 2 2 0\n9 2 0 0\n9 1 1 1.5\n"
                                "2 -1 7\n1 5\n"
                                "0.5 3 0 1 4\n0 3 1 2 4\n0 3 2 3 4\nnan 3 3 0 4\n0 4 3 2 1 0\n";
  std::vector<Sample> all = {
      {"obj", "a.obj", obj},
      {"obj_with_crlf", "a.OBJ", with_crlf(obj)},
      {"obj_without_last_newline", "a.obj", obj.substr(0, obj.size() - 1)},
      {"obj_with_byte_order_mark", "a.obj", "\xef\xbb\xbf" + obj},
      {"obj_with_texture_coordinates", "a.obj",
       vertices + "vt 0 0\nvt 1 1\nf 1/1 2/2 5/1\nf 2/1 3/2 5/1\nf 3/1 4/1 5/1\nf 4/1 1/1 5/1\n"
                  "f 4/1 3/1 2/1 1/1\n"},
      {"obj_with_normals", "a.obj",
       vertices + "vn 0 0 1\nf 1//1 2//1 5//1\nf 2//1 3//1 5//1\nf 3//1 4//1 5//1\n"
                  "f 4//1 1//1 5//1\nf 4//1 3//1 2//1 1//1\n"},
      {"obj_with_both", "a.obj",
       vertices + "f 1/1/1 2/1/1 5/1/1\nf 2/1/-1 3/1/1 5/1/1\nf 3/1/1 4/123456789/1 5/1/1\n"
                  "f 4/1/1 1/1/1 5/1/1\nf 4/1/1 3/1/1 2/1/1 1/1/1\n"},
      {"obj_with_relative_indices", "a.obj",
       "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 1 1.5\nf -5 -4 -1\nf -4 -3 -1\nf 3 -2 -1\n"
       "f -2 -5 -1\nf -2 -3 -4 -5\n"},
      {"obj_with_faces_first", "a.obj",
       "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 4 3 2 1\n" + vertices},
      {"obj_with_everything_else", "a.obj",
       "# comment\nmtllib a.mtl\n\n  o thing\ng one two\n\tv 0 0 0 1.0\nv  2\t0 0 0.5 0.5 0.5\n"
       "v 2 2 0 # here\nv 0e3 +2.0 -0.0\nusemtl m\nv 1 \\\n 1.0E0 \\\r\n 15e-1\ns off\nvp 1 2\n"
       "f 1 2 5 # there\nf 2 3 5 \nf 3 4\\\n 5\nl 1 2\nf 4 1 5#\nf 4 3 2 1\nfrobnicate 1\n# v "
       "\\\n"},
      {"off", "a.off", "OFF\n5 5 0\n" + off_body},
      {"off_with_crlf", "a.off", with_crlf("OFF\n5 5 0\n" + off_body)},
      {"off_with_counts_in_the_first_line", "a.off", "OFF 5 5 0\n" + off_body},
      {"off_without_its_keyword", "a.off", "5 5\n" + off_body},
      {"off_with_comments", "a.off", "# one\nOFF # two\n\n# three\n5 5 8 # four\n#\n" + off_body},
      {"coff", "a.off",
       "COFF\n5 5 0\n0 0 0 255 0 0 255\n2 0 0 1 1 1 1\n2 2 0 1 1 1 1\n0 2 0 0 0 0 0\n"
       "1 1 1.5 0.1 0.2 0.3 1\n3 0 1 4 255 0 0\n3 1 2 4\n3 2 3 4 0.5 0.5 0.5\n3 3 0 4\n"
       "4 3 2 1 0 7\n"},
      {"noff", "a.off",
       "NOFF\n5 5 0\n0 0 0 0 0 1\n2 0 0 0 0 1\n2 2 0 0 0 1\n0 2 0 0 0 1\n1 1 1.5 0 0 1\n"
       "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n4 3 2 1 0\n"},
      {"off_binary", "a.off", off_binary("OFF", 0)},
      {"off_binary_with_normals_and_colours", "a.off", off_binary("CNOFF", 7)},
      {"ply_ascii", "a.ply", ply_ascii},
      {"ply_ascii_with_crlf", "a.ply", with_crlf(ply_ascii)},
      {"ply_little_endian", "a.ply", ply_binary("binary_little_endian", std::endian::little)},
      {"ply_big_endian", "a.ply", ply_binary("binary_big_endian", std::endian::big)},
      {"stl_ascii", "a.stl", stl_ascii()},
      {"stl_ascii_with_crlf", "a.stl", with_crlf(stl_ascii())},
      {"stl_binary", "a.stl", stl_binary("made by hand")},
      {"stl_binary_that_starts_with_solid", "a.stl", stl_binary("solid but not text")},
      {"stl_binary_that_starts_with_a_mark", "a.stl", stl_binary("\xef\xbb\xbf made by hand")},
      {"ply_packed", "a.ply.gz", gzipped(ply_ascii)},
  };
  const std::vector<Sample> others = surface_samples();
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

}  // namespace geotherm::test
