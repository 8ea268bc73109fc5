// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace geotherm::ui {

/// A folder or a file as a dialog lists it.
struct FolderEntry {
  std::string name;
  bool is_folder = false;
  std::uintmax_t bytes = 0;
};

/// What a folder holds: folders first, both in alphabetical order whatever the case. Files: those
/// with one of the extensions (".obj"; whatever the case), or all of them without extensions.
/// Names that begin with a dot are left out. `error`: why there is nothing, one sentence.
struct FolderListing {
  std::vector<FolderEntry> entries;
  std::string error;
};
FolderListing list_folder(const std::filesystem::path& folder,
                          std::span<const std::string_view> extensions);

/// Whether a file name ends in one of the extensions.
bool has_extension(const std::filesystem::path& file, std::span<const std::string_view> extensions);

/// What was typed as a path: `~` is the user's folder, what is relative starts at `folder`.
std::filesystem::path typed_path(const std::string& text, const std::filesystem::path& folder);

}  // namespace geotherm::ui
