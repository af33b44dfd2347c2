// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace clew::map {

/// Those who wait with a key, in buckets of 64 keys: those of a lower bucket come first, and within
/// a bucket who came last. Keys beyond the last bucket wait in a heap, the least first. It
/// allocates only when more wait than ever before.
class BucketQueue {
 public:
  struct Waiting {
    std::uint32_t key = 0;
    std::uint32_t who = 0;
  };

  void clear() {
    places_.clear();
    beyond_.clear();
    buckets_.assign(kBuckets, kNone);
    unused_ = kNone;
    first_ = kBuckets;
    count_ = 0;
  }

  void push(const Waiting& waiting) {
    const std::size_t bucket = bucket_of(waiting.key);
    if (bucket >= kBuckets) return push_beyond(waiting);
    std::uint32_t place = unused_;
    if (place == kNone) {
      place = static_cast<std::uint32_t>(places_.size());
      places_.emplace_back();
    } else {
      unused_ = places_[place].next;
    }
    places_[place] = {waiting, buckets_[bucket]};
    buckets_[bucket] = place;
    first_ = std::min(first_, bucket);
    ++count_;
  }

  /// Takes out who comes first, if not of a later bucket than `key`.
  std::optional<Waiting> take_up_to(std::uint32_t key) {
    if (count_ == 0) return take_beyond(key);
    while (buckets_[first_] == kNone) ++first_;
    if (first_ > bucket_of(key)) return std::nullopt;
    const std::uint32_t place = buckets_[first_];
    buckets_[first_] = places_[place].next;
    places_[place].next = unused_;
    unused_ = place;
    --count_;
    return places_[place].waiting;
  }

  /// How many have waited at once: what it holds memory for.
  std::size_t places() const { return places_.size() + beyond_.size(); }

  /// Whether one key is of a later bucket than another.
  static bool is_later(std::uint32_t key, std::uint32_t other) {
    return bucket_of(key) > bucket_of(other);
  }
  /// Whether they are of the same bucket.
  static bool is_same(std::uint32_t key, std::uint32_t other) {
    return bucket_of(key) == bucket_of(other);
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t kBuckets = 1 << 16;

  struct Place {
    Waiting waiting;
    std::uint32_t next = kNone;  // in the same bucket, or among the unused
  };

  static std::size_t bucket_of(std::uint32_t key) { return key / 64; }
  static bool has_greater_key(const Waiting& a, const Waiting& b) { return a.key > b.key; }

  [[gnu::noinline]] void push_beyond(const Waiting& waiting) {
    beyond_.push_back(waiting);
    std::push_heap(beyond_.begin(), beyond_.end(), has_greater_key);
  }

  std::optional<Waiting> take_beyond(std::uint32_t key) {
    if (beyond_.empty() || is_later(beyond_.front().key, key)) return std::nullopt;
    std::pop_heap(beyond_.begin(), beyond_.end(), has_greater_key);
    const Waiting least = beyond_.back();
    beyond_.pop_back();
    return least;
  }

  std::vector<Place> places_;
  std::vector<Waiting> beyond_;         // a heap
  std::vector<std::uint32_t> buckets_;  // the first place of each
  std::uint32_t unused_ = kNone;
  std::size_t first_ = kBuckets;  // all before are empty
  std::size_t count_ = 0;
};

}  // namespace clew::map
