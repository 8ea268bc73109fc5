// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <thread>

#include "app/cli/command_line.h"
#include "app/cli/viewer_window.h"
#include "app/session/ranks.h"
#include "app/session/wording.h"
#include "app/text/text.h"
#include "solver/linear/mpi_module.h"
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

/// Lets ranks before this one speak first, which may have met the same.
void wait_for_others() {
  if (!geotherm::mpi_is_started()) return;
  const double seconds = geotherm::app::seconds_for_others(geotherm::app::launched_as().rank);
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// One line, and the end of all ranks where there are several.
int end_with(int code, const std::string& line) {
  const geotherm::RankOfCount ours = geotherm::app::launched_as();
  const std::string rank = ours.count > 1 ? "rank " + std::to_string(ours.rank) + ": " : "";
  std::fprintf(stderr, "geotherm: error: %s%s\n", rank.c_str(), line.c_str());
  geotherm::end_all_ranks(code);
  return code;
}

int run(int argc, char** argv) {
  using namespace geotherm::app;
  try {
    const std::unique_ptr<Drawing> drawing = make_drawing();
    const std::unique_ptr<ViewerWindow> window = make_window();
    return run_command_line({argv + (argc > 0 ? 1 : 0), argv + argc}, *drawing, *window);
  } catch (const std::bad_alloc&) {
    wait_for_others();
    const bool rank = launched_as().count > 1;
    return end_with(
        1, std::string("not enough memory; try ") +
               (rank ? "more ranks, or fewer on each machine" : "a smaller mesh or --backend cg"));
  } catch (const UnheardError& unheard) {  // which has waited
    return end_with(exit_code(unheard.error.code), one_line(to_text(unheard.error)));
  } catch (const std::system_error& failure) {  // no thread could be started, most likely
    wait_for_others();
    return end_with(1, "the system refuses: " + std::string(failure.what()) + "; try --threads 1");
  } catch (const std::exception& failure) {
    wait_for_others();
    return end_with(1, "unexpected: " + std::string(failure.what()) + "; please report it");
  }
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
