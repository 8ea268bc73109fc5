// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "solver/polyhedral/window.h"

namespace geotherm {

/// A queue of windows in the order of their keys, up to the width of a bucket. An array of buckets
/// holds the near windows, a heap the far ones. Within a bucket coarse windows leave first in,
/// first out; fine ones, in faces far smaller than the bucket is wide, follow in the order of their
/// keys: in order of arrival they would be followed along paths that are not the shortest, and
/// again each time these get shorter. Cost: O(1) for a near coarse window, O(log m) for one of m
/// fine ones in a bucket, O(log n) for a far one. Source: Xu, Wang, Wei, Wang, He, Liu 2015
/// (buckets).
class WindowQueue {
 public:
  /// `width` > 0, in units of the keys.
  explicit WindowQueue(double width);

  /// A window with a key below the present bucket goes into that bucket. Precondition: `key` is
  /// finite. Returns the address of the window until it is popped; nullptr where it may be moved
  /// before. Throws std::bad_alloc.
  Window* push(const Window& window, double key, bool fine);

  /// The next window, valid until something is pushed; nullptr when none is left.
  const Window* pop();

  /// No window that is left, and none that is pushed with a key of its own or more than that, has a
  /// key below this, but for rounding.
  double least_key() const { return base_ + static_cast<double>(present_) / inverse_width_; }

  std::size_t size() const { return size_; }
  std::size_t bytes() const;

 private:
  static constexpr std::size_t kBuckets = 1 << 12;
  static constexpr int kChunkSize = 128;
  struct Chunk {
    std::array<Window, kChunkSize> windows;
    int begin, end;
    Chunk* next;
  };
  struct Fine {
    double key;
    Window* window;
  };
  struct Bucket {
    Chunk* first = nullptr;
    Chunk* last = nullptr;
    std::vector<Fine> fine;  ///< in the present bucket a heap, smallest key first
  };
  struct Far {
    double key;
    std::size_t number;  ///< equal keys: first in, first out
    Window window;
    bool fine;
  };
  /// Makes heaps whose front has the smallest key.
  struct Later {
    bool operator()(const Fine& a, const Fine& b) const { return a.key > b.key; }
    bool operator()(const Far& a, const Far& b) const {
      return a.key != b.key ? a.key > b.key : a.number > b.number;
    }
  };

  Window* add(std::size_t bucket, const Window& window, double key, bool fine);
  Window* append(Bucket& list, const Window& window);
  const Window* pop_coarse(Bucket& bucket);
  const Window* pop_fine(Bucket& bucket);
  void refill();
  Chunk* take_chunk();
  Window* take_place();

  double inverse_width_;
  double base_ = 0;          ///< key where bucket 0 of this turn begins
  std::size_t present_ = 0;  ///< of the buckets
  std::size_t near_ = 0;     ///< windows in buckets
  std::size_t size_ = 0, pushed_ = 0;
  std::vector<Bucket> buckets_;
  std::vector<Far> far_;  ///< a heap, smallest key first
  std::vector<std::unique_ptr<Chunk>> chunks_;
  Chunk* free_ = nullptr;
  std::vector<std::unique_ptr<Window[]>> places_;  ///< of fine windows, kChunkSize in each
  std::vector<Window*> free_places_;
};

}  // namespace geotherm
