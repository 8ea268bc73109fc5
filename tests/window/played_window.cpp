// SPDX-License-Identifier: MIT
#include "tests/window/played_window.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <utility>

namespace geotherm::test {
namespace {

// The layout that the window starts with, pixels: what it reads from its configuration.
constexpr int kBarWidth = 310, kLogHeight = 190;
constexpr int kLine = 21;        ///< height of the menu bar, and of the status bar
constexpr int kTools = 30;       ///< of the toolbar
constexpr int kFieldAbove = 41;  ///< the command field, above the window's lower edge
constexpr long kFrame = 15;      ///< clock ticks, more than one frame takes
constexpr int kSteps = 6;        ///< of a drag

/// A number out of a command that prints some.
std::string output_of(const std::string& command) {
  std::string text;
  FILE* const pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return text;
  for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe)) {
    text += static_cast<char>(letter);
  }
  ::pclose(pipe);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

/// Modifier keys before and after what they go with.
std::string down(const std::string& modifier) {
  return modifier.empty() ? "" : "keydown " + modifier + " ";
}
std::string up(const std::string& modifier) { return modifier.empty() ? "" : " keyup " + modifier; }

/// Such keys are read as what is typed. They are not lost when they are short, and held down they
/// are typed again and again.
bool is_typed(const std::string& key) { return key.size() == 1 || key == "plus" || key == "minus"; }

std::string at(Spot spot) { return std::to_string(spot.x) + " " + std::to_string(spot.y) + " "; }

}  // namespace

void PlayedWindow::give_up(const std::string& why) {
  const char* const wish = std::getenv("GEOTHERM_REQUIRE_VULKAN");
  if (wish != nullptr && std::string_view(wish) == "1") FAIL() << why;
  GTEST_SKIP() << why;
}

void PlayedWindow::SetUp() {
  if (std::system("command -v xdotool > /dev/null") != 0) {
    return give_up("xdotool is not installed (Debian: xdotool)");
  }
  try {
    display_.emplace(width_, height_);
  } catch (const std::runtime_error& error) {
    return give_up(error.what());
  }
  ::unsetenv("WAYLAND_DISPLAY");
  ::setenv("XDG_CACHE_HOME", path("cache").c_str(), 1);
  ::setenv("XDG_CONFIG_HOME", path("config").c_str(), 1);
  std::filesystem::create_directories(path("config/geotherm"));
  std::ofstream(path("config/geotherm/viewer.conf"))
      << "log = on\nleft-width = " << kBarWidth << "\nright-width = " << kBarWidth
      << "\nlog-height = " << kLogHeight << "\nopen View = off\nopen Advanced settings = on\n";
  if (const ProgramRun devices = run_program(path("."), {"devices"}); devices.code != 0) {
    give_up(devices.err);
  }
}

void PlayedWindow::start(std::vector<std::string> arguments, int samples) {
  arguments.insert(arguments.begin(), "view");
  for (const std::string& word :
       {std::string("--validation"), std::string("--samples"), std::to_string(samples)}) {
    arguments.push_back(word);
  }
  program_.emplace(path("."), arguments);
  const bool seen = eventually([this] {
    window_ = output_of("xdotool search --onlyvisible --class geotherm 2> /dev/null");
    return !window_.empty() || !program_->runs();
  });
  ASSERT_TRUE(seen) << "no window";
  ASSERT_TRUE(program_->runs()) << program_->end().err;
  EXPECT_TRUE(eventually([this] { return *display_->screen().at(kPanel.x, kPanel.y) > 0; }))
      << "nothing is drawn";
  settle();
}

void PlayedWindow::quit() {
  press("ctrl+q");
  const ProgramRun run = program_->end();
  EXPECT_EQ(run.code, 0);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "");
}

void PlayedWindow::settle() { EXPECT_TRUE(program_->rest()) << "the program does not rest"; }

void PlayedWindow::play(const std::string& words, long ticks) {
  const long before = program_->ticks();
  xdotool(words);
  EXPECT_TRUE(program_->notice(before, ticks)) << words << ": the program takes no notice";
}

void PlayedWindow::hold(const std::string& words) {
  xdotool(words);
  EXPECT_TRUE(program_->notice(program_->ticks(), kFrame))
      << words << ": the program takes no notice";
}

