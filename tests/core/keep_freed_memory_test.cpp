// SPDX-License-Identifier: MIT
#include "solver/core/memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <vector>

#include "tests/support/sanitized.h"

namespace geotherm {
namespace {

#ifdef __GLIBC__
constexpr bool kOfGlibc = !test::kSanitized;
#else
constexpr bool kOfGlibc = false;
#endif

/// Pages that this process touched for the first time while it took, filled and freed the answers
/// of a batch.
long pages_of_a_batch() {
  constexpr std::size_t kAnswers = 8, kValues = 1 << 20;
  const auto faults = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_minflt;
  };
  const long before = faults();
  std::vector<std::vector<double>> answers;
  for (std::size_t k = 0; k < kAnswers; ++k) answers.emplace_back(kValues, 1.0);
  return faults() - before + (answers.back().back() > 0 ? 0 : 1);
}

TEST(KeepFreedMemory, HasTheNextBatchFindItsPages) {
  if (!kOfGlibc) GTEST_SKIP() << "memory is another allocator's here";
  keep_freed_memory();
  pages_of_a_batch();
  EXPECT_LT(pages_of_a_batch(), 16);  // 64 MB are 32 pages of the largest kind, mostly 16,384
}

TEST(KeepFreedMemory, IsGivenBackWhenAsked) {
  if (!kOfGlibc) GTEST_SKIP() << "memory is another allocator's here";
  keep_freed_memory();
  pages_of_a_batch();
  release_freed_memory();
  EXPECT_GE(pages_of_a_batch(), 32);  // of the largest kind
}

}  // namespace
}  // namespace geotherm
