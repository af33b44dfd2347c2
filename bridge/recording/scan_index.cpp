// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "core/check.hpp"
#include "recording/mcap_index.hpp"
#include "recording/segment_reader.hpp"

namespace clew::bridge::mcap {
namespace {

/// Records outside chunks are read again in runs of at most this size, unless one alone is larger.
constexpr std::uint64_t kLooseSegmentBytes = 1 << 20;

/// Reads a file record by record from the front.
class Scanner {
 public:
  Scanner(std::shared_ptr<const InputFile> file, const ReadLimits& limits)
      : file_(std::move(file)), limits_(limits), window_(file_) {}

  core::Result<FileIndex> scan();

 private:
  /// One record. An error is one of the disk, or a data section that differs from its CRC; what is
  /// wrong with the record itself is a tear.
  core::Result<void> step();
  core::Result<void> enter(const RecordView& record);
  core::Result<void> enter_chunk(const RecordView& record);
  core::Result<void> enter_loose(const RecordView& record);
  core::Result<void> enter_attachment(const RecordView& record);
  core::Result<void> enter_metadata(const RecordView& record);
  core::Result<void> end_data_section(const RecordView& record);
  void extend_loose_segment(const RecordView& record);
  void end_loose_segment();
  core::Result<void> tear(std::string reason, bool at_end = false);

