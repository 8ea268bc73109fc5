// SPDX-License-Identifier: MIT
#include "solver/exact/window_queue.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace geotherm {

WindowQueue::WindowQueue(double width) : inverse_width_(1 / width), buckets_(kBuckets) {}

Window* WindowQueue::push(const Window& window, double key) {
  assert(std::isfinite(key));
  const double place = (key - base_) * inverse_width_;
  ++pushed_;
  ++size_;
  if (place < static_cast<double>(kBuckets)) {
    const auto bucket = place > 0 ? static_cast<std::size_t>(place) : std::size_t{0};
    return append(std::max(bucket, present_), window);
  }
  far_.push_back({key, pushed_, window});
  std::ranges::push_heap(far_, later);
  return nullptr;
}

const Window* WindowQueue::pop() {
  if (size_ == 0) return nullptr;
  if (near_ == 0) refill();
  while (!buckets_[present_].first) ++present_;
  Bucket& bucket = buckets_[present_];
  Chunk* chunk = bucket.first;
  const Window* window = &chunk->windows[static_cast<std::size_t>(chunk->begin++)];
  if (chunk->begin == chunk->end) {
    bucket.first = chunk->next;
    if (!bucket.first) bucket.last = nullptr;
    chunk->next = free_;
    free_ = chunk;
  }
  --near_;
  --size_;
  return window;
}

Window* WindowQueue::append(std::size_t bucket, const Window& window) {
  Bucket& list = buckets_[bucket];
  if (!list.last || list.last->end == kChunkSize) {
    Chunk* chunk = take_chunk();
    (list.last ? list.last->next : list.first) = chunk;
    list.last = chunk;
  }
  Window& place = list.last->windows[static_cast<std::size_t>(list.last->end++)];
  place = window;
  ++near_;
  return &place;
}

void WindowQueue::refill() {
  base_ = far_.front().key;
  present_ = 0;
  double place = 0;
  do {  // the first always, or pop() would find no bucket
    append(static_cast<std::size_t>(place), far_.front().window);
    std::ranges::pop_heap(far_, later);
    far_.pop_back();
    if (!far_.empty()) place = (far_.front().key - base_) * inverse_width_;
  } while (!far_.empty() && place < static_cast<double>(kBuckets));
}

WindowQueue::Chunk* WindowQueue::take_chunk() {
  if (!free_) {
    chunks_.push_back(std::make_unique_for_overwrite<Chunk>());
    free_ = chunks_.back().get();
    free_->next = nullptr;
  }
  Chunk* chunk = free_;
  free_ = chunk->next;
  chunk->begin = chunk->end = 0;
  chunk->next = nullptr;
  return chunk;
}

std::size_t WindowQueue::bytes() const {
  return chunks_.size() * sizeof(Chunk) + far_.capacity() * sizeof(Far);
}

}  // namespace geotherm
