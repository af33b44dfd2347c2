// SPDX-License-Identifier: Apache-2.0
#include "recording/segment_reader.hpp"

#include <algorithm>

#include "core/check.hpp"
#include "recording/compression.hpp"

namespace clew::bridge::mcap {
namespace {

core::Result<void> check_channel(std::uint16_t channel_id, const Declarations& declarations) {
  const auto channel = declarations.channels().find(channel_id);
  if (channel == declarations.channels().end()) {
    return damage("a message of channel " + std::to_string(channel_id) +
                  ", which no record before it declares");
  }
  const std::uint16_t schema_id = channel->second.schema_id;
  if (schema_id != 0 && declarations.schemas().count(schema_id) == 0) {
    return damage("a message of channel " + std::to_string(channel_id) + " with schema " +
                  std::to_string(schema_id) + ", which no record before it declares");
  }
  return {};
}

template <typename Declaration>
core::Result<void> declare(std::string_view content, const char* kind, Declarations& declarations) {
  Declaration declaration;
  if (!parse(content, declaration)) return damage(std::string("a malformed ") + kind + " record");
  const std::uint16_t id = declaration.id;
  if (!declarations.add(std::move(declaration))) {
    return damage(std::string(kind) + " " + std::to_string(id) + " is declared twice, differently");
  }
  return {};
}

}  // namespace

bool Declarations::add(Schema schema) {
  const auto [at, added] = schemas_.try_emplace(schema.id, schema);
  return added || at->second == schema;
}

bool Declarations::add(Channel channel) {
  const auto [at, added] = channels_.try_emplace(channel.id, channel);
  return added || at->second == channel;
}

void TimeSpan::add(std::uint64_t time_ns) {
  start_ns = any ? std::min(start_ns, time_ns) : time_ns;
  end_ns = std::max(end_ns, time_ns);
  any = true;
}

core::Result<void> enter_record(const RecordView& record, Declarations& declarations,
                                TimeSpan& times) {
  if (record.opcode == Opcode::kSchema) {
    // Schema 0 is not allowed; the specification asks readers to pass over it.
    const bool id_is_zero = record.content.substr(0, 2) == std::string_view("\0\0", 2);
    if (id_is_zero) return {};
    return declare<Schema>(record.content, "schema", declarations);
  }
  if (record.opcode == Opcode::kChannel) {
    return declare<Channel>(record.content, "channel", declarations);
  }
  if (record.opcode != Opcode::kMessage) return {};
  Message message;
  if (!parse(record.content, message)) return damage("a malformed message record");
  CLEW_RETURN_IF_ERROR(check_channel(message.channel_id, declarations));
  times.add(message.log_time_ns);
  return {};
}

core::Result<void> LoadedSegment::load(const InputFile& file, const Segment& segment,
                                       const ReadLimits& limits, Declarations& declarations) {
  if (segment.bytes > limits.record_bytes) {
    return damage("a record of " + std::to_string(segment.bytes) + " bytes; at most " +
                  std::to_string(limits.record_bytes) + " are read");
  }
  CLEW_RETURN_IF_ERROR(file.read(segment.offset, static_cast<std::size_t>(segment.bytes), packed_));
  if (!segment.chunk) {
    CLEW_RETURN_IF_ERROR(enter_all(packed_.view(), declarations));
  } else {
    const auto record = first_record(packed_.view());
    if (!record || record->opcode != Opcode::kChunk || record->total_bytes() != segment.bytes) {
      return damage("no chunk where the file's index says there is one");
    }
    CLEW_RETURN_IF_ERROR(unpack(record->content, limits, declarations));
  }
  if (times_.start_ns != segment.start_time_ns || times_.end_ns != segment.end_time_ns) {
    return damage("a chunk's messages have other times than the file's index says");
  }
  return {};
}

core::Result<void> LoadedSegment::unpack(std::string_view content, const ReadLimits& limits,
                                         Declarations& declarations) {
  Chunk chunk;
  if (!parse(content, chunk)) return damage("a malformed chunk record");
  const auto compression = compression_from_name(chunk.compression);
  if (!compression) {
    return damage("a chunk with compression '" + std::string(chunk.compression) +
                  "'; known are '', 'zstd' and 'lz4'");
  }
  if (chunk.uncompressed_bytes > limits.record_bytes) {
    return damage("a chunk of " + std::to_string(chunk.uncompressed_bytes) + " bytes; at most " +
                  std::to_string(limits.record_bytes) + " are read");
  }
  std::string_view records = chunk.records;
  if (*compression != Compression::kNone) {
    CLEW_RETURN_IF_ERROR(decompress(*compression, chunk.records,
                                    static_cast<std::size_t>(chunk.uncompressed_bytes), unpacked_));
    records = unpacked_.view();
  } else if (records.size() != chunk.uncompressed_bytes) {
    return damage("an uncompressed chunk of another size than it says");
  }
  if (chunk.uncompressed_crc != 0 && chunk.uncompressed_crc != crc32(records)) {
    return damage("a chunk whose CRC does not match: some of its bytes were changed");
  }
  CLEW_RETURN_IF_ERROR(enter_all(records, declarations));
  if (times_.start_ns != chunk.start_time_ns || times_.end_ns != chunk.end_time_ns) {
    return damage("a chunk whose messages have other times than it says");
  }
  return {};
}

core::Result<void> LoadedSegment::enter_all(std::string_view records, Declarations& declarations) {
  records_ = records;
  entries_.clear();
  times_ = {};
  std::size_t offset = 0;
  while (offset < records.size()) {
    const auto record = first_record(records.substr(offset));
    if (!record) return damage("a chunk whose last record is cut off");
    CLEW_RETURN_IF_ERROR(enter_record(*record, declarations, times_));
    if (record->opcode == Opcode::kMessage) {
      Message message;
      CLEW_CHECK(parse(record->content, message), "a message that was parsed before");
      entries_.push_back({message.log_time_ns, offset, message.channel_id});
    }
    offset += record->total_bytes();
  }
  return {};
}

Message LoadedSegment::message(const Entry& entry) const {
  const auto record = first_record(records_.substr(entry.offset));
  Message message;
  CLEW_CHECK(record && parse(record->content, message), "an entry that is no message");
  return message;
}

std::uint64_t LoadedSegment::memory_bytes() const {
  return packed_.size() + unpacked_.size() + entries_.size() * sizeof(Entry);
}

}  // namespace clew::bridge::mcap
