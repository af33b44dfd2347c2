// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <tuple>

#include "recording/mcap_records.hpp"

namespace clew::bridge::mcap {
namespace {

/// Reads from the front of bytes that may lie about their lengths: past the end everything is 0 or
/// empty, and ok() is false for good.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}

  bool ok() const { return ok_; }
  bool at_end() const { return rest_.empty(); }
  std::size_t rest_bytes() const { return rest_.size(); }

  template <typename Integer>
  Integer integer() {
    // Copied at once, since this is most of what reading a file costs: a host is little-endian, as
    // the format is.
    const std::string_view raw = take(sizeof(Integer));
    Integer value = 0;
    if (!raw.empty()) std::memcpy(&value, raw.data(), sizeof value);
    return value;
  }
  std::string_view text() { return take(integer<std::uint32_t>()); }
  std::string_view long_bytes() { return take(integer<std::uint64_t>()); }
  std::string_view rest() { return take(rest_.size()); }

 private:
  std::string_view take(std::uint64_t bytes) {
    if (!ok_ || bytes > rest_.size()) {
      ok_ = false;
      rest_ = {};
      return {};
    }
    const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(bytes));
    rest_.remove_prefix(static_cast<std::size_t>(bytes));
    return taken;
  }

  std::string_view rest_;
  bool ok_ = true;
};

bool read_map(Cursor& in, StringMap& map) {
  map.clear();
  Cursor items(in.text());
  while (items.ok() && !items.at_end()) {
    const std::string_view key = items.text();
    const std::string_view value = items.text();
    if (items.ok()) map.insert_or_assign(std::string(key), std::string(value));
  }
  return items.ok();
}

bool read_map(Cursor& in, std::map<std::uint16_t, std::uint64_t>& map) {
  map.clear();
  Cursor items(in.text());
  while (items.ok() && !items.at_end()) {
    const auto key = items.integer<std::uint16_t>();
    const auto value = items.integer<std::uint64_t>();
    if (items.ok()) map.insert_or_assign(key, value);
  }
  return items.ok();
}

}  // namespace

bool operator==(const Schema& a, const Schema& b) {
  return std::tie(a.id, a.name, a.encoding, a.data) == std::tie(b.id, b.name, b.encoding, b.data);
}

bool operator==(const Channel& a, const Channel& b) {
  return std::tie(a.id, a.schema_id, a.topic, a.message_encoding, a.metadata) ==
         std::tie(b.id, b.schema_id, b.topic, b.message_encoding, b.metadata);
}

bool parse(std::string_view content, Header& record) {
  Cursor in(content);
  record.profile = in.text();
  record.library = in.text();
  return in.ok();
}

bool parse(std::string_view content, Footer& record) {
  Cursor in(content);
  record.summary_start = in.integer<std::uint64_t>();
  record.summary_offset_start = in.integer<std::uint64_t>();
  record.summary_crc = in.integer<std::uint32_t>();
  return in.ok();
}

bool parse(std::string_view content, Schema& record) {
  Cursor in(content);
  record.id = in.integer<std::uint16_t>();
  record.name = in.text();
  record.encoding = in.text();
  record.data = in.text();
  return in.ok() && record.id != 0;
}

bool parse(std::string_view content, Channel& record) {
  Cursor in(content);
  record.id = in.integer<std::uint16_t>();
  record.schema_id = in.integer<std::uint16_t>();
  record.topic = in.text();
  record.message_encoding = in.text();
  return read_map(in, record.metadata) && in.ok();
}

bool parse(std::string_view content, Message& record) {
  Cursor in(content);
  record.channel_id = in.integer<std::uint16_t>();
  record.sequence = in.integer<std::uint32_t>();
  record.log_time_ns = in.integer<std::uint64_t>();
  record.publish_time_ns = in.integer<std::uint64_t>();
  record.data = in.rest();
  return in.ok();
}

bool parse(std::string_view content, Chunk& record) {
  Cursor in(content);
  record.start_time_ns = in.integer<std::uint64_t>();
  record.end_time_ns = in.integer<std::uint64_t>();
  record.uncompressed_bytes = in.integer<std::uint64_t>();
  record.uncompressed_crc = in.integer<std::uint32_t>();
  record.compression = in.text();
  record.records = in.long_bytes();
  return in.ok();
}

