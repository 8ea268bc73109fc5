// SPDX-License-Identifier: MIT
#include "solver/polyhedral/window_queue.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace geotherm {

WindowQueue::WindowQueue(double width) : inverse_width_(1 / width), buckets_(kBuckets) {}

Window* WindowQueue::push(const Window& window, double key, bool fine) {
  assert(std::isfinite(key));
  const double place = (key - base_) * inverse_width_;
  ++pushed_;
  ++size_;
  if (place < static_cast<double>(kBuckets)) {
    const auto bucket = place > 0 ? static_cast<std::size_t>(place) : std::size_t{0};
    return add(std::max(bucket, present_), window, key, fine);
  }
  far_.push_back({key, pushed_, window, fine});
  std::ranges::push_heap(far_, Later());
  return nullptr;
}

const Window* WindowQueue::pop() {
  if (size_ == 0) return nullptr;
  if (near_ == 0) refill();
  const auto is_empty = [](const Bucket& each) { return !each.first && each.fine.empty(); };
  if (is_empty(buckets_[present_])) {
    while (is_empty(buckets_[present_])) ++present_;
    std::ranges::make_heap(buckets_[present_].fine, Later());
  }
  Bucket& bucket = buckets_[present_];
  --near_;
  --size_;
  return bucket.first ? pop_coarse(bucket) : pop_fine(bucket);
}

const Window* WindowQueue::pop_coarse(Bucket& bucket) {
  Chunk* chunk = bucket.first;
  const Window* window = &chunk->windows[static_cast<std::size_t>(chunk->begin++)];
  if (chunk->begin == chunk->end) {
    bucket.first = chunk->next;
    if (!bucket.first) bucket.last = nullptr;
    chunk->next = free_;
    free_ = chunk;
  }
  return window;
}

const Window* WindowQueue::pop_fine(Bucket& bucket) {
  std::ranges::pop_heap(bucket.fine, Later());
  Window* const window = bucket.fine.back().window;
  bucket.fine.pop_back();
  free_places_.push_back(window);
  return window;
}

Window* WindowQueue::add(std::size_t bucket, const Window& window, double key, bool fine) {
  Bucket& list = buckets_[bucket];
  ++near_;
  if (!fine) return append(list, window);
  Window* const place = take_place();
  *place = window;
  list.fine.push_back({key, place});
  if (bucket == present_) std::ranges::push_heap(list.fine, Later());
  return place;
}

Window* WindowQueue::append(Bucket& list, const Window& window) {
  if (!list.last || list.last->end == kChunkSize) {
    Chunk* chunk = take_chunk();
    (list.last ? list.last->next : list.first) = chunk;
    list.last = chunk;
  }
  Window& place = list.last->windows[static_cast<std::size_t>(list.last->end++)];
  place = window;
  return &place;
}

void WindowQueue::refill() {
  base_ = far_.front().key;
  present_ = 0;
  double place = 0;
  do {  // the first always, or pop() would find no bucket
    const Far& next = far_.front();
    add(static_cast<std::size_t>(place), next.window, next.key, next.fine);
    std::ranges::pop_heap(far_, Later());
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

Window* WindowQueue::take_place() {
  if (free_places_.empty()) {
    places_.push_back(std::make_unique_for_overwrite<Window[]>(kChunkSize));
    free_places_.reserve(places_.size() * kChunkSize);  // giving one back never fails
    for (int i = 0; i < kChunkSize; ++i) free_places_.push_back(&places_.back()[i]);
  }
  Window* const place = free_places_.back();
  free_places_.pop_back();
  return place;
}

std::size_t WindowQueue::bytes() const {
  return chunks_.size() * sizeof(Chunk) + far_.capacity() * sizeof(Far) +
         places_.size() * kChunkSize * (sizeof(Window) + sizeof(Fine));
}

}  // namespace geotherm
