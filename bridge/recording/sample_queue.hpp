// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "wire/sample.hpp"

namespace clew::bridge {

/// Samples of one topic that wait for those of the others, copied into one buffer that is reused: a
/// sample costs no allocation once the buffer has grown.
class SampleQueue {
 public:
  bool empty() const { return head_ == entries_.size(); }
  std::size_t size() const { return entries_.size() - head_; }

  void push(const SampleView& sample) {
    entries_.push_back(
        {sample.topic, sample.tick, sample.sequence, bytes_.size(), sample.cdr.size()});
    bytes_.append(sample.cdr);
  }

  /// The oldest sample of a queue that is not empty; valid until the next push or pop.
  SampleView front() const {
    const Entry& entry = entries_[head_];
    const std::string_view bytes = bytes_;
    return {entry.topic, entry.tick, entry.sequence, bytes.substr(entry.offset, entry.bytes)};
  }

  void pop() {
    ++head_;
    if (2 * head_ < entries_.size()) return;
    // More than half is gone: the rest moves to the front, so that no sample is moved often.
    const std::size_t gone_bytes = empty() ? bytes_.size() : entries_[head_].offset;
    bytes_.erase(0, gone_bytes);
    entries_.erase(entries_.begin(), entries_.begin() + static_cast<std::ptrdiff_t>(head_));
    for (Entry& entry : entries_) entry.offset -= gone_bytes;
    head_ = 0;
  }

 private:
  struct Entry {
    domain::Topic topic = domain::Topic::kCommand;
    std::uint64_t tick = 0;
    std::uint64_t sequence = 0;
    std::size_t offset = 0;
    std::size_t bytes = 0;
  };
  std::vector<Entry> entries_;
  std::string bytes_;
  std::size_t head_ = 0;  ///< entries before it are gone
};

}  // namespace clew::bridge
