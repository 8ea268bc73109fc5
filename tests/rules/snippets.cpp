// SPDX-License-Identifier: MIT
#include <algorithm>
#include <regex>
#include <sstream>

#include "tests/rules/source_rules.h"

namespace geotherm::rules {
namespace {

/// The line without what it begins with in blanks.
std::string trimmed(const std::string& line) {
  return line.substr(std::min(line.find_first_not_of(' '), line.size())) + "\n";
}

std::string without_indentation(const std::string& text) {
  std::istringstream stream(text);
  std::string result = "\n";
  for (std::string line; std::getline(stream, line);) result += trimmed(line);
  return result;
}

}  // namespace

std::vector<Violation> check_snippets(const SourceFile& page, std::span<const SourceFile> files) {
  std::vector<std::string> examples;
  for (const SourceFile& file : files) {
    if (file.path.starts_with("docs/examples/")) {
      examples.push_back(without_indentation(file.text));
    }
  }
  std::vector<Violation> found;
  std::vector<std::string> left;  // the examples that hold the block so far
  std::string paragraph;
  int first = 0;  // its line
  const auto end_paragraph = [&] {
    if (paragraph.empty()) return;
    std::erase_if(left, [&](const std::string& text) {
      return text.find("\n" + paragraph) == std::string::npos;
    });
    paragraph.clear();
    if (left.empty()) found.push_back({page.path, first, "is in no one file of docs/examples"});
  };
  std::istringstream stream(page.text);
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const bool fence = line.starts_with("```");
    if (fence || line.empty()) end_paragraph();
    if (fence) {
      inside = !inside && (line.starts_with("```cpp") || line == "```c" || line == "```c++");
      left = examples;
    }
    if (!inside || fence || line.empty() || left.empty()) continue;
    if (paragraph.empty()) first = number;
    paragraph += trimmed(line);
  }
  return found;
}

std::vector<Violation> check_paths(const SourceFile& page, const std::filesystem::path& root) {
  static const std::regex kPath(
      "`((app|assets|bench|cmake|docs|engine|scripts|shaders|solver|tests|ui)/[a-z0-9_./-]+)`");
  std::vector<Violation> found;
  std::istringstream stream(page.text);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    for (std::sregex_iterator at(line.begin(), line.end(), kPath), end; at != end; ++at) {
      if (std::filesystem::exists(root / at->str(1))) continue;
      found.push_back({page.path, number, at->str(1) + " does not exist"});
    }
  }
  return found;
}

std::vector<SourceFile> read_pages(const std::filesystem::path& root) {
  std::vector<SourceFile> pages = {read_file(root, root / "README.md")};
  for (const auto& entry : std::filesystem::directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") pages.push_back(read_file(root, entry.path()));
  }
  return pages;
}

}  // namespace geotherm::rules
