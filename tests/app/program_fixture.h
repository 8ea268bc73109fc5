// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/app/program.h"
#include "tests/mesh/mesh_files.h"

namespace geotherm::test {

using Json = nlohmann::json;

/// Runs of the program in a folder of their own.
class Program : public testing::Test {
 protected:
  ProgramRun run(const std::vector<std::string>& arguments) {
    ProgramRun result = run_program(folder.path("."), arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    return result;
  }
  Json json(const std::vector<std::string>& arguments) {
    const ProgramRun result = run(arguments);
    Json value = Json::parse(result.out, nullptr, false);
    EXPECT_FALSE(value.is_discarded()) << result.out;
    return value;
  }
  /// Ends with one line that holds `says`.
  void expect_refused(const std::vector<std::string>& arguments, const std::string& says) {
    const ProgramRun result = run_program(folder.path("."), arguments);
    EXPECT_NE(result.code, 0);
    EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  }

  TemporaryDirectory folder;
};

/// The same where a device is needed to draw on: without one they are skipped, or fail where
/// GEOTHERM_REQUIRE_VULKAN is 1.
class DrawingProgram : public Program {
 protected:
  void SetUp() override {
    if (run_program(folder.path("."), {"devices"}).code != 0) {
      const char* const required = std::getenv("GEOTHERM_REQUIRE_VULKAN");
      ASSERT_FALSE(required && std::string(required) == "1") << "there is no Vulkan device";
      GTEST_SKIP() << "there is no Vulkan device; the software one of Mesa is enough";
    }
  }
};

/// Every key of `expected`, in every level of it, is in `actual`.
inline void expect_keys(const Json& actual, const Json& expected, const std::string& where) {
  for (const auto& item : expected.items()) {
    ASSERT_TRUE(actual.contains(item.key())) << where << item.key();
    if (item.value().is_object()) {
      expect_keys(actual[item.key()], item.value(), where + item.key() + ".");
    }
  }
}

/// An object with these keys.
inline Json keys(const std::vector<const char*>& names) {
  Json object = Json::object();
  for (const char* name : names) object[name] = nullptr;
  return object;
}

}  // namespace geotherm::test
