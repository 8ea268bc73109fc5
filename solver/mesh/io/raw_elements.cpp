// SPDX-License-Identifier: MIT
#include "solver/mesh/io/raw_elements.h"

#include <utility>

#include "solver/mesh/io/input_file.h"

namespace geotherm::io {

std::string text_of_others(const RawElements& raw) {
  std::string text;
  for (const auto& [kind, count] : raw.others) {
    text += (text.empty() ? "" : ", ") + kind + " (" + std::to_string(count) + ")";
  }
  return text;
}

Hint cure_of_others(const std::string& others, const char* needed) {
  if (others.find(" corners (") == others.npos) return {needed};
  return {"save it with straight elements, those of first order"};
}

RawMesh faces_of(RawElements raw) {
  for (const char* const kind : {"triangles", "triangle strips", "quads", "polygons"}) {
    raw.others.erase(kind);
  }
  if (!raw.tets.empty()) raw.others["tetrahedra"] = static_cast<std::int64_t>(raw.tets.size());
  const std::string others = text_of_others(raw);
  if (raw.faces.empty()) {
    throw ReadFailure{"the file has no triangles or polygons, but " +
                          std::to_string(raw.positions.size()) + " vertices" +
                          (others.empty() ? "" : " and " + others),
                      0,
                      {},
                      cure_of_others(others, "a surface needs faces")};
  }
  if (!others.empty()) raw.notes.push_back("left out, being no faces: " + others);
  return std::move(static_cast<RawMesh&>(raw));
}

}  // namespace geotherm::io
