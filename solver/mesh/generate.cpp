// SPDX-License-Identifier: MIT
#include "solver/mesh/generate.h"

#include <array>

#include "solver/mesh/generate/models.h"

namespace geotherm {
namespace {

constexpr std::array<BundledModel, 5> kModels = {{
    {"terrain", 33'000, "mountains cut by rivers, a height field with an open border"},
    {"sleeve", 37'000, "a bent garment sleeve with folds, open at the shoulder and the cuff"},
    {"cube", 30'000, "a cube with exact edges and corners"},
    {"gargoyle", 200'000, "a horned, winged creature that crouches on a plinth"},
    {"bunny", 4'000, "a sitting rabbit"},
}};

using Make = Result<generate::DraftMesh> (*)(Index, const Progress&);
constexpr std::array<Make, kModels.size()> kMakers = {generate::make_terrain, generate::make_sleeve,
                                                      generate::make_cube, generate::make_gargoyle,
                                                      generate::make_bunny};

std::string all_names() {
  std::string names;
  for (const BundledModel& model : kModels) {
    names += (names.empty() ? "" : ", ") + std::string(model.name);
  }
  return names;
}

}  // namespace

std::span<const BundledModel> bundled_models() { return kModels; }

Result<TriangleMesh> generate_model(std::string_view name, Index faces, const Progress& progress) {
  std::size_t model = 0;
  while (model < kModels.size() && kModels[model].name != name) ++model;
  if (model == kModels.size()) {
    return Error{ErrorCode::kNotAvailable,
                 "there is no bundled model \"" + std::string(name) + "\"",
                 {"there are " + all_names()}};
  }
  const Index count = faces == 0 ? kModels[model].faces : faces;
  if (count < kFewestModelFaces || count > kMostModelFaces) {
    return Error{ErrorCode::kBadInput,
                 std::to_string(count) + " faces were asked for",
                 {"the model \"" + std::string(name) + "\" can have " +
                  std::to_string(kFewestModelFaces) + " to " + std::to_string(kMostModelFaces)}};
  }
  Result<generate::DraftMesh> made = kMakers[model](count, progress);
  if (!made) return made.error();
  return TriangleMesh::build(std::move(made->positions), std::move(made->faces));
}

}  // namespace geotherm
