// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <system_error>
#include <thread>

#include "app/cli/command_line.h"
#include "app/cli/viewer_window.h"
#include "app/session/ranks.h"
#include "solver/mesh/output_file.h"

namespace {

/// A standard stream that the caller closed would give its number to the next file that is opened,
/// and what is printed would end up in it. What stands in for it here refuses every use instead.
void occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) != -1) continue;
    [[maybe_unused]] const int taken =
        ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

extern "C" void end_by_signal(int number) {
  geotherm::remove_unfinished_files();
  ::raise(number);  // by then as if there were no handler: the status tells the caller why
}

/// A signal that ends the program leaves no half-written file behind; one that the caller has the
/// program ignore (nohup) stays ignored. A file that grows beyond its limit is an error like
/// others.
void end_tidily_by_signals() {
  constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
  struct sigaction action {};
  action.sa_handler = end_by_signal;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int number : kSignals) ::sigaddset(&action.sa_mask, number);
  for (const int number : kSignals) {
    struct sigaction before {};
    if (::sigaction(number, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) {
      ::sigaction(number, &action, nullptr);
    }
  }
  ::signal(SIGXFSZ, SIG_IGN);
}

/// Drivers and BLAS want more stack than a low limit (ulimit -s) leaves to the first thread and,
/// unless it is set here, to all others. Both are mapped apart from the limit where they are asked
/// for by size. False: the first thread is as good as another.
bool give_threads_their_stack() {
  constexpr rlim_t kStack = rlim_t{8} << 20;  // what systems usually give
  struct rlimit limit {};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= kStack) return false;
  pthread_attr_t attributes;
  if (::pthread_attr_init(&attributes) != 0) return false;
  const bool set = ::pthread_attr_setstacksize(&attributes, kStack) == 0 &&
                   ::pthread_setattr_default_np(&attributes) == 0;
  ::pthread_attr_destroy(&attributes);
  return set;
}

int run(int argc, char** argv) {
  try {
    const std::unique_ptr<geotherm::app::Drawing> drawing = geotherm::app::make_drawing();
    const std::unique_ptr<geotherm::app::ViewerWindow> window = geotherm::app::make_window();
    return geotherm::app::run_command_line({argv + (argc > 0 ? 1 : 0), argv + argc}, *drawing,
                                           *window);
  } catch (const std::bad_alloc&) {
    const bool rank = geotherm::app::launched_as().count > 1;
    std::fprintf(stderr, "geotherm: error: not enough memory; try %s\n",
                 rank ? "more ranks, or fewer on each machine" : "a smaller mesh or --backend cg");
  } catch (const std::system_error& failure) {  // no thread could be started, most likely
    std::fprintf(stderr, "geotherm: error: the system refuses: %s; try --threads 1\n",
                 failure.what());
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "geotherm: error: unexpected: %s; please report it\n", failure.what());
  }
  return 1;
}

int run_on_enough_stack(int argc, char** argv) {
  if (!give_threads_their_stack()) return run(argc, argv);
  int code = 1;
  try {
    const std::jthread thread([&] { code = run(argc, argv); });
  } catch (const std::system_error& failure) {
    std::fprintf(stderr,
                 "geotherm: error: no thread with a stack of 8 MB: %s; raise ulimit -s or -v\n",
                 failure.what());
  }
  return code;
}

}  // namespace

// A reader that closes its end of the pipe ends the program in the usual way, by SIGPIPE: files are
// written before standard output.
int main(int argc, char** argv) {
  occupy_closed_streams();
  end_tidily_by_signals();
  const int code = run_on_enough_stack(argc, argv);
  std::fflush(nullptr);
  // Without the handlers of exit(): OpenBLAS waits there for its threads, and these wait for memory
  // where there is none left.
  std::_Exit(code);
}
