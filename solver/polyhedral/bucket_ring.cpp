// SPDX-License-Identifier: MIT
#include "solver/polyhedral/bucket_ring.h"

#include <algorithm>
#include <limits>

namespace geotherm {
namespace {

/// Bucket numbers are capped at this, since offsets can be of any size.
constexpr double kLast = 1e18;
constexpr std::int64_t kMinBuckets = 64;

/// What lies this far behind the front, in longest sides of the faces that were crossed, has its
/// final distance. Values lag behind the front by up to a side where a wave has to wait for the far
/// end of an edge, and by as much again where that was known too large at first.
constexpr double kSettled = 4;

}  // namespace

BucketRing::BucketRing(double width, double span) : per_length_(1 / width) {
  std::int64_t count = kMinBuckets;
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
  pass.floor = -kUnreached;
  pass.longest = 0;
  pass.place = 0;
  pass.context = this;
  pass.grow = [](void* ring, WaveBucket& bucket) { static_cast<BucketRing*>(ring)->grow(bucket); };
}

void BucketRing::add_seeds(const std::vector<std::pair<double, Index>>& seeds) {
  for (const auto& [key, edge] : seeds) {
    outside_.emplace_back(static_cast<std::int64_t>(std::min(key * per_length_, kLast)), edge);
  }
  std::ranges::stable_sort(outside_, {}, &std::pair<std::int64_t, Index>::first);
}

bool BucketRing::advance(WavePass& pass) {
  const double front = static_cast<double>(pass.current) / per_length_;
  pass.floor = std::max(pass.floor, front - kSettled * pass.longest);
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

bool BucketRing::advance_within(WavePass& pass, double from, double until) {
  pass.floor = std::max(pass.floor, from - kSettled * pass.longest - (until - from));
  constexpr double kAbove = 1 + 1e-9;  // what next() calls below `until` must not be left
  const std::int64_t end = bucket_of(until * kAbove) + 1;
  for (; pass.current < end; ++pass.current) {
    let_in(pass);
    if (buckets_[static_cast<std::size_t>(pass.current & pass.bucket_mask)].size > 0) return true;
    if (pass.waiting == 0 && let_in_ == outside_.size()) return false;
  }
  return false;
}

void BucketRing::go_back(WavePass& pass, double from) const {
  constexpr double kBelow = 1 - 1e-9;  // not past what next() said
  pass.current = bucket_of(from * kBelow);
}

void BucketRing::add(WavePass& pass, double key, Index edge) {
  const std::int64_t number =
      std::clamp(bucket_of(key), pass.current, pass.current + pass.bucket_mask);
  WaveBucket& bucket = buckets_[static_cast<std::size_t>(number & pass.bucket_mask)];
  if (bucket.size == bucket.capacity) grow(bucket);
  bucket.edges[bucket.size++] = edge;
  pass.queued[edge] = 1;
  ++pass.waiting;
}

double BucketRing::next(const WavePass& pass) const {
  std::int64_t number = std::numeric_limits<std::int64_t>::max();
  if (let_in_ < outside_.size()) number = outside_[let_in_].first;
  if (pass.waiting > 0) {
    std::int64_t first = pass.current;
    while (buckets_[static_cast<std::size_t>(first & pass.bucket_mask)].size == 0) ++first;
    number = std::min(number, first);
  } else if (let_in_ == outside_.size()) {
    return kUnreached;
  }
  return static_cast<double>(number) / per_length_;
}

std::int64_t BucketRing::bucket_of(double key) const {
  return static_cast<std::int64_t>(std::clamp(key * per_length_, 0.0, kLast));
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

}  // namespace geotherm
