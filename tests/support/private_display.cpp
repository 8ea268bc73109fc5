// SPDX-License-Identifier: MIT
#include "tests/support/private_display.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>

extern char** environ;  // NOLINT: POSIX has it so

namespace geotherm::test {
namespace {

constexpr int kServerPatience = 20000;  // milliseconds, for a server on a busy machine

/// The number that the server writes when it is ready, followed by a new line.
std::string number_from(int pipe) {
  std::string text;
  while (text.empty() || text.back() != '\n') {
    pollfd ready{pipe, POLLIN, 0};
    char letter = 0;
    if (::poll(&ready, 1, kServerPatience) != 1 || ::read(pipe, &letter, 1) != 1) {
      throw std::runtime_error("Xvfb does not start");
    }
    text += letter;
  }
  text.pop_back();
  return text;
}

/// A word of the X window dump that Xvfb keeps its screen in: most significant byte first.
std::size_t word(const std::vector<std::uint8_t>& dump, std::size_t index) {
  std::size_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = value << 8U | dump.at(4 * index + k);
  return value;
}

}  // namespace

PrivateDisplay::PrivateDisplay(int width, int height) : width_(width), height_(height) {
  try {
    start();
  } catch (...) {
    stop();
    throw;
  }
}

PrivateDisplay::~PrivateDisplay() { stop(); }

void PrivateDisplay::start() {
  std::string pattern = (std::filesystem::temp_directory_path() / "geotherm-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = pattern;
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");

  const std::string fd = "9";
  const std::string size = std::to_string(width_) + "x" + std::to_string(height_) + "x24";
  const std::array<const char*, 12> words = {"Xvfb",      "-displayfd", fd.c_str(), "-screen",
                                             "0",         size.c_str(), "-fbdir",   folder_.c_str(),
                                             "-nolisten", "tcp",        "-noreset", nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe[1], std::stoi(fd));
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const int failure = ::posix_spawnp(&server_, "Xvfb", &actions, nullptr,
                                     const_cast<char* const*>(words.data()), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(pipe[1]);
  std::string number;
  try {
    if (failure != 0) {
      server_ = 0;
      throw std::runtime_error("Xvfb is not installed (Debian: xvfb)");
    }
    number = number_from(pipe[0]);
  } catch (...) {
    ::close(pipe[0]);
    throw;
  }
  ::close(pipe[0]);
  ::setenv("DISPLAY", (":" + number).c_str(), 1);
}

void PrivateDisplay::stop() {
  if (server_ > 0) {
    ::kill(server_, SIGTERM);
    ::waitpid(server_, nullptr, 0);
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

engine::Image PrivateDisplay::screen() const {
  std::ifstream file(folder_ / "Xvfb_screen0", std::ios::binary);
  const std::vector<std::uint8_t> dump{std::istreambuf_iterator<char>(file), {}};
  const std::size_t row = word(dump, 12);
  const std::size_t begin = word(dump, 0) + 12 * word(dump, 19);  // header, colour map
  engine::Image image;
  image.width = width_;
  image.height = height_;
  const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t at = begin + y * row + 4 * x;  // blue, green, red, nothing
      image.pixels.insert(image.pixels.end(), {dump.at(at + 2), dump.at(at + 1), dump.at(at), 255});
    }
  }
  return image;
}

void xdotool(const std::string& words) {
  if (std::system(("xdotool " + words).c_str()) != 0) {
    throw std::runtime_error("xdotool " + words + " failed (Debian: xdotool)");
  }
}

}  // namespace geotherm::test
