// SPDX-License-Identifier: MIT
// A signal at any moment of a write: the target is as it was or whole, and nothing lies beside it.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>
#include <thread>

#include "solver/mesh/output_file.h"
#include "tests/mesh/mesh_files.h"
#include "tests/support/sanitized.h"

namespace geotherm::test {
namespace {

constexpr int kInterruptions = kSanitized ? 8 : 25;
constexpr std::uint64_t kWriteSeed = 20252;
constexpr std::size_t kBytes = 4 << 20;  // most of the time of a write lies between begin and end

extern "C" void remove_and_end(int number) {
  remove_unfinished_files();
  ::raise(number);
}

/// In the child: writes the same two files again and again on two threads, until a signal ends it.
[[noreturn]] void write_for_ever(const TemporaryDirectory& folder, const std::string& bytes) {
  struct sigaction action {};
  action.sa_handler = remove_and_end;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGTERM, &action, nullptr);
  const auto write = [&](const char* name) {
    while (write_file(folder.path(name), bytes)) continue;
    for (;;) ::pause();  // refused: the handler is at work
  };
  std::thread other(write, "a");
  write("b");
  ::_exit(1);
}

TEST(InterruptedWrite, LeavesWholeFilesAndNoOthers) {
  const std::string bytes(kBytes, 'x');
  std::mt19937_64 random(kWriteSeed);
  int written = 0;
  for (int i = 0; i < kInterruptions; ++i) {
    const TemporaryDirectory folder;
    const pid_t child = ::fork();
    if (child == 0) write_for_ever(folder, bytes);
    ::usleep(static_cast<useconds_t>(2000 + random() % 10000));
    ::kill(child, SIGTERM);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) << status;
    for (const std::string& name : folder.names()) {
      EXPECT_TRUE(name == "a" || name == "b") << name;
      EXPECT_EQ(bytes_of(folder.path(name)).size(), kBytes) << name;
      ++written;
    }
  }
  EXPECT_GT(written, 0);
}

/// SIGKILL leaves no time for anything: the next writer of the same file clears up, but only after
/// those that have ended.
TEST(InterruptedWrite, WhatWasKilledIsRemovedByTheNextWriter) {
  const TemporaryDirectory folder;
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    auto file = GrowingFile::open(folder.path("a"));
    const bool begun = file && file->append("half");
    [[maybe_unused]] const auto told = ::write(ready[1], begun ? "x" : "", begun ? 1 : 0);
    ::close(ready[1]);
    for (;;) ::pause();
  }
  ::close(ready[1]);
  char begun = 0;
  ASSERT_EQ(::read(ready[0], &begun, 1), 1);
  ::close(ready[0]);
  EXPECT_TRUE(write_file(folder.path("a"), "whole"));
  EXPECT_EQ(folder.names().size(), 2U);  // the child's, too
  ::kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(write_file(folder.path("a"), "whole"));
  EXPECT_EQ(folder.names().size(), 1U);
  EXPECT_EQ(bytes_of(folder.path("a")), "whole");
}

}  // namespace
}  // namespace geotherm::test
