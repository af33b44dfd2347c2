// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/result.hpp"
#include "recording/mcap_index.hpp"

namespace clew::bridge::mcap {

/// The span of log times of some messages.
struct TimeSpan {
  bool any = false;
  std::uint64_t start_ns = 0;  ///< 0 without messages
  std::uint64_t end_ns = 0;    ///< 0 without messages

  void add(std::uint64_t time_ns);
};

/// Takes up one record of a segment: declares its schema or channel, or adds its message's time.
/// Refused: a malformed record, a declaration that contradicts an earlier one, a message of a
/// channel or schema that is not declared. Other records are passed over.
core::Result<void> enter_record(const RecordView& record, Declarations& declarations,
                                TimeSpan& times);

/// The messages of one segment in memory, checked as a whole: CRC, every record complete, every
/// channel declared, every log time within the chunk's.
class LoadedSegment {
 public:
  struct Entry {
    std::uint64_t log_time_ns = 0;
    std::size_t offset = 0;  ///< of the message's record
    std::uint16_t channel_id = 0;
  };

  /// Replaces what was loaded. `declarations` grows by what the segment declares. On an error the
  /// content is unspecified.
  core::Result<void> load(const InputFile& file, const Segment& segment, const ReadLimits& limits,
                          Declarations& declarations);

  /// Unpacks and checks the chunk in `content`, the content of a Chunk record, as load() does.
  core::Result<void> unpack(std::string_view content, const ReadLimits& limits,
                            Declarations& declarations);

  /// In the order of the file.
  const std::vector<Entry>& entries() const { return entries_; }
  Message message(const Entry& entry) const;
  const TimeSpan& times() const { return times_; }
  std::uint64_t memory_bytes() const;

 private:
  core::Result<void> enter_all(std::string_view records, Declarations& declarations);

  ByteBuffer packed_;
  ByteBuffer unpacked_;
  std::string_view records_;  ///< into one of the buffers, or the caller's bytes
  std::vector<Entry> entries_;
  TimeSpan times_;
};

}  // namespace clew::bridge::mcap
