// SPDX-License-Identifier: MIT
#include "app/bundled_models.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <vector>

#include "app/text.h"

namespace geotherm::app {
namespace {

constexpr BundledModel kModels[] = {
    {"terrain", 33'000, "mountains cut by rivers, a height field with an open border",
     "a landscape with one boundary"},
    {"sleeve", 37'000, "a bent garment sleeve with folds, open at the shoulder and the cuff",
     "a tube with two boundaries"},
    {"cube", 30'000, "a cube with exact edges and corners", "with exact edges"},
    {"gargoyle", 200'000, "a horned, winged creature that crouches on a plinth", "200,000 faces"},
    {"bunny", 4'000, "a sitting rabbit", "4,000 faces"},
};

/// Where files of models are looked for, in this order.
std::vector<std::filesystem::path> folders() {
  const char* const chosen = std::getenv("GEOTHERM_MODELS");
  if (chosen && *chosen) return {chosen};
  std::vector<std::filesystem::path> found;
  std::error_code unknown;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  if (!unknown) {
    found.push_back((program.parent_path() / GEOTHERM_INSTALLED_MODELS).lexically_normal());
  }
  found.emplace_back(GEOTHERM_SOURCE_MODELS);
  return found;
}

}  // namespace

std::span<const BundledModel> bundled_models() { return kModels; }

bool is_bundled(std::string_view name) {
  return std::ranges::find(kModels, name, &BundledModel::name) != std::end(kModels);
}

Result<std::string> bundled_file(std::string_view name) {
  const std::string file = std::string(name) + ".ply";
  std::vector<std::string> tried;
  for (const std::filesystem::path& folder : folders()) {
    std::error_code unknown;
    if (std::filesystem::exists(folder / file, unknown)) return (folder / file).string();
    tried.push_back(one_line(folder.string()));
  }
  return Error{ErrorCode::kBadFile, "the bundled model " + std::string(name) + " has no file " +
                                        file + " in " + joined(tried, " or ") +
                                        "; install geotherm again, or set GEOTHERM_MODELS to the "
                                        "folder that holds it"};
}

}  // namespace geotherm::app
