// SPDX-License-Identifier: Apache-2.0
#include "recording/mcap_writer.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/check.hpp"

namespace clew::bridge::mcap {
namespace {

/// Bytes of a Message record without its data.
constexpr std::uint64_t kMessageOverheadBytes = kRecordHeadBytes + 2 + 4 + 8 + 8;

/// Appends all records of one kind, and notes where they stand for the SummaryOffset section.
template <typename Records>
void append_group(std::string& out, std::uint64_t file_position, Opcode opcode,
                  const Records& records, std::vector<SummaryOffset>& offsets) {
  const std::size_t start = out.size();
  for (const auto& record : records) append(out, record);
  if (out.size() > start) offsets.push_back({opcode, file_position + start, out.size() - start});
}

}  // namespace

core::Result<McapWriter> McapWriter::create(const std::string& path, bool overwrite,
                                            WriterOptions options) {
  auto file = OutputFile::create(path, overwrite);
  if (!file.ok()) return file.error();
  return create(std::move(file).value(), std::move(options));
}

core::Result<McapWriter> McapWriter::create(OutputFile file, WriterOptions options) {
  McapWriter writer(std::move(file), std::move(options));
  writer.record_ = kMagic;
  append(writer.record_, Header{writer.options_.profile, writer.options_.library});
  CLEW_RETURN_IF_ERROR(writer.append_to_data_section(writer.record_));
  return writer;
}

McapWriter::McapWriter(OutputFile file, WriterOptions options)
    : file_(std::move(file)), options_(std::move(options)), chunk_indexes_(file_.path()) {}

core::Result<void> McapWriter::append_to_data_section(std::string_view bytes) {
  data_section_crc_ = crc32(bytes, data_section_crc_);
  return file_.append(bytes);
}

std::uint16_t McapWriter::add_schema(std::string name, std::string encoding, std::string data) {
  CLEW_CHECK(schemas_.size() < std::numeric_limits<std::uint16_t>::max(), "too many schemas");
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  schemas_.push_back({id, std::move(name), std::move(encoding), std::move(data)});
  chunk_.add(schemas_.back());
  ++statistics_.schema_count;
  return id;
}

std::uint16_t McapWriter::add_channel(std::uint16_t schema_id, std::string topic,
                                      std::string message_encoding, StringMap metadata) {
  CLEW_CHECK(schema_id <= schemas_.size(), "schema " + std::to_string(schema_id) + " is unknown");
  CLEW_CHECK(channels_.size() < std::numeric_limits<std::uint16_t>::max(), "too many channels");
  const auto id = static_cast<std::uint16_t>(channels_.size());
  channels_.push_back(
      {id, schema_id, std::move(topic), std::move(message_encoding), std::move(metadata)});
  chunk_.add(channels_.back());
  ++statistics_.channel_count;
  return id;
}

bool McapWriter::belongs_to_next_chunk(const Message& message) const {
  if (!chunk_.has_messages()) return false;
  const std::uint64_t span_ns = options_.chunk_span_ns;
  if (span_ns != 0 && message.log_time_ns / span_ns != chunk_.start_time_ns() / span_ns) {
    return true;
  }
  return chunk_.size_bytes() + kMessageOverheadBytes + message.data.size() > options_.chunk_bytes;
}

core::Result<void> McapWriter::write(const Message& message) {
  CLEW_CHECK(message.channel_id < channels_.size(),
             "channel " + std::to_string(message.channel_id) + " is unknown");
  if (belongs_to_next_chunk(message)) CLEW_RETURN_IF_ERROR(flush());
  chunk_.add(message);
  const bool first = statistics_.message_count == 0;
  statistics_.message_start_time_ns =
      first ? message.log_time_ns
            : std::min(statistics_.message_start_time_ns, message.log_time_ns);
  statistics_.message_end_time_ns = std::max(statistics_.message_end_time_ns, message.log_time_ns);
  ++statistics_.message_count;
  ++statistics_.channel_message_counts[message.channel_id];
  return {};
}

core::Result<void> McapWriter::write(const Attachment& attachment) {
  CLEW_RETURN_IF_ERROR(flush());
  record_.clear();
  append(record_, attachment);
  attachment_indexes_.push_back({file_.position(), record_.size(), attachment.log_time_ns,
                                 attachment.create_time_ns, attachment.data.size(), attachment.name,
                                 attachment.media_type});
  ++statistics_.attachment_count;
  return append_to_data_section(record_);
}

core::Result<void> McapWriter::write(const Metadata& metadata) {
  CLEW_RETURN_IF_ERROR(flush());
  record_.clear();
  append(record_, metadata);
  metadata_indexes_.push_back({file_.position(), record_.size(), metadata.name});
  ++statistics_.metadata_count;
  return append_to_data_section(record_);
}

core::Result<void> McapWriter::flush() {
  if (chunk_.empty()) return {};
  record_.clear();
  const ChunkIndex index = chunk_.pack(options_.compression, file_.position(), record_);
  chunk_.clear();
  ++statistics_.chunk_count;
  CLEW_RETURN_IF_ERROR(append_to_data_section(record_));
  record_.clear();
  append(record_, index);
  return chunk_indexes_.append(record_);
}

core::Result<void> McapWriter::write_ahead() {
  if (!chunk_.has_messages()) return {};
  record_.clear();
  chunk_.pack(options_.compression, file_.position(), record_);
  return file_.write_ahead(record_);
}

core::Result<void> McapWriter::append_to_summary(std::string_view bytes) {
  summary_crc_ = crc32(bytes, summary_crc_);
  return file_.append(bytes);
}

core::Result<void> McapWriter::append_ending() {
  CLEW_RETURN_IF_ERROR(flush());
  std::string part;
  append(part, DataEnd{data_section_crc_});
  CLEW_RETURN_IF_ERROR(file_.append(part));

  Footer footer;
  footer.summary_start = file_.position();
  std::vector<SummaryOffset> offsets;
  part.clear();
  append_group(part, file_.position(), Opcode::kSchema, schemas_, offsets);
  append_group(part, file_.position(), Opcode::kChannel, channels_, offsets);
  append_group(part, file_.position(), Opcode::kStatistics, std::vector<Statistics>{statistics_},
               offsets);
  CLEW_RETURN_IF_ERROR(append_to_summary(part));
  if (chunk_indexes_.size() > 0) {
    offsets.push_back({Opcode::kChunkIndex, file_.position(), chunk_indexes_.size()});
  }
  CLEW_RETURN_IF_ERROR(
      chunk_indexes_.read([this](std::string_view bytes) { return append_to_summary(bytes); }));
  part.clear();
  append_group(part, file_.position(), Opcode::kAttachmentIndex, attachment_indexes_, offsets);
  append_group(part, file_.position(), Opcode::kMetadataIndex, metadata_indexes_, offsets);
  footer.summary_offset_start = file_.position() + part.size();
  for (const auto& offset : offsets) append(part, offset);
  CLEW_RETURN_IF_ERROR(append_to_summary(part));

  // The CRC covers the summary and the footer up to the CRC itself, its last field.
  part.clear();
  append(part, footer);
  part.resize(part.size() - sizeof footer.summary_crc);
  footer.summary_crc = crc32(part, summary_crc_);
  part.clear();
  append(part, footer);
  part += kMagic;
  return file_.append(part);
}

core::Result<void> McapWriter::seal() {
  CLEW_RETURN_IF_ERROR(append_ending());
  return file_.seal();
}

core::Result<void> McapWriter::finish(bool overwrite) {
  CLEW_RETURN_IF_ERROR(append_ending());
  return file_.publish(overwrite);
}

}  // namespace clew::bridge::mcap
