// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "core/result.hpp"
#include "recording/mcap_index.hpp"
#include "recording/segment_reader.hpp"

namespace clew::bridge::mcap {

enum class Order {
  kFile,    ///< as the messages stand in the file
  kLogTime  ///< by log time, and as they stand in the file where that is equal
};

struct MessageFilter {
  std::optional<std::set<std::uint16_t>> channels;                    ///< nothing: all
  std::uint64_t first_ns = 0;                                         ///< least log time
  std::uint64_t last_ns = std::numeric_limits<std::uint64_t>::max();  ///< greatest log time

  bool passes(std::uint64_t log_time_ns, std::uint16_t channel_id) const {
    return log_time_ns >= first_ns && log_time_ns <= last_ns &&
           (!channels || channels->count(channel_id) != 0);
  }
};

/// Reads messages one after the other, holding only the chunks that are needed at the moment: one,
/// or those whose times overlap.
class MessageStream {
 public:
  MessageStream(std::shared_ptr<const InputFile> file, std::shared_ptr<const FileIndex> index,
                const ReadLimits& limits, Order order, MessageFilter filter);

  /// The next message, its data valid until the next call; nothing at the end. An error (a changed
  /// byte, a failing disk, chunks whose times overlap too much) ends the stream.
  core::Result<std::optional<Message>> next();

 private:
  struct OpenSegment {
    std::size_t ordinal = 0;  ///< among the file's segments
    LoadedSegment content;
    std::vector<LoadedSegment::Entry> entries;  ///< that pass the filter, in the order wanted
    std::size_t position = 0;
  };

  bool comes_later(const OpenSegment& a, const OpenSegment& b) const;
  bool must_open_another() const;
  core::Result<void> open_another();
  void enter(std::unique_ptr<OpenSegment> segment);
  void return_given();
  core::Error end_with(const core::Error& error);

  std::shared_ptr<const InputFile> file_;
  std::shared_ptr<const FileIndex> index_;
  ReadLimits limits_;
  Order order_;
  MessageFilter filter_;
  Declarations declarations_;
  std::vector<std::size_t> waiting_;                ///< ordinals of segments, the next one last
  std::vector<std::unique_ptr<OpenSegment>> open_;  ///< a heap, the next message's on top
  std::unique_ptr<OpenSegment> given_;              ///< whose message the caller holds
  std::unique_ptr<OpenSegment> spare_;              ///< kept for its memory
  std::uint64_t open_bytes_ = 0;
};

}  // namespace clew::bridge::mcap
