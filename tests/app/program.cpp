// SPDX-License-Identifier: MIT
#include "tests/app/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

/// In the child: never returns.
[[noreturn]] void become_program(const std::string& folder, std::vector<char*> argv,
                                 const std::string& out, const std::string& err, Stdout output) {
  constexpr int kCannotStart = 120;
  const int error = ::open(err.c_str(), O_WRONLY | O_CREAT, 0600);
  ::dup2(error, STDERR_FILENO);
  ::close(error);
  if (output == Stdout::kClosed) {
    ::close(STDOUT_FILENO);
  } else if (output == Stdout::kPipeWithoutReader) {
    int ends[2];
    if (::pipe(ends) != 0) ::_exit(kCannotStart);
    ::dup2(ends[1], STDOUT_FILENO);
    ::close(ends[0]);
    ::close(ends[1]);
    ::signal(SIGPIPE, SIG_DFL);
  } else {
    const char* const path = output == Stdout::kFull ? "/dev/full" : out.c_str();
    const int file = ::open(path, O_WRONLY | O_CREAT, 0600);
    ::dup2(file, STDOUT_FILENO);
    ::close(file);
  }
  if (::chdir(folder.c_str()) == 0) ::execv(argv[0], argv.data());
  ::_exit(kCannotStart);
}

}  // namespace

ProgramRun run_program(const std::string& folder, const std::vector<std::string>& arguments,
                       Stdout output) {
  const TemporaryDirectory streams;
  const std::string out = streams.path("out");
  const std::string err = streams.path("err");
  std::vector<std::string> words = {GEOTHERM_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) become_program(folder, argv, out, err, output);
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child) {
    ADD_FAILURE() << "the program could not be started";
    return {};
  }
  ProgramRun run;
  run.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (output == Stdout::kCaptured) run.out = bytes_of(out);
  run.err = bytes_of(err);
  return run;
}

}  // namespace geotherm::test
