// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "app/session/compare.h"
#include "bench/models/generate.h"
#include "geotherm/heat_method.h"

namespace geotherm::test {
namespace {

using namespace geotherm::app;

/// How the work in a process with little memory ended.
enum Ending { kDone, kRefused, kThrown, kWithoutHint, kOther };

/// A stack that cannot grow ends the process, which nothing could turn into an error.
void grow_stack() {
  volatile char pages[1 << 20];
  for (std::size_t i = 0; i < sizeof(pages); i += 1024) pages[i] = 0;
}

/// Leaves this process `megabytes` more than it has; what it freed before is filled.
void limit_memory(std::size_t megabytes) {
  grow_stack();
  constexpr std::size_t kLargest = 64 << 20, kSmallest = 64 << 10;
  const rlimit nothing{0, RLIM_INFINITY};
  ::setrlimit(RLIMIT_AS, &nothing);
  for (std::size_t bytes = kLargest; bytes >= kSmallest; bytes /= 2) {
    const void* volatile taken = nullptr;  // or the compiler sees that nobody uses it
    do {
      taken = std::malloc(bytes);
    } while (taken != nullptr);
  }
  const rlimit anything{RLIM_INFINITY, RLIM_INFINITY};
  ::setrlimit(RLIMIT_AS, &anything);
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t most = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + (megabytes << 20);
  const rlimit limit{most, most};
  ::setrlimit(RLIMIT_AS, &limit);
}

/// `work`, which returns an Ending, in a process of its own that has `megabytes` for it.
template <class Work>
Ending with_memory(std::size_t megabytes, const Work& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    limit_memory(megabytes);
    Ending ending = kOther;
    try {
      ending = work();
    } catch (...) {
      ending = kThrown;
    }
    ::_exit(ending);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) ADD_FAILURE() << "signal " << WTERMSIG(status);
  return WIFEXITED(status) ? static_cast<Ending>(WEXITSTATUS(status)) : kOther;
}

Ending ending_of(ErrorCode code, const Hint& hint) {
  if (code != ErrorCode::kOutOfMemory) return kOther;
  return hint.empty() ? kWithoutHint : kRefused;
}

/// A model that leaves little free memory behind in the process when it is made.
Model tidy_model() {
  constexpr int kSmall = 64 * 1024;
  ::mallopt(M_MMAP_THRESHOLD, kSmall);  // larger blocks go back to the system when they are freed
  auto mesh = std::make_shared<const TriangleMesh>(*generate_model("terrain", 20000));
  return {"terrain", "", std::move(mesh), 0, {}};
}

/// Not cholmod: the BLAS that it works with waits for memory for ever instead of failing.
class LittleMemory : public testing::TestWithParam<std::string> {
 protected:
  /// Tries `work` with ever more memory; it must be refused at first, and done at last.
  template <class Work>
  void expect_refusals_then_done(const Work& work) {
    constexpr std::size_t kStep = 2, kMax = 200;
    int refused = 0;
    for (std::size_t megabytes = 1; megabytes < kMax; megabytes += kStep) {
      const Ending ending = with_memory(megabytes, work);
      ASSERT_TRUE(ending == kDone || ending == kRefused)
          << "ending " << ending << " with " << megabytes << " MB";
      refused += ending == kRefused;
      if (ending == kDone) break;
    }
    EXPECT_GT(refused, 0);
  }

  Model model = tidy_model();
};

TEST_P(LittleMemory, IsAnErrorOfTheLibraryWithAHint) {
  HeatOptions options;
  options.backend = GetParam();
  options.threads = 1;
  expect_refusals_then_done([&] {
    const auto method = HeatMethod::build(model.mesh, options);
    if (!method) return ending_of(method.error().code, method.error().hint);
    const auto result = method->solve(SourceSet::of_vertices({1}));
    if (!result) return ending_of(result.error().code, result.error().hint);
    HeatOptions other = options;
    other.time_step.factor = 2;
    const auto changed = method->with(other);
    return changed ? kDone : ending_of(changed.error().code, changed.error().hint);
  });
}

TEST_P(LittleMemory, IsARowOfTheComparison) {
  CompareTask task;
  MethodOptions solver;
  solver.threads = 1;
  solver.backend = GetParam();
  task.solvers = {solver};
  task.reference = GetParam();
  task.queries = {SourceSet::of_vertices({1})};
  task.batch = {SourceSet::of_vertices({2})};
  expect_refusals_then_done([&] {
    const auto rows = compare_backends(model, task);
    if (!rows || rows->size() != 1) return kOther;
    const CompareRow& row = rows->front();
    if (row.status == "ok") return kDone;
    const bool memory = row.status == "out of memory";
    return ending_of(memory ? ErrorCode::kOutOfMemory : ErrorCode::kCancelled, row.note.hint);
  });
}

INSTANTIATE_TEST_SUITE_P(Of, LittleMemory, testing::Values("eigen-ldlt", "cg"),
                         [](const auto& test) {
                           return test.param == "cg" ? test.param : std::string("eigen");
                         });

}  // namespace
}  // namespace geotherm::test