bool parse(std::string_view content, MessageIndex& record) {
  Cursor in(content);
  record.channel_id = in.integer<std::uint16_t>();
  record.entries.clear();
  Cursor items(in.text());
  while (items.ok() && !items.at_end()) {
    MessageIndex::Entry entry;
    entry.log_time_ns = items.integer<std::uint64_t>();
    entry.offset = items.integer<std::uint64_t>();
    if (items.ok()) record.entries.push_back(entry);
  }
  return in.ok() && items.ok();
}

bool parse(std::string_view content, ChunkIndex& record) {
  Cursor in(content);
  record.start_time_ns = in.integer<std::uint64_t>();
  record.end_time_ns = in.integer<std::uint64_t>();
  record.chunk_offset = in.integer<std::uint64_t>();
  record.chunk_bytes = in.integer<std::uint64_t>();
  if (!read_map(in, record.message_index_offsets)) return false;
  record.message_index_bytes = in.integer<std::uint64_t>();
  record.compression = in.text();
  record.compressed_bytes = in.integer<std::uint64_t>();
  record.uncompressed_bytes = in.integer<std::uint64_t>();
  return in.ok();
}

bool parse(std::string_view content, Attachment& record) {
  Cursor in(content);
  record.log_time_ns = in.integer<std::uint64_t>();
  record.create_time_ns = in.integer<std::uint64_t>();
  record.name = in.text();
  record.media_type = in.text();
  record.data = in.long_bytes();
  const std::size_t covered_bytes = content.size() - in.rest_bytes();
  const auto crc = in.integer<std::uint32_t>();
  return in.ok() && (crc == 0 || crc == crc32(content.substr(0, covered_bytes)));
}

bool parse(std::string_view content, AttachmentIndex& record) {
  Cursor in(content);
  record.offset = in.integer<std::uint64_t>();
  record.bytes = in.integer<std::uint64_t>();
  record.log_time_ns = in.integer<std::uint64_t>();
  record.create_time_ns = in.integer<std::uint64_t>();
  record.data_bytes = in.integer<std::uint64_t>();
  record.name = in.text();
  record.media_type = in.text();
  return in.ok();
}

bool parse(std::string_view content, Statistics& record) {
  Cursor in(content);
  record.message_count = in.integer<std::uint64_t>();
  record.schema_count = in.integer<std::uint16_t>();
  record.channel_count = in.integer<std::uint32_t>();
  record.attachment_count = in.integer<std::uint32_t>();
  record.metadata_count = in.integer<std::uint32_t>();
  record.chunk_count = in.integer<std::uint32_t>();
  record.message_start_time_ns = in.integer<std::uint64_t>();
  record.message_end_time_ns = in.integer<std::uint64_t>();
  return read_map(in, record.channel_message_counts) && in.ok();
}

bool parse(std::string_view content, Metadata& record) {
  Cursor in(content);
  record.name = in.text();
  return read_map(in, record.entries) && in.ok();
}

bool parse(std::string_view content, MetadataIndex& record) {
  Cursor in(content);
  record.offset = in.integer<std::uint64_t>();
  record.bytes = in.integer<std::uint64_t>();
  record.name = in.text();
  return in.ok();
}

bool parse(std::string_view content, DataEnd& record) {
  Cursor in(content);
  record.data_section_crc = in.integer<std::uint32_t>();
  // Later versions of the format never extend it, and no CRC protects its length.
  return in.ok() && in.at_end();
}

std::uint64_t announced_content_bytes(std::string_view bytes) {
  Cursor in(bytes.substr(1));
  return in.integer<std::uint64_t>();
}

std::optional<RecordView> first_record(std::string_view bytes) {
  if (bytes.size() < kRecordHeadBytes) return std::nullopt;
  const std::uint64_t content_bytes = announced_content_bytes(bytes);
  if (content_bytes > bytes.size() - kRecordHeadBytes) return std::nullopt;
  return RecordView{static_cast<Opcode>(bytes[0]),
                    bytes.substr(kRecordHeadBytes, static_cast<std::size_t>(content_bytes))};
}

}  // namespace clew::bridge::mcap
