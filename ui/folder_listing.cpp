// SPDX-License-Identifier: MIT
#include "ui/folder_listing.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

namespace geotherm::ui {
namespace {

namespace fs = std::filesystem;

std::string in_small_letters(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
  }
  return text;
}

bool comes_first(const FolderEntry& a, const FolderEntry& b) {
  if (a.is_folder != b.is_folder) return a.is_folder;
  const std::string x = in_small_letters(a.name), y = in_small_letters(b.name);
  return x != y ? x < y : a.name < b.name;
}

}  // namespace

bool has_extension(const fs::path& file, std::span<const std::string_view> extensions) {
  const std::string extension = in_small_letters(file.extension().string());
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

FolderListing list_folder(const fs::path& folder, std::span<const std::string_view> extensions) {
  FolderListing listing;
  std::error_code error;
  fs::directory_iterator at(folder, error);
  for (; !error && at != fs::directory_iterator(); at.increment(error)) {
    FolderEntry entry;
    entry.name = at->path().filename().string();
    if (entry.name.starts_with('.')) continue;
    std::error_code unknown;  // a link to nowhere is no reason to list nothing
    entry.is_folder = at->is_directory(unknown);
    if (!entry.is_folder) {
      if (!extensions.empty() && !has_extension(at->path(), extensions)) continue;
      entry.bytes = at->file_size(unknown);
      if (unknown) entry.bytes = 0;
    }
    listing.entries.push_back(std::move(entry));
  }
  if (error) listing.error = folder.string() + " cannot be listed: " + error.message();
  std::sort(listing.entries.begin(), listing.entries.end(), comes_first);
  return listing;
}

fs::path typed_path(const std::string& text, const fs::path& folder) {
  fs::path path = text;
  if (text == "~" || text.starts_with("~/")) {
    const char* home = std::getenv("HOME");
    if (home) path = fs::path(home) / text.substr(std::min<std::size_t>(2, text.size()));
  }
  return (path.is_absolute() ? path : folder / path).lexically_normal();
}

}  // namespace geotherm::ui
