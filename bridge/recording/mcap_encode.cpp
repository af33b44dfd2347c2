// SPDX-License-Identifier: Apache-2.0
#include <zlib.h>

#include <array>
#include <limits>

#include "core/check.hpp"
#include "recording/mcap_records.hpp"

namespace clew::bridge::mcap {
namespace {

/// The little-endian bytes of an integer.
template <typename Integer>
std::array<char, sizeof(Integer)> bytes_of(Integer value) {
  std::array<char, sizeof(Integer)> bytes;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<char>((value >> (8 * i)) & 0xFFU);
  }
  return bytes;
}

template <typename Integer>
void put(std::string& out, Integer value) {
  const auto bytes = bytes_of(value);
  out.append(bytes.data(), bytes.size());
}

/// Overwrites the integer at `at`.
template <typename Integer>
void set(std::string& out, std::size_t at, Integer value) {
  const auto bytes = bytes_of(value);
  out.replace(at, bytes.size(), bytes.data(), bytes.size());
}

std::uint32_t length32(std::size_t bytes) {
  CLEW_CHECK(bytes <= std::numeric_limits<std::uint32_t>::max(),
             "a part of " + std::to_string(bytes) + " bytes does not fit in an MCAP record");
  return static_cast<std::uint32_t>(bytes);
}

void put_string(std::string& out, std::string_view text) {
  put(out, length32(text.size()));
  out.append(text);
}

/// Writes opcode and length around what is appended to the string during its life.
class RecordScope {
 public:
  RecordScope(std::string& out, Opcode opcode) : out_(out) {
    out_.push_back(static_cast<char>(opcode));
    put<std::uint64_t>(out_, 0);
    content_start_ = out_.size();
  }
  ~RecordScope() {
    set<std::uint64_t>(out_, content_start_ - sizeof(std::uint64_t), out_.size() - content_start_);
  }
  RecordScope(const RecordScope&) = delete;
  RecordScope& operator=(const RecordScope&) = delete;

  std::size_t content_start() const { return content_start_; }

 private:
  std::string& out_;
  std::size_t content_start_ = 0;
};

/// Writes the 32-bit byte length around what is appended to the string during its life.
class LengthScope {
 public:
  explicit LengthScope(std::string& out) : out_(out) {
    put<std::uint32_t>(out_, 0);
    start_ = out_.size();
  }
  ~LengthScope() { set(out_, start_ - sizeof(std::uint32_t), length32(out_.size() - start_)); }
  LengthScope(const LengthScope&) = delete;
  LengthScope& operator=(const LengthScope&) = delete;

 private:
  std::string& out_;
  std::size_t start_ = 0;
};

void put_map(std::string& out, const StringMap& map) {
  const LengthScope length(out);
  for (const auto& [key, value] : map) {
    put_string(out, key);
    put_string(out, value);
  }
}

void put_map(std::string& out, const std::map<std::uint16_t, std::uint64_t>& map) {
  const LengthScope length(out);
  for (const auto& [key, value] : map) {
    put(out, key);
    put(out, value);
  }
}

}  // namespace

std::uint32_t crc32(std::string_view bytes, std::uint32_t crc) {
  return static_cast<std::uint32_t>(
      ::crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void append(std::string& out, const Header& record) {
  const RecordScope scope(out, Opcode::kHeader);
  put_string(out, record.profile);
  put_string(out, record.library);
}

void append(std::string& out, const Footer& record) {
  const RecordScope scope(out, Opcode::kFooter);
  put(out, record.summary_start);
  put(out, record.summary_offset_start);
  put(out, record.summary_crc);
}

void append(std::string& out, const Schema& record) {
  const RecordScope scope(out, Opcode::kSchema);
  put(out, record.id);
  put_string(out, record.name);
  put_string(out, record.encoding);
  put_string(out, record.data);
}

void append(std::string& out, const Channel& record) {
  const RecordScope scope(out, Opcode::kChannel);
  put(out, record.id);
  put(out, record.schema_id);
  put_string(out, record.topic);
  put_string(out, record.message_encoding);
  put_map(out, record.metadata);
}

void append(std::string& out, const Message& record) {
  const RecordScope scope(out, Opcode::kMessage);
  put(out, record.channel_id);
  put(out, record.sequence);
  put(out, record.log_time_ns);
  put(out, record.publish_time_ns);
  out.append(record.data);
}

void append(std::string& out, const Chunk& record) {
  const RecordScope scope(out, Opcode::kChunk);
  put(out, record.start_time_ns);
  put(out, record.end_time_ns);
  put(out, record.uncompressed_bytes);
  put(out, record.uncompressed_crc);
  put_string(out, record.compression);
  put<std::uint64_t>(out, record.records.size());
  out.append(record.records);
}

void append(std::string& out, const MessageIndex& record) {
  const RecordScope scope(out, Opcode::kMessageIndex);
  put(out, record.channel_id);
  const LengthScope length(out);
  for (const auto& entry : record.entries) {
    put(out, entry.log_time_ns);
    put(out, entry.offset);
  }
}

void append(std::string& out, const ChunkIndex& record) {
  const RecordScope scope(out, Opcode::kChunkIndex);
  put(out, record.start_time_ns);
  put(out, record.end_time_ns);
  put(out, record.chunk_offset);
  put(out, record.chunk_bytes);
  put_map(out, record.message_index_offsets);
  put(out, record.message_index_bytes);
  put_string(out, record.compression);
  put(out, record.compressed_bytes);
  put(out, record.uncompressed_bytes);
}

void append(std::string& out, const Attachment& record) {
  const RecordScope scope(out, Opcode::kAttachment);
  put(out, record.log_time_ns);
  put(out, record.create_time_ns);
  put_string(out, record.name);
  put_string(out, record.media_type);
  put<std::uint64_t>(out, record.data.size());
  out.append(record.data);
  const std::string_view written = out;
  put(out, crc32(written.substr(scope.content_start())));
}

void append(std::string& out, const AttachmentIndex& record) {
  const RecordScope scope(out, Opcode::kAttachmentIndex);
  put(out, record.offset);
  put(out, record.bytes);
  put(out, record.log_time_ns);
  put(out, record.create_time_ns);
  put(out, record.data_bytes);
  put_string(out, record.name);
  put_string(out, record.media_type);
}

void append(std::string& out, const Statistics& record) {
  const RecordScope scope(out, Opcode::kStatistics);
  put(out, record.message_count);
  put(out, record.schema_count);
  put(out, record.channel_count);
  put(out, record.attachment_count);
  put(out, record.metadata_count);
  put(out, record.chunk_count);
  put(out, record.message_start_time_ns);
  put(out, record.message_end_time_ns);
  put_map(out, record.channel_message_counts);
}

void append(std::string& out, const Metadata& record) {
  const RecordScope scope(out, Opcode::kMetadata);
  put_string(out, record.name);
  put_map(out, record.entries);
}

void append(std::string& out, const MetadataIndex& record) {
  const RecordScope scope(out, Opcode::kMetadataIndex);
  put(out, record.offset);
  put(out, record.bytes);
  put_string(out, record.name);
}

void append(std::string& out, const SummaryOffset& record) {
  const RecordScope scope(out, Opcode::kSummaryOffset);
  out.push_back(static_cast<char>(record.group));
  put(out, record.group_start);
  put(out, record.group_bytes);
}

void append(std::string& out, const DataEnd& record) {
  const RecordScope scope(out, Opcode::kDataEnd);
  put(out, record.data_section_crc);
}

}  // namespace clew::bridge::mcap
