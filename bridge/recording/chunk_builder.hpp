// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "recording/compression.hpp"
#include "recording/mcap_records.hpp"

namespace clew::bridge::mcap {

/// The open chunk of a writer: its records, and where each channel's messages are in them.
class ChunkBuilder {
 public:
  void add(const Schema& schema) { append(records_, schema); }
  void add(const Channel& channel) { append(records_, channel); }
  void add(const Message& message);

  bool empty() const { return records_.empty(); }
  bool has_messages() const { return has_messages_; }
  std::uint64_t size_bytes() const { return records_.size(); }
  /// Least log time of the messages; 0 without any.
  std::uint64_t start_time_ns() const { return start_time_ns_; }

  /// Appends the Chunk record and its MessageIndex records to `out`, which will stand at
  /// `file_position`, and returns the chunk's index. Records that do not shrink are stored as they
  /// are.
  ChunkIndex pack(Compression compression, std::uint64_t file_position, std::string& out);
  /// Empties itself, for the next chunk.
  void clear();

 private:
  std::string records_;
  std::string packed_;                             ///< kept for its memory
  std::map<std::uint16_t, MessageIndex> indexes_;  ///< entries empty: no message in this chunk
  bool has_messages_ = false;
  std::uint64_t start_time_ns_ = 0;
  std::uint64_t end_time_ns_ = 0;
};

}  // namespace clew::bridge::mcap
