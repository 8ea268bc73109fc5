// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace geotherm::rules {

/// A file of the project: its path from the root, with forward slashes, and what it holds.
struct SourceFile {
  std::string path;
  std::string text;
};

struct Violation {
  std::string path;
  int line = 0;  ///< 1-based; 0: the file as a whole
  std::string what;
};

/// Which folder and which library each folder may include: the table of docs/architecture.md.
std::vector<Violation> check_includes(const SourceFile& file);

/// GLFW is used by one file of `engine/`, ImGui's backends by one file of `engine/`.
std::vector<Violation> check_lone_users(std::span<const SourceFile> files);

/// The file says its licence in its first two lines.
std::vector<Violation> check_licence(const SourceFile& file);

/// At most 400 lines.
std::vector<Violation> check_length(const SourceFile& file);

/// No #if on a backend outside solver/linear/backend_registry.cpp.
std::vector<Violation> check_backend_conditions(const SourceFile& file);

/// No string of the library, the engine, the session or the viewer names an option of the command
/// line, but for the table of settings: hints name settings. No string of the library and the
/// engine names a sub-command ("geotherm WORD"): other programs use them, too.
std::vector<Violation> check_option_names(const SourceFile& file);

/// All paragraphs of a ```cpp block of the page stand, but for their indentation, in one of the
/// examples among `files`, which are compiled and run.
std::vector<Violation> check_snippets(const SourceFile& page, std::span<const SourceFile> files);

/// Every path in backticks that begins with a folder of the tree exists below `root`; one with
/// capitals stands for others.
std::vector<Violation> check_paths(const SourceFile& page, const std::filesystem::path& root);

/// README.md and the pages of docs/.
std::vector<SourceFile> read_pages(const std::filesystem::path& root);

/// C++ sources and shaders, as opposed to scripts and CMake files.
bool is_code(std::string_view path);

/// A file below `root`.
SourceFile read_file(const std::filesystem::path& root, const std::filesystem::path& path);

/// All sources, shaders, scripts and CMake files below `root`, in the order of their paths.
std::vector<SourceFile> read_tree(const std::filesystem::path& root);

}  // namespace geotherm::rules
