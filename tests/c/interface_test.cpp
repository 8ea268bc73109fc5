// SPDX-License-Identifier: MIT
// The interface is what was promised: its declarations are those of the record, and its symbols
// those of the declarations.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "app/c/geotherm.h"

namespace {

using Names = std::set<std::string>;

std::string text_of(const char* path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  std::array<char, 4096> part{};
  while (pipe && std::fgets(part.data(), part.size(), pipe.get()) != nullptr) text += part.data();
  return text;
}

/// The declarations of a header, one a line, without comments and directives.
Names declarations(const std::string& header) {
  std::string text =
      std::regex_replace(header, std::regex(R"(/\*[^*]*\*+(?:[^/*][^*]*\*+)*/)"), " ");
  text = std::regex_replace(text, std::regex(R"((^|\n)[ \t]*#[^\n]*)"), "\n");
  text = std::regex_replace(text, std::regex(R"(extern "C" \{)"), " ");
  text = std::regex_replace(text, std::regex("GEOTHERM_API"), " ");
  text = std::regex_replace(text, std::regex(R"(\s+)"), " ");
  Names found;
  std::string one;
  int depth = 0;
  for (const char c : text) {
    depth += c == '{' ? 1 : c == '}' ? -1 : 0;
    if (c != ';' || depth > 0) {
      if (!(one.empty() && (c == ' ' || c == '}'))) one += c;
      if (depth < 0) depth = 0;
      continue;
    }
    found.insert(one);
    one.clear();
  }
  return found;
}

struct Record {
  int interface = -1;
  Names declarations;
};

Record record() {
  Record out;
  std::istringstream text(text_of(GEOTHERM_C_RECORD));
  std::string word;
  for (std::string line; std::getline(text, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    if (out.interface < 0) {
      std::istringstream(line) >> word >> out.interface;
    } else {
      out.declarations.insert(line);
    }
  }
  return out;
}

TEST(CInterface, NothingThatWasThereChangesWithoutItsNumber) {
  const Names now = declarations(text_of(GEOTHERM_C_HEADER));
  const Record then = record();
  ASSERT_FALSE(then.declarations.empty());
  ASSERT_EQ(then.interface, GEOTHERM_INTERFACE)
      << "the record is of another interface: write it anew from the header";
  for (const std::string& each : then.declarations) {
    EXPECT_TRUE(now.contains(each))
        << each << "\nis not in the header any more: raise GEOTHERM_INTERFACE and the interface of "
        << "app/c/CMakeLists.txt, then write tests/c/interface.txt anew";
  }
  for (const std::string& each : now) {
    EXPECT_TRUE(then.declarations.contains(each))
        << each << "\nis new: add this line to tests/c/interface.txt";
  }
}

TEST(CInterface, ADeclarationThatDiffersIsNoticed) {
  const Names now =
      declarations("int f(int a);\n/* int g(void); */\ntypedef struct s {\n int a; } s;");
  EXPECT_EQ(now, (Names{"int f(int a)", "typedef struct s { int a; } s"}));
}

TEST(CInterface, TheLibraryShowsItsFunctionsAndNothingElse) {
  Names declared, shown;
  for (const std::string& each : declarations(text_of(GEOTHERM_C_HEADER))) {
    std::smatch found;
    if (std::regex_search(each, found, std::regex(R"((geotherm_\w+)\()")))
      declared.insert(found[1]);
  }
  std::istringstream lines(output_of("nm -D --defined-only " GEOTHERM_C_LIBRARY));
  for (std::string address, kind, name; lines >> address >> kind >> name;) {
    if (kind != "A") shown.insert(name.substr(0, name.find('@')));  // A: the version itself
  }
  EXPECT_GE(declared.size(), 20U);
  EXPECT_EQ(declared, shown);
}

TEST(CInterface, TheNumberIsThatOfTheLibrarysName) {
  const std::string soname = output_of("readelf -d " GEOTHERM_C_LIBRARY " | grep SONAME");
  EXPECT_NE(soname.find("[libgeotherm.so." + std::to_string(GEOTHERM_INTERFACE) + "]"),
            std::string::npos)
      << soname;
  EXPECT_EQ(geotherm_interface(), GEOTHERM_INTERFACE);
}

}  // namespace