void PlayedWindow::point_at(Spot spot) {
  // The frame that sees both moves may take less than a notice: more of them add up.
  const std::string words = "mousemove " + at({spot.x, spot.y + 2}) + "mousemove " + at(spot);
  const long before = program_->ticks();
  EXPECT_TRUE(eventually([&] {
    xdotool(words);
    return !program_->runs() || program_->ticks() >= before + kNotice;
  })) << words
      << ": the program takes no notice";
}

void PlayedWindow::move_to(Spot spot) {
  point_at(spot);
  settle();
}

void PlayedWindow::click(Spot spot, const std::string& modifier, int button) {
  in_field_ = false;
  point_at(spot);
  const std::string number = std::to_string(button);
  hold(down(modifier) + "mousedown " + number);
  play("mouseup " + number + up(modifier));
  settle();
}

void PlayedWindow::drag(Spot from, Spot to, const std::string& modifier, int button) {
  in_field_ = false;
  point_at(from);
  const std::string number = std::to_string(button);
  hold(down(modifier) + "mousedown " + number);
  for (int step = 1; step <= kSteps; ++step) {
    play("mousemove " +
         at({from.x + (to.x - from.x) * step / kSteps, from.y + (to.y - from.y) * step / kSteps}));
  }
  play("mouseup " + number + up(modifier));
  settle();
}

void PlayedWindow::turn_wheel(Spot spot, bool up, int notches) {
  point_at(spot);
  for (int i = 0; i < notches; ++i) play(up ? "click 4" : "click 5");
  settle();
}

void PlayedWindow::press(const std::string& key) {
  leave_field();
  const std::size_t plus = key.find('+');
  const std::string modifier = plus == std::string::npos ? "" : key.substr(0, plus);
  const std::string rest = plus == std::string::npos ? key : key.substr(plus + 1);
  if (is_typed(key)) {
    play("key " + key);
    return settle();
  }
  hold(down(modifier) + "keydown " + rest);
  play("keyup " + rest + up(modifier));
  settle();
}

void PlayedWindow::enter(const std::string& text) {
  hold("type --delay 2 --args 1 '" + text + "' keydown Return");
  play("keyup Return");
  settle();
}

void PlayedWindow::resize(int width, int height) {
  width_ = width;
  height_ = height;
  const std::string words = "windowsize " + window_ + " " + at({width, height});
  constexpr int kTiny = 100'000;  // pixels: such a picture is drawn in less than a clock tick
  if (width * height < kTiny) {
    xdotool(words);
  } else {
    play(words, 1);
  }
  settle();
}

void PlayedWindow::run(const std::vector<std::string>& commands) {
  if (!in_field_) click({width_ / 2, height_ - kFieldAbove});
  in_field_ = true;  // the field waits for the next one
  for (const std::string& command : commands) enter(command);
}

void PlayedWindow::leave_field() {
  if (!std::exchange(in_field_, false)) return;
  hold("keydown Escape");
  play("keyup Escape");
  settle();
}

std::vector<std::string> PlayedWindow::log() {
  const std::string name = "log" + std::to_string(++logs_) + ".geotherm";
  run({"save log " + name});
  EXPECT_TRUE(eventually([&] { return is_there(name); }));
  std::vector<std::string> commands = lines_of(path(name));
  // The last two say how large the picture is seen.
  while (!commands.empty() &&
         (commands.back().starts_with("size ") || commands.back().starts_with("text-size "))) {
    commands.pop_back();
  }
  std::erase_if(commands, [](const auto& line) { return line.starts_with("save log"); });
  return commands;
}

std::vector<std::string> PlayedWindow::lines_of(const std::string& path) const {
  std::istringstream text(bytes_of(path));
  std::vector<std::string> commands;
  for (std::string line; std::getline(text, line);) {
    if (!line.empty() && line.front() != '#' && line.front() != ':') commands.push_back(line);
  }
  return commands;
}

Picture PlayedWindow::canvas_on_screen() {
  move_to(kPanel);                             // the pointer is seen
  constexpr int kTop = (kLine + kTools) & ~1;  // pictures begin at even pixels
  const int bottom = height_ - kLine - kLogHeight;
  return part_of(display_->screen(), kBarWidth, kTop, width_ - 2 * kBarWidth, bottom - kTop);
}

bool PlayedWindow::is_there(const std::string& name) const {
  return std::filesystem::exists(path(name));
}

std::string line_with(const std::vector<std::string>& lines, const std::string& beginning) {
  const auto found = std::find_if(lines.begin(), lines.end(), [&](const std::string& line) {
    return line.starts_with(beginning);
  });
  return found == lines.end() ? "" : *found;
}

}  // namespace geotherm::test
