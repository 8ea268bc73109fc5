// SPDX-License-Identifier: MIT
// The interface is what was promised: its declarations are those of the record, and its symbols
// those of the declarations.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>

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

/// What an interface declares. A line "released VERSION HASH" freezes all above it.
struct Record {
  Names declarations;
  std::set<std::string> released;  ///< versions
  std::string broken;  ///< a version whose declarations were edited afterwards; empty: none
};

/// FNV-1a, in hexadecimal digits.
std::string hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  std::ostringstream out;
  out << std::hex << hash;
  return out.str();
}

Record record_in(const std::string& text) {
  Record out;
  std::string above;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.starts_with('#')) continue;
    std::istringstream words(line);
    std::string word, version, hash;
    if (words >> word >> version >> hash; word == "released") {
      out.released.insert(version);
      if (hash != hash_of(above)) out.broken = version + " (its hash is " + hash_of(above) + ")";
    } else {
      out.declarations.insert(line);
      above += line + '\n';
    }
  }
  return out;
}

std::string record_path(int number) {
  return GEOTHERM_C_RECORDS "/interface_" + std::to_string(number) + ".txt";
}

TEST(CInterface, NothingThatWasThereChangesWithoutItsNumber) {
  const Names now = declarations(text_of(GEOTHERM_C_HEADER));
  const Record then = record_in(text_of(record_path(GEOTHERM_INTERFACE).c_str()));
  ASSERT_FALSE(then.declarations.empty()) << record_path(GEOTHERM_INTERFACE) << " is missing";
  for (const std::string& each : then.declarations) {
    EXPECT_TRUE(now.contains(each))
        << each << "\nis not in the header any more: raise GEOTHERM_INTERFACE and the interface of "
        << "app/c/CMakeLists.txt, and write another record; what no release had may be edited";
  }
  for (const std::string& each : now) {
    EXPECT_TRUE(then.declarations.contains(each))
        << each << "\nis new: add this line at the end of " << record_path(GEOTHERM_INTERFACE);
  }
}

TEST(CInterface, WhatWasReleasedIsFrozen) {
  std::set<std::string> frozen;
  for (int number = 0; number <= GEOTHERM_INTERFACE; ++number) {
    const Record each = record_in(text_of(record_path(number).c_str()));
    EXPECT_FALSE(each.declarations.empty()) << record_path(number) << " is missing";
    EXPECT_EQ(each.broken, "") << record_path(number) << " was edited above this release";
    frozen.insert(each.released.begin(), each.released.end());
  }
  const std::string changes = text_of(GEOTHERM_CHANGELOG);
  const std::regex heading(R"(\n## \[(\d+\.\d+\.\d+)\])");
  for (std::sregex_iterator at(changes.begin(), changes.end(), heading), end; at != end; ++at) {
    const std::string version = (*at)[1];
    EXPECT_TRUE(frozen.contains(version))
        << version << " is released: add the line 'released " << version << " HASH' at the end of "
        << record_path(GEOTHERM_INTERFACE);
  }
}

TEST(CInterface, AnEditOfAReleasedRecordIsNoticed) {
  const std::string text = "int f(void)\nreleased 1.0.0 " + hash_of("int f(void)\n") + "\n";
  EXPECT_EQ(record_in(text + "int g(void)\n").broken, "");
  EXPECT_EQ(record_in(text).released, (Names{"1.0.0"}));
  EXPECT_NE(record_in("int g(void)\n" + text).broken.find("1.0.0"), std::string::npos);
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
