// SPDX-License-Identifier: Apache-2.0
#include "recording/chunk_builder.hpp"

#include <algorithm>

namespace clew::bridge::mcap {

void ChunkBuilder::add(const Message& message) {
  MessageIndex& index = indexes_[message.channel_id];
  index.channel_id = message.channel_id;
  index.entries.push_back({message.log_time_ns, records_.size()});
  start_time_ns_ =
      has_messages_ ? std::min(start_time_ns_, message.log_time_ns) : message.log_time_ns;
  end_time_ns_ = std::max(end_time_ns_, message.log_time_ns);
  has_messages_ = true;
  append(records_, message);
}

ChunkIndex ChunkBuilder::pack(Compression compression, std::uint64_t file_position,
                              std::string& out) {
  if (compression != Compression::kNone) {
    compress(compression, records_, packed_);
    if (packed_.size() >= records_.size()) compression = Compression::kNone;
  }
  Chunk chunk;
  chunk.start_time_ns = start_time_ns_;
  chunk.end_time_ns = end_time_ns_;
  chunk.uncompressed_bytes = records_.size();
  chunk.uncompressed_crc = crc32(records_);
  chunk.compression = compression_name(compression);
  chunk.records = compression == Compression::kNone ? records_ : packed_;

  const std::size_t out_start = out.size();
  append(out, chunk);
  ChunkIndex index;
  index.start_time_ns = chunk.start_time_ns;
  index.end_time_ns = chunk.end_time_ns;
  index.chunk_offset = file_position;
  index.chunk_bytes = out.size() - out_start;
  index.compression = chunk.compression;
  index.compressed_bytes = chunk.records.size();
  index.uncompressed_bytes = chunk.uncompressed_bytes;
  for (const auto& [channel_id, message_index] : indexes_) {
    if (message_index.entries.empty()) continue;
    index.message_index_offsets[channel_id] = file_position + (out.size() - out_start);
    append(out, message_index);
  }
  index.message_index_bytes = out.size() - out_start - index.chunk_bytes;
  return index;
}

void ChunkBuilder::clear() {
  records_.clear();
  for (auto& [channel_id, index] : indexes_) index.entries.clear();
  has_messages_ = false;
  start_time_ns_ = 0;
  end_time_ns_ = 0;
}

}  // namespace clew::bridge::mcap
