// SPDX-License-Identifier: MIT
#include "solver/core/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <new>
#include <string>

#ifdef __GLIBC__
#include <malloc.h>
#endif
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace geotherm {
namespace {

using Path = std::filesystem::path;
using Bytes = std::optional<std::int64_t>;

/// The number that a file holds; none where it is not there or says "max".
Bytes number_of(const Path& file) {
  std::int64_t value = 0;
  if (std::ifstream in(file); in >> value) return value;
  return {};
}

/// The number after a word that begins a line.
Bytes number_after(const Path& file, const std::string& word) {
  std::ifstream in(file);
  std::string first;
  std::int64_t value = 0;
  while (in >> first) {
    if (first == word && in >> value) return value;
    in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return {};
}

void lower(Bytes& least, Bytes value) {
  if (value && (!least || *value < *least)) least = std::max<std::int64_t>(*value, 0);
}

/// The names of the files of one version of control groups.
struct GroupFiles {
  const char* limit;
  const char* used;
  const char* cache;  ///< in memory.stat: file pages that nobody has used of late
};
constexpr GroupFiles kVersion1 = {"memory.limit_in_bytes", "memory.usage_in_bytes",
                                  "total_inactive_file"};
constexpr GroupFiles kVersion2 = {"memory.max", "memory.current", "inactive_file"};

/// What a group and those around it leave, up to where they are mounted.
Bytes group_leaves(const Path& mount, const Path& group, const GroupFiles& files) {
  Bytes least;
  for (Path at = group.relative_path();; at = at.parent_path()) {
    const Path folder = mount / at;
    const Bytes limit = number_of(folder / files.limit), used = number_of(folder / files.used);
    if (limit && used) {
      const Bytes cache = number_after(folder / "memory.stat", files.cache);
      lower(least, *limit - *used + cache.value_or(0));
    }
    if (at.empty()) return least;
  }
}

/// Lines are ID:CONTROLLERS:PATH; version 2 names no controllers.
Bytes groups_leave(const Path& root) {
  Bytes least;
  const Path mount = root / "sys/fs/cgroup";
  std::ifstream in(root / "proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const Path group = line.substr(second + 1);
    if (controllers == ",,") lower(least, group_leaves(mount, group, kVersion2));
    if (controllers.find(",memory,") != std::string::npos) {
      lower(least, group_leaves(mount / "memory", group, kVersion1));
    }
  }
  return least;
}

}  // namespace

std::optional<std::int64_t> free_address_space(const Path& root) {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
  const Bytes pages = number_of(root / "proc/self/statm");
  if (!pages) return {};
  return static_cast<std::int64_t>(limit.rlim_cur) - *pages * ::sysconf(_SC_PAGESIZE);
}

std::optional<std::int64_t> free_memory(const std::filesystem::path& root) {
  constexpr std::int64_t kUnit = 1024;  // of /proc/meminfo
  Bytes least;
  if (const Bytes available = number_after(root / "proc/meminfo", "MemAvailable:")) {
    lower(least, *available * kUnit);
  }
  lower(least, groups_leave(root));
  lower(least, free_address_space(root));
  return least;
}

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kLargestBlock = 32 << 20;  // the most that glibc takes
  constexpr int kMaxKept = 512 << 20;
  if (mallopt(M_MMAP_THRESHOLD, kLargestBlock) == 0) return;
  mallopt(M_TRIM_THRESHOLD, kMaxKept);
#endif
}

void release_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

namespace {

constexpr std::size_t kLine = 64;
constexpr std::size_t kLargePage = 2UL << 20;

}  // namespace

void prefer_large_pages(void* data, std::size_t bytes) {
#ifdef __linux__
  const auto begin = reinterpret_cast<std::uintptr_t>(data);
  const std::uintptr_t first = (begin + kLargePage - 1) / kLargePage * kLargePage;
  const std::uintptr_t end = (begin + bytes) / kLargePage * kLargePage;
  if (first < end) madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
#else
  static_cast<void>(data), static_cast<void>(bytes);
#endif
}

BufferPool::~BufferPool() {
  for (const Block& block : kept_) std::free(block.data);
}

BufferPool::Block BufferPool::take(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  auto best = kept_.end();
  for (auto at = kept_.begin(); at != kept_.end(); ++at) {
    if (at->bytes >= bytes && (best == kept_.end() || at->bytes < best->bytes)) best = at;
  }
  if (best == kept_.end()) return {};
  const Block block = *best;
  kept_.erase(best);
  return block;
}

void BufferPool::give(Block block) {
  constexpr std::size_t kMaxKept = 4;  // the factors of one method
  const std::lock_guard lock(mutex_);
  if (kept_.size() == kMaxKept) {
    std::free(kept_.front().data);
    kept_.erase(kept_.begin());
  }
  try {
    kept_.push_back(block);
  } catch (const std::bad_alloc&) {  // destructors call this
    std::free(block.data);
  }
}

LargeBuffer::LargeBuffer(std::size_t bytes, std::shared_ptr<BufferPool> pool)
    : bytes_(bytes), pool_(std::move(pool)) {
  constexpr std::size_t kRoom = 16;  // a share of this for the next
  if (pool_) block_ = pool_->take(bytes);
  if (block_.data != nullptr) return;
  const std::size_t wanted = pool_ ? bytes + bytes / kRoom : bytes;
  const std::size_t alignment = wanted >= 2 * kLargePage ? kLargePage : kLine;
  block_.bytes = (wanted + alignment) / alignment * alignment;
  block_.data = static_cast<std::byte*>(std::aligned_alloc(alignment, block_.bytes));
  if (block_.data == nullptr) throw std::bad_alloc();
  prefer_large_pages(block_.data, block_.bytes);
}

LargeBuffer::~LargeBuffer() {
  if (pool_ && block_.data != nullptr) {
    pool_->give(block_);
  } else {
    std::free(block_.data);
  }
}

}  // namespace geotherm
