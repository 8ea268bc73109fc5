// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/session/session.h"
#include "bench/models/generate.h"
#include "geotherm/io.h"

namespace geotherm::app {

/// A session, a folder of its own and a small model in it.
class SessionFixture : public testing::Test {
 protected:
  SessionFixture() {
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = testing::TempDir() + "geotherm_" + test->test_suite_name() + "_" + test->name() + "/";
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~SessionFixture() override { std::filesystem::remove_all(folder_); }

  const std::string& folder() const { return folder_; }

  static void write(const std::string& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
  }

  /// A terrain of about 600 faces, with a border.
  const std::string& small_model() {
    if (!model_.empty()) return model_;
    model_ = folder_ + "small.ply";
    const auto mesh = generate_model("terrain", 600);
    EXPECT_TRUE(mesh);
    EXPECT_TRUE(write_mesh(model_, *mesh));
    return model_;
  }

  void run(const std::vector<std::string>& lines) {
    for (const std::string& line : lines) {
      const auto command = parse_command(line);
      ASSERT_TRUE(command) << line << ": " << command.error().message;
      const auto done = session.submit(*command);
      ASSERT_TRUE(done) << line << ": " << done.error().message;
    }
  }

  /// Why a command is not done, in one line.
  std::string refused(const std::string& line) {
    const auto command = parse_command(line);
    if (!command) return sentence(command.error());
    const auto done = session.submit(*command);
    return done ? "done: " + line : sentence(done.error());
  }

  Session session;

 private:
  std::string folder_, model_;
};

}  // namespace geotherm::app
