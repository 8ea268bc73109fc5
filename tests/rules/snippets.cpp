// SPDX-License-Identifier: MIT
#include <algorithm>
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
  std::string paragraph;
  int first = 0;  // its line
  const auto end_paragraph = [&] {
    const auto holds = [&](const std::string& text) {
      return text.find("\n" + paragraph) != std::string::npos;
    };
    if (!paragraph.empty() && std::none_of(examples.begin(), examples.end(), holds)) {
      found.push_back({page.path, first, "is in no file of docs/examples"});
    }
    paragraph.clear();
  };
  std::istringstream stream(page.text);
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const bool fence = line.starts_with("```");
    if (fence || line.empty()) end_paragraph();
    if (fence) inside = !inside && (line == "```cpp" || line == "```c");
    if (!inside || fence || line.empty()) continue;
    if (paragraph.empty()) first = number;
    paragraph += trimmed(line);
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
