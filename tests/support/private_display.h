// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "engine/target.h"

namespace geotherm::test {

/// A display in memory (Xvfb) with nothing on it, named by DISPLAY of this process until it ends.
class PrivateDisplay {
 public:
  /// Pixels. Throws std::runtime_error with the reason.
  explicit PrivateDisplay(int width = 1024, int height = 768);
  PrivateDisplay(const PrivateDisplay&) = delete;
  PrivateDisplay& operator=(const PrivateDisplay&) = delete;
  ~PrivateDisplay();

  /// What it shows now.
  engine::Image screen() const;

 private:
  void start();
  void stop();

  int width_, height_;
  std::filesystem::path folder_;
  pid_t server_ = 0;  ///< 0: none
};

/// Runs xdotool and waits for it. Throws std::runtime_error where that fails.
void xdotool(const std::string& words);

}  // namespace geotherm::test
