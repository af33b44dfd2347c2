// SPDX-License-Identifier: Apache-2.0
/// The records of the MCAP container format (specification: github.com/foxglove/mcap,
/// website/docs/spec/index.md, 2024), as plain structs, and their bytes. All integers are
/// little-endian; a string is a 32-bit length and UTF-8; a record is an opcode, a 64-bit length and
/// its content. All times are nanoseconds of one clock, here simulated time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clew::bridge::mcap {

/// First and last bytes of every file.
inline constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
/// Bytes of a record before its content: opcode and length.
inline constexpr std::size_t kRecordHeadBytes = 1 + 8;
/// Bytes of the content of a Footer, and of a Footer with the closing magic: the end of every file.
inline constexpr std::size_t kFooterContentBytes = 8 + 8 + 4;
inline constexpr std::size_t kTailBytes = kRecordHeadBytes + kFooterContentBytes + kMagic.size();

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F
};

using StringMap = std::map<std::string, std::string>;

struct Header {
  std::string profile;
  std::string library;
};

struct Footer {
  std::uint64_t summary_start = 0;         ///< 0: there is no summary
  std::uint64_t summary_offset_start = 0;  ///< 0: there are no summary offsets
  std::uint32_t summary_crc = 0;           ///< 0: not computed
};

struct Schema {
  std::uint16_t id = 0;  ///< never 0
  std::string name;
  std::string encoding;
  std::string data;
};

struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;  ///< 0: there is no schema
  std::string topic;
  std::string message_encoding;
  StringMap metadata;
};

/// A message; `data` belongs to whoever made it.
struct Message {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  std::string_view data;
};

/// A chunk as it stands in the file; `records` may be compressed and belongs to whoever made it.
struct Chunk {
  std::uint64_t start_time_ns = 0;  ///< least log time in it; 0 without messages
  std::uint64_t end_time_ns = 0;    ///< greatest log time in it; 0 without messages
  std::uint64_t uncompressed_bytes = 0;
  std::uint32_t uncompressed_crc = 0;  ///< 0: not computed
  std::string_view compression;
  std::string_view records;
};

struct MessageIndex {
  struct Entry {
    std::uint64_t log_time_ns = 0;
    std::uint64_t offset = 0;  ///< of the message's record in the uncompressed chunk
  };
  std::uint16_t channel_id = 0;
  std::vector<Entry> entries;
};

struct ChunkIndex {
  std::uint64_t start_time_ns = 0;
  std::uint64_t end_time_ns = 0;
  std::uint64_t chunk_offset = 0;  ///< of the Chunk record in the file
  std::uint64_t chunk_bytes = 0;   ///< of the Chunk record, with opcode and length
  std::map<std::uint16_t, std::uint64_t> message_index_offsets;  ///< channel to place in the file
  std::uint64_t message_index_bytes = 0;
  std::string compression;
  std::uint64_t compressed_bytes = 0;
  std::uint64_t uncompressed_bytes = 0;
};

/// A file in the file; `data` belongs to whoever made it.
struct Attachment {
  std::uint64_t log_time_ns = 0;
  std::uint64_t create_time_ns = 0;
  std::string name;
  std::string media_type;
  std::string_view data;
};

struct AttachmentIndex {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;  ///< of the Attachment record, with opcode and length
  std::uint64_t log_time_ns = 0;
  std::uint64_t create_time_ns = 0;
  std::uint64_t data_bytes = 0;
  std::string name;
  std::string media_type;
};

struct Statistics {
  std::uint64_t message_count = 0;
  std::uint16_t schema_count = 0;
  std::uint32_t channel_count = 0;
  std::uint32_t attachment_count = 0;
  std::uint32_t metadata_count = 0;
  std::uint32_t chunk_count = 0;
  std::uint64_t message_start_time_ns = 0;  ///< 0 without messages
  std::uint64_t message_end_time_ns = 0;    ///< 0 without messages
  std::map<std::uint16_t, std::uint64_t> channel_message_counts;
};

struct Metadata {
  std::string name;
  StringMap entries;
};

struct MetadataIndex {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;  ///< of the Metadata record, with opcode and length
  std::string name;
};

struct SummaryOffset {
  Opcode group = Opcode::kSchema;
  std::uint64_t group_start = 0;
  std::uint64_t group_bytes = 0;
};

struct DataEnd {
  std::uint32_t data_section_crc = 0;  ///< of all bytes before this record; 0: not computed
};

bool operator==(const Schema& a, const Schema& b);
bool operator==(const Channel& a, const Channel& b);

/// CRC-32 (ISO 3309, as in zlib) of `bytes`, going on from `crc`, which is 0 at the start.
std::uint32_t crc32(std::string_view bytes, std::uint32_t crc = 0);

/// Append a whole record: opcode, length, content. An Attachment's CRC is computed here.
void append(std::string& out, const Header& record);
void append(std::string& out, const Footer& record);
void append(std::string& out, const Schema& record);
void append(std::string& out, const Channel& record);
void append(std::string& out, const Message& record);
void append(std::string& out, const Chunk& record);
void append(std::string& out, const MessageIndex& record);
void append(std::string& out, const ChunkIndex& record);
void append(std::string& out, const Attachment& record);
void append(std::string& out, const AttachmentIndex& record);
void append(std::string& out, const Statistics& record);
void append(std::string& out, const Metadata& record);
void append(std::string& out, const MetadataIndex& record);
void append(std::string& out, const SummaryOffset& record);
void append(std::string& out, const DataEnd& record);

/// Fill a record from its content, without opcode and length. False if the content is shorter than
/// its own lengths say, an Attachment's CRC differs, or a schema's id is 0; more bytes than known
/// are ignored, as the specification asks. Views point into `content`.
[[nodiscard]] bool parse(std::string_view content, Header& record);
[[nodiscard]] bool parse(std::string_view content, Footer& record);
[[nodiscard]] bool parse(std::string_view content, Schema& record);
[[nodiscard]] bool parse(std::string_view content, Channel& record);
[[nodiscard]] bool parse(std::string_view content, Message& record);
[[nodiscard]] bool parse(std::string_view content, Chunk& record);
[[nodiscard]] bool parse(std::string_view content, MessageIndex& record);
[[nodiscard]] bool parse(std::string_view content, ChunkIndex& record);
[[nodiscard]] bool parse(std::string_view content, Attachment& record);
[[nodiscard]] bool parse(std::string_view content, AttachmentIndex& record);
[[nodiscard]] bool parse(std::string_view content, Statistics& record);
[[nodiscard]] bool parse(std::string_view content, Metadata& record);
[[nodiscard]] bool parse(std::string_view content, MetadataIndex& record);
[[nodiscard]] bool parse(std::string_view content, DataEnd& record);

/// A record in a run of bytes.
struct RecordView {
  Opcode opcode = Opcode::kHeader;  ///< may be one that this version does not know
  std::string_view content;

  std::size_t total_bytes() const { return kRecordHeadBytes + content.size(); }
};

/// The record at the front of `bytes`; nothing if it does not end within them.
std::optional<RecordView> first_record(std::string_view bytes);

/// The length that the record head at the front of `bytes` (at least kRecordHeadBytes) announces.
std::uint64_t announced_content_bytes(std::string_view bytes);

}  // namespace clew::bridge::mcap
