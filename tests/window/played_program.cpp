// SPDX-License-Identifier: MIT
#include "tests/window/played_program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

extern char** environ;  // NOLINT: POSIX has it so

namespace geotherm::test {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kLook{10};     ///< between two looks
constexpr std::chrono::milliseconds kAsleep{100};  ///< without work: longer than between frames

}  // namespace

bool eventually(const std::function<bool()>& so) {
  const auto end = Clock::now() + kPatience;
  while (!so()) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(kLook);
  }
  return true;
}

PlayedProgram::PlayedProgram(const std::string& folder, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {GEOTHERM_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  constexpr int kNew = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, streams_.path("out").c_str(), kNew,
                                   0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, streams_.path("err").c_str(), kNew,
                                   0600);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  const int failure = ::posix_spawn(&process_, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) {
    process_ = 0;
    throw std::runtime_error("the program cannot be started");
  }
}

PlayedProgram::~PlayedProgram() {
  if (process_ == 0 || !runs()) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

bool PlayedProgram::runs() {
  if (!ended_) ended_ = ::waitpid(process_, &status_, WNOHANG) == process_;
  return !ended_;
}

ProgramRun PlayedProgram::end() {
  ProgramRun run;
  const bool ended = eventually([this] { return !runs(); });
  if (ended) run.code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
  run.out = bytes_of(streams_.path("out"));
  run.err = bytes_of(streams_.path("err"));
  return run;
}

long PlayedProgram::ticks() const {
  std::ifstream file("/proc/" + std::to_string(process_) + "/stat");
  std::string text;
  std::getline(file, text);
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string skipped;
  for (int field = 3; field < 14; ++field) fields >> skipped;  // numbered from 1, as in proc(5)
  long user = 0, system = 0;
  fields >> user >> system;
  return user + system;
}

bool PlayedProgram::notice(long before, long more) {
  return eventually([&] { return !runs() || ticks() >= before + more; });
}

bool PlayedProgram::rest() {
  long used = ticks();
  auto since = Clock::now();
  return eventually([&] {
    if (!runs()) return true;
    if (const long now = ticks(); now != used) {
      used = now;
      since = Clock::now();
    }
    return Clock::now() - since > kAsleep;
  });
}

}  // namespace geotherm::test