  std::shared_ptr<const InputFile> file_;
  ReadLimits limits_;
  FileWindow window_;
  FileIndex index_;
  LoadedSegment chunk_;
  std::uint64_t offset_ = 0;      ///< of the record at hand
  std::uint32_t crc_ = 0;         ///< of everything before it
  std::optional<Segment> loose_;  ///< the open run of records outside chunks
  TimeSpan loose_times_;
  bool chunks_seen_ = false;
  bool loose_messages_seen_ = false;
  bool done_ = false;
};

core::Result<FileIndex> Scanner::scan() {
  auto header = read_header(window_, *file_, limits_, offset_);
  if (!header.ok()) return header.error();
  index_.header = std::move(header).value();
  const auto opening = window_.view(0, static_cast<std::size_t>(offset_));
  if (!opening.ok()) return opening.error();
  crc_ = crc32(*opening);
  while (!done_) CLEW_RETURN_IF_ERROR(step());
  end_loose_segment();
  return std::move(index_);
}

core::Result<void> Scanner::step() {
  const std::uint64_t left = file_->size() - offset_;
  if (left < kRecordHeadBytes) return tear("it ends here, without its closing records", true);
  const auto head = window_.view(offset_, kRecordHeadBytes);
  if (!head.ok()) return head.error();
  const std::uint64_t content_bytes = announced_content_bytes(*head);
  if (content_bytes > left - kRecordHeadBytes) return tear("a record is cut off", true);
  const std::uint64_t total_bytes = kRecordHeadBytes + content_bytes;
  if (total_bytes > limits_.record_bytes) {
    return tear("a record of " + std::to_string(total_bytes) + " bytes; at most " +
                std::to_string(limits_.record_bytes) + " are read");
  }
  const auto bytes = window_.view(offset_, static_cast<std::size_t>(total_bytes));
  if (!bytes.ok()) return bytes.error();
  const auto record = first_record(*bytes);
  CLEW_CHECK(record.has_value(), "a record that was measured");
  if (record->opcode == Opcode::kDataEnd) return end_data_section(*record);
  if (const auto entered = enter(*record); !entered.ok()) return tear(entered.error().message);
  crc_ = crc32(*bytes, crc_);
  offset_ += total_bytes;
  return {};
}

core::Result<void> Scanner::enter(const RecordView& record) {
  switch (record.opcode) {
    case Opcode::kChunk:
      return enter_chunk(record);
    case Opcode::kSchema:
    case Opcode::kChannel:
    case Opcode::kMessage:
      return enter_loose(record);
    case Opcode::kAttachment:
      return enter_attachment(record);
    case Opcode::kMetadata:
      return enter_metadata(record);
    case Opcode::kHeader:
      return damage("a second header");
    case Opcode::kFooter:
      return damage("a footer inside the data");
    default:
      break;
  }
  // Opcodes that this version does not know are passed over; 0 is what a crash leaves on some
  // disks.
  if (static_cast<int>(record.opcode) == 0) return damage("a record of kind 0");
  return {};
}

core::Result<void> Scanner::enter_chunk(const RecordView& record) {
  // A damaged opcode can make a message of another record: files with both are not trusted.
  if (loose_messages_seen_) return damage("a chunk after messages outside chunks");
  CLEW_RETURN_IF_ERROR(chunk_.unpack(record.content, limits_, index_.declarations));
  index_.segments.push_back(
      {true, offset_, record.total_bytes(), chunk_.times().start_ns, chunk_.times().end_ns});
  chunks_seen_ = true;
  return {};
}

core::Result<void> Scanner::enter_loose(const RecordView& record) {
  const bool is_message = record.opcode == Opcode::kMessage;
  if (is_message && chunks_seen_) return damage("a message outside the chunks");
  TimeSpan times;
  CLEW_RETURN_IF_ERROR(enter_record(record, index_.declarations, times));
  if (!is_message) {
    end_loose_segment();
    return {};
  }
  loose_messages_seen_ = true;
  extend_loose_segment(record);
  loose_times_.add(times.start_ns);
  return {};
}

void Scanner::extend_loose_segment(const RecordView& record) {
  if (loose_ && loose_->bytes + record.total_bytes() > kLooseSegmentBytes) end_loose_segment();
  if (loose_ && loose_->offset + loose_->bytes != offset_) end_loose_segment();
  if (!loose_) loose_ = Segment{false, offset_, 0, 0, 0};
  loose_->bytes += record.total_bytes();
}

void Scanner::end_loose_segment() {
  if (!loose_) return;
  loose_->start_time_ns = loose_times_.start_ns;
  loose_->end_time_ns = loose_times_.end_ns;
  index_.segments.push_back(*loose_);
  loose_.reset();
  loose_times_ = {};
}

core::Result<void> Scanner::enter_attachment(const RecordView& record) {
  Attachment attachment;
  if (!parse(record.content, attachment)) {
    return damage("an attachment that is malformed or fails its CRC");
  }
  index_.attachments.push_back({offset_, record.total_bytes(), attachment.log_time_ns,
                                attachment.create_time_ns, attachment.data.size(),
                                std::move(attachment.name), std::move(attachment.media_type)});
  return {};
}

core::Result<void> Scanner::enter_metadata(const RecordView& record) {
  Metadata metadata;
  if (!parse(record.content, metadata)) return damage("a malformed metadata record");
  index_.metadata.push_back({offset_, record.total_bytes(), std::move(metadata.name)});
  return {};
}

core::Result<void> Scanner::end_data_section(const RecordView& record) {
  DataEnd data_end;
  if (!parse(record.content, data_end)) return tear("a malformed closing record");
  if (data_end.data_section_crc != 0 && data_end.data_section_crc != crc_) {
    return file_->error("its CRC does not match: some of its bytes were changed");
  }
  offset_ += record.total_bytes();
  done_ = true;
  const auto intact = has_intact_ending(file_, limits_);
  if (!intact.ok()) return intact.error();
  if (!*intact) return tear("its data are whole, but the index after them is damaged or cut off");
  return {};
}

core::Result<void> Scanner::tear(std::string reason, bool at_end) {
  index_.tear = Tear{offset_, std::move(reason), at_end};
  done_ = true;
  return {};
}

}  // namespace

core::Result<Header> read_header(FileWindow& window, const InputFile& file,
                                 const ReadLimits& limits, std::uint64_t& end) {
  const std::uint64_t shortest = kMagic.size() + kRecordHeadBytes;
  if (file.size() < shortest) return file.error("is too short to be an MCAP file");
  const auto opening = window.view(0, static_cast<std::size_t>(shortest));
  if (!opening.ok()) return opening.error();
  if (opening->substr(0, kMagic.size()) != kMagic) return file.error("is not an MCAP file");
  const std::uint64_t content_bytes = announced_content_bytes(opening->substr(kMagic.size()));
  if (content_bytes > file.size() - shortest || content_bytes > limits.record_bytes) {
    return file.error("is cut off in its header");
  }
  end = shortest + content_bytes;
  const auto bytes = window.view(0, static_cast<std::size_t>(end));
  if (!bytes.ok()) return bytes.error();
  const auto record = first_record(bytes->substr(kMagic.size()));
  Header header;
  if (!record || record->opcode != Opcode::kHeader || !parse(record->content, header)) {
    return file.error("has no MCAP header");
  }
  return header;
}

core::Result<FileIndex> index_from_scan(const std::shared_ptr<const InputFile>& file,
                                        const ReadLimits& limits) {
  return Scanner(file, limits).scan();
}

}  // namespace clew::bridge::mcap
