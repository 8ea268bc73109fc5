// SPDX-License-Identifier: MIT
#include <charconv>
#include <concepts>
#include <cstdint>

#include "solver/mesh/io/format_writers.h"

namespace geotherm::io {
namespace {

template <class T>
requires std::integral<T> || std::floating_point<T>
void append(std::string& text, T value) {
  char digits[32];
  text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

void append(std::string& text, const Vec3& p) {
  append(text, p.x());
  text += ' ';
  append(text, p.y());
  text += ' ';
  append(text, p.z());
  text += '\n';
}

}  // namespace

std::string csv_bytes(std::span<const double> distances, std::span<const Index> nearest,
                      std::span<const DataField> fields) {
  std::string text = nearest.empty() ? "vertex,distance" : "vertex,distance,nearest_source";
  for (const DataField& field : fields) text += ',' + field.name;
  text += '\n';
  text.reserve((28 + 20 * fields.size()) * distances.size() + text.size());
  for (std::size_t v = 0; v < distances.size(); ++v) {
    append(text, v);
    text += ',';
    append(text, distances[v]);
    if (!nearest.empty()) {
      text += ',';
      append(text, nearest[v]);
    }
    for (const DataField& field : fields) {
      text += ',';
      append(text, field.values[v]);
    }
    text += '\n';
  }
  return text;
}

std::string obj_bytes(const TriangleMesh& mesh) {
  std::string text;
  text.reserve(64 * mesh.positions().size() + 24 * mesh.faces().size());
  for (const Vec3& p : mesh.positions()) {
    text += "v ";
    append(text, p);
  }
  for (const Face& face : mesh.faces()) {
    text += 'f';
    for (const Index corner : face) {
      text += ' ';
      append(text, std::int64_t{corner} + 1);
    }
    text += '\n';
  }
  return text;
}

std::string off_bytes(const TriangleMesh& mesh) {
  std::string text = "OFF\n";
  text.reserve(64 * mesh.positions().size() + 24 * mesh.faces().size());
  append(text, mesh.vertex_count());
  text += ' ';
  append(text, mesh.face_count());
  text += " 0\n";
  for (const Vec3& p : mesh.positions()) append(text, p);
  for (const Face& face : mesh.faces()) {
    text += '3';
    for (const Index corner : face) {
      text += ' ';
      append(text, corner);
    }
    text += '\n';
  }
  return text;
}

}  // namespace geotherm::io
