// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace geotherm {

/// Bytes that this process can still take: the least of what the machine has available, what each
/// control group around the process (versions 1 and 2, /sys/fs/cgroup) leaves of its limit, and
/// what RLIMIT_AS leaves. File caches that can be dropped count as free. Empty where the system
/// says none of these. `root`: where /proc and /sys are looked for. Cost: some small files.
std::optional<std::int64_t> free_memory(const std::filesystem::path& root = "/");

/// Bytes of address space that RLIMIT_AS leaves; empty where it sets no limit.
std::optional<std::int64_t> free_address_space(const std::filesystem::path& root = "/");

/// From now on this process keeps memory that it frees for what it asks for next: blocks of up to
/// 32 MB, as long as no more than half a GB is free at the end of the heap (of each arena, 64 MB).
/// Otherwise glibc hands the answers of every batch back to the system and has them cleared page by
/// page in the next, which at 4 million faces takes up to a quarter of a batch. For programs that
/// ask again and again, best after their set-ups, whose memory would be kept, too; the library
/// itself leaves its caller's heap alone. Does nothing without glibc, or where addresses have 32
/// bits.
void keep_freed_memory();

/// Gives back what is free in whole pages, kept or not. Cost: a pass over the free blocks.
void release_freed_memory();

/// Wishes that the system keep what is in here of large pages (2 MiB) as such, before it is first
/// touched: what is read here and there would wait for the tables of small ones.
void prefer_large_pages(void* data, std::size_t bytes);

/// Memory that large buffers gave back, kept for the next ones of about their size: the system
/// clears every page that it hands out, which takes longer than to fill it. For several threads.
class BufferPool {
 public:
  struct Block {
    std::byte* data = nullptr;
    std::size_t bytes = 0;
  };
  BufferPool() = default;
  BufferPool(const BufferPool&) = delete;
  BufferPool& operator=(const BufferPool&) = delete;
  ~BufferPool();
  /// The smallest block that was kept and holds `bytes`; no data where there is none.
  Block take(std::size_t bytes);
  /// Keeps a block of std::aligned_alloc() for the next; of more than a few the oldest is freed.
  void give(Block block);

 private:
  std::mutex mutex_;
  std::vector<Block> kept_;  ///< the oldest first
};

/// Uninitialised memory for what is read from end to end: aligned to a cache line, and in large
/// pages where the system has them, so that reading does not wait for the tables of pages.
class LargeBuffer {
 public:
  LargeBuffer() = default;
  /// `pool`: where it is taken from, with some room for the next to be larger, and given back to;
  /// null for memory of its own. Throws std::bad_alloc.
  explicit LargeBuffer(std::size_t bytes, std::shared_ptr<BufferPool> pool = nullptr);
  ~LargeBuffer();
  LargeBuffer(LargeBuffer&& other) noexcept
      : block_(std::exchange(other.block_, {})),
        bytes_(std::exchange(other.bytes_, 0)),
        pool_(std::move(other.pool_)) {}
  LargeBuffer& operator=(LargeBuffer&& other) noexcept {
    std::swap(block_, other.block_);
    std::swap(bytes_, other.bytes_);
    std::swap(pool_, other.pool_);
    return *this;
  }

  std::byte* data() { return block_.data; }
  const std::byte* data() const { return block_.data; }
  std::size_t size() const { return bytes_; }

 private:
  BufferPool::Block block_;
  std::size_t bytes_ = 0;
  std::shared_ptr<BufferPool> pool_;
};

/// Leaves numbers that nobody gave a value unwritten. Keeps what is long in large pages.
template <class T>
struct RawAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = RawAllocator<U>;
  };

  T* allocate(std::size_t count) {
    T* const data = std::allocator<T>::allocate(count);
    if (count * sizeof(T) >= kLong) prefer_large_pages(data, count * sizeof(T));
    return data;
  }

  template <class U>
  void construct(U* at) noexcept {
    static_assert(std::is_trivially_destructible_v<U>);
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    std::construct_at(at, std::forward<Arguments>(arguments)...);
  }

 private:
  static constexpr std::size_t kLong = 4UL << 20;  ///< bytes: two large pages
};

/// A vector for results that several threads fill: resize() touches none of the memory, so that the
/// system hands out its pages to all of them, and nothing is written twice.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace geotherm
