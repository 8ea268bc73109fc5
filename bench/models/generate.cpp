// SPDX-License-Identifier: MIT
#include "bench/models/generate.h"

#include <algorithm>
#include <string>
#include <utility>

#include "bench/models/draft_mesh.h"

namespace geotherm {
namespace {

struct Maker {
  std::string_view name;
  Result<generate::DraftMesh> (*make)(Index faces, const Progress& progress);
};
constexpr Maker kMakers[] = {{"terrain", generate::make_terrain},
                             {"sleeve", generate::make_sleeve},
                             {"cube", generate::make_cube},
                             {"gargoyle", generate::make_gargoyle},
                             {"bunny", generate::make_bunny}};

std::string all_names() {
  std::string names;
  for (const Maker& maker : kMakers) {
    names += (names.empty() ? "" : ", ") + std::string(maker.name);
  }
  return names;
}

}  // namespace

Result<TriangleMesh> generate_model(std::string_view name, Index faces, const Progress& progress) {
  const auto* const maker = std::ranges::find(kMakers, name, &Maker::name);
  if (maker == std::end(kMakers)) {
    return Error{ErrorCode::kNotAvailable, "there is no bundled model \"" + std::string(name) +
                                               "\"; there are " + all_names()};
  }
  if (faces < kMinModelFaces || faces > kMaxModelFaces) {
    return Error{ErrorCode::kBadInput,
                 std::to_string(faces) + " faces were asked for; the model \"" + std::string(name) +
                     "\" can have " + std::to_string(kMinModelFaces) + " to " +
                     std::to_string(kMaxModelFaces)};
  }
  Result<generate::DraftMesh> made = maker->make(faces, progress);
  if (!made) return made.error();
  return TriangleMesh::build(std::move(made->positions), std::move(made->faces));
}

}  // namespace geotherm
