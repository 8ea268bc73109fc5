// SPDX-License-Identifier: MIT
#include "solver/core/memory.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <vector>

namespace geotherm::test {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMebibyte = 1024 * 1024;

/// A folder with the files of a made-up system.
class FreeMemory : public testing::Test {
 protected:
  ~FreeMemory() override { fs::remove_all(root); }
  void add(const fs::path& file, const std::string& text) const {
    fs::create_directories((root / file).parent_path());
    std::ofstream(root / file) << text;
  }
  void add_machine(std::int64_t available) const {
    add("proc/meminfo", "MemTotal:  9999999 kB\nMemFree: 12 kB\nMemAvailable:  " +
                            std::to_string(available / 1024) + " kB\n");
  }

  fs::path root =
      fs::temp_directory_path() / ("free_memory_" + std::to_string(::getpid()) + "_" +
                                   testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(FreeMemory, IsUnknownWhereTheSystemSaysNothing) { EXPECT_FALSE(free_memory(root)); }

TEST_F(FreeMemory, IsWhatTheMachineHasAvailable) {
  add_machine(500 * kMebibyte);
  EXPECT_EQ(free_memory(root), 500 * kMebibyte);
}

TEST_F(FreeMemory, IsWhatTheTightestGroupLeaves) {
  add_machine(5000 * kMebibyte);
  add("proc/self/cgroup", "0::/outer/inner\n");
  add("sys/fs/cgroup/outer/memory.max", std::to_string(300 * kMebibyte));
  add("sys/fs/cgroup/outer/memory.current", std::to_string(250 * kMebibyte));
  add("sys/fs/cgroup/outer/memory.stat",
      "anon 7\ninactive_file " + std::to_string(10 * kMebibyte) + "\nslab 3\n");
  add("sys/fs/cgroup/outer/inner/memory.max", "max");
  add("sys/fs/cgroup/outer/inner/memory.current", "1");
  EXPECT_EQ(free_memory(root), 60 * kMebibyte);
}

TEST_F(FreeMemory, KnowsGroupsOfTheFirstVersionWhereTheyAreMounted) {
  add_machine(5000 * kMebibyte);
  add("proc/self/cgroup", "7:cpu,cpuacct:/a\n4:memory:/not/to/be/seen/here\n");
  add("sys/fs/cgroup/memory/memory.limit_in_bytes", std::to_string(100 * kMebibyte));
  add("sys/fs/cgroup/memory/memory.usage_in_bytes", std::to_string(200 * kMebibyte));
  EXPECT_EQ(free_memory(root), 0) << "never negative";
}

TEST(BufferPool, GivesBackWhatFits) {
  const auto pool = std::make_shared<BufferPool>();
  const std::byte* small = nullptr;
  const std::byte* large = nullptr;
  {
    const LargeBuffer a(1000, pool), b(100'000, pool);
    small = a.data();
    large = b.data();
  }
  const LargeBuffer first(900, pool), second(101'000, pool), third(50, pool);
  EXPECT_EQ(first.data(), small);   // the smallest that holds it
  EXPECT_EQ(second.data(), large);  // which was made with room for a larger one
  EXPECT_NE(third.data(), small);
  EXPECT_EQ(third.size(), 50U);
}

TEST(BufferPool, KeepsAFewBuffersAlone) {
  const auto pool = std::make_shared<BufferPool>();
  std::vector<LargeBuffer> buffers;
  for (int k = 0; k < 10; ++k) buffers.emplace_back(1000, pool);
  buffers.clear();
  int kept = 0;
  for (BufferPool::Block block = pool->take(1000); block.data != nullptr;
       block = pool->take(1000)) {
    std::free(block.data);
    ++kept;
  }
  EXPECT_EQ(kept, 4);
}

}  // namespace
}  // namespace geotherm::test
