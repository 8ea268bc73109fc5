// SPDX-License-Identifier: MIT
#include "solver/wave/bucket_ring.h"

#include <algorithm>

namespace geotherm {
namespace {

/// Distances above this many buckets are all in one; offsets can be that large.
constexpr double kLast = 1e18;
constexpr std::int64_t kMin = 64;

}  // namespace

BucketRing::BucketRing(double width, double span) : per_length_(1 / width) {
  std::int64_t count = kMin;
  while (count < kMax && static_cast<double>(count) * width < span) count *= 2;
  buckets_.resize(static_cast<std::size_t>(count));
  storage_.resize(buckets_.size());
}

void BucketRing::begin(WavePass& pass) {
  for (std::size_t i = 0; i < buckets_.size(); ++i) {
    buckets_[i] = {storage_[i].data(), 0, static_cast<Index>(storage_[i].size())};
  }
  outside_.clear();
  let_in_ = 0;
  pass.buckets = buckets_.data();
  pass.bucket_mask = static_cast<std::int64_t>(buckets_.size()) - 1;
  pass.current = -1;
  pass.waiting = 0;
  pass.per_length = per_length_;
  pass.place = 0;
  pass.context = this;
  pass.grow = [](void* ring, WaveBucket& bucket) { static_cast<BucketRing*>(ring)->grow(bucket); };
}

void BucketRing::add_seeds(const std::vector<std::pair<double, Index>>& seeds) {
  for (const auto& [key, edge] : seeds) {
    outside_.emplace_back(static_cast<std::int64_t>(std::min(key * per_length_, kLast)), edge);
  }
  std::ranges::sort(outside_);
}

bool BucketRing::advance(WavePass& pass) {
  ++pass.current;
  if (pass.waiting == 0) {
    if (let_in_ == outside_.size()) return false;
    pass.current = std::max(pass.current, outside_[let_in_].first);
  }
  let_in(pass);
  while (buckets_[static_cast<std::size_t>(pass.current & pass.bucket_mask)].size == 0 &&
         pass.waiting > 0) {
    ++pass.current;
    let_in(pass);
  }
  return true;
}

void BucketRing::let_in(WavePass& pass) {
  WaveBucket& bucket = buckets_[static_cast<std::size_t>(pass.current & pass.bucket_mask)];
  for (; let_in_ < outside_.size() && outside_[let_in_].first <= pass.current; ++let_in_) {
    const Index edge = outside_[let_in_].second;
    if (pass.queued[edge] != 0) continue;
    if (bucket.size == bucket.capacity) grow(bucket);
    bucket.edges[bucket.size++] = edge;
    pass.queued[edge] = 1;
    ++pass.waiting;
  }
}

void BucketRing::grow(WaveBucket& bucket) {
  auto& edges = storage_[static_cast<std::size_t>(&bucket - buckets_.data())];
  edges.resize(std::max<std::size_t>(2 * edges.size(), 16));
  bucket.edges = edges.data();
  bucket.capacity = static_cast<Index>(edges.size());
}

std::size_t BucketRing::bytes() const {
  std::size_t sum = buckets_.size() * (sizeof(WaveBucket) + sizeof(std::vector<Index>));
  for (const auto& edges : storage_) sum += edges.capacity() * sizeof(Index);
  return sum;
}

}  // namespace geotherm
