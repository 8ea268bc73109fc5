// SPDX-License-Identifier: MIT
#include "tests/app/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "tests/mesh/mesh_files.h"

namespace geotherm::test {
namespace {

/// In the child: never returns.
[[noreturn]] void become_program(const std::string& folder, std::vector<char*> argv,
                                 const std::string& in, const std::string& out,
                                 const std::string& err, Stdout output, unsigned seconds) {
  constexpr int kCannotStart = 120;
  const int input = ::open(in.c_str(), O_RDONLY);
  ::dup2(input, STDIN_FILENO);
  ::close(input);
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
  const rlimit nothing{0, 0};
  ::setrlimit(RLIMIT_CORE, &nothing);  // the core would lie among the outputs
  ::alarm(seconds);                    // outlives exec
  if (::chdir(folder.c_str()) == 0) ::execv(argv[0], argv.data());
  ::_exit(kCannotStart);
}

}  // namespace

RunningProgram::RunningProgram(const std::string& folder, const std::vector<std::string>& arguments,
                               Stdout output, unsigned seconds, const std::string& input)
    : output_(output) {
  std::vector<std::string> words = {GEOTHERM_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  process_ = ::fork();
  if (process_ == 0) {
    become_program(folder, argv, input.empty() ? "/dev/null" : input, streams_.path("out"),
                   streams_.path("err"), output, seconds);
  }
}

void RunningProgram::signal(int number) const {
  if (process_ > 0) ::kill(process_, number);
}

ProgramRun RunningProgram::wait() const {
  int status = 0;
  if (process_ < 0 || ::waitpid(process_, &status, 0) != process_) {
    ADD_FAILURE() << "the program could not be started";
    return {};
  }
  ProgramRun run;
  run.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  if (output_ == Stdout::kCaptured) run.out = bytes_of(streams_.path("out"));
  run.err = bytes_of(streams_.path("err"));
  return run;
}

ProgramRun run_program(const std::string& folder, const std::vector<std::string>& arguments,
                       Stdout output, unsigned seconds, const std::string& input) {
  return RunningProgram(folder, arguments, output, seconds, input).wait();
}

}  // namespace geotherm::test
