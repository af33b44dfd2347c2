// SPDX-License-Identifier: Apache-2.0
#include "recording/mcap_reader.hpp"

#include <utility>

namespace clew::bridge::mcap {
namespace {

core::Result<RecordView> read_record(const InputFile& file, const ReadLimits& limits,
                                     std::uint64_t offset, std::uint64_t bytes, Opcode opcode,
                                     ByteBuffer& buffer) {
  if (bytes > limits.record_bytes) {
    return file.error("has a record of " + std::to_string(bytes) + " bytes; at most " +
                      std::to_string(limits.record_bytes) + " are read");
  }
  CLEW_RETURN_IF_ERROR(file.read(offset, static_cast<std::size_t>(bytes), buffer));
  const auto record = first_record(buffer.view());
  if (!record || record->opcode != opcode) {
    return file.error("has no such record at byte " + std::to_string(offset) +
                      ", where its index says there is one");
  }
  return *record;
}

}  // namespace

core::Result<McapReader> McapReader::open(const std::string& path, const ReadLimits& limits) {
  const auto file = InputFile::open(path);
  if (!file.ok()) return file.error();
  auto by_summary = index_from_summary(*file, limits);
  if (!by_summary.ok()) return by_summary.error();
  if (*by_summary) {
    return McapReader(*file, std::make_shared<FileIndex>(std::move(**by_summary)), limits);
  }
  auto by_scan = index_from_scan(*file, limits);
  if (!by_scan.ok()) return by_scan.error();
  return McapReader(*file, std::make_shared<FileIndex>(std::move(*by_scan)), limits);
}

McapReader::McapReader(std::shared_ptr<const InputFile> file,
                       std::shared_ptr<const FileIndex> index, const ReadLimits& limits)
    : file_(std::move(file)), index_(std::move(index)), limits_(limits) {}

core::Result<Attachment> McapReader::attachment(const AttachmentIndex& place,
                                                ByteBuffer& buffer) const {
  const auto record =
      read_record(*file_, limits_, place.offset, place.bytes, Opcode::kAttachment, buffer);
  if (!record.ok()) return record.error();
  Attachment attachment;
  if (!parse(record->content, attachment)) {
    return file_->error("has an attachment '" + place.name +
                        "' that is malformed or fails its CRC");
  }
  return attachment;
}

core::Result<Metadata> McapReader::metadata(const MetadataIndex& place) const {
  ByteBuffer buffer;
  const auto record =
      read_record(*file_, limits_, place.offset, place.bytes, Opcode::kMetadata, buffer);
  if (!record.ok()) return record.error();
  Metadata metadata;
  if (!parse(record->content, metadata)) {
    return file_->error("has a malformed metadata record '" + place.name + "'");
  }
  return metadata;
}

MessageStream McapReader::messages(Order order, MessageFilter filter) const {
  return {file_, index_, limits_, order, std::move(filter)};
}

core::Result<void> McapReader::verify() const {
  const auto scanned = index_from_scan(file_, limits_);
  if (!scanned.ok()) return scanned.error();
  // The scan takes a broken record for the end; in a file whose index is whole it is a change.
  if (scanned->tear && indexed()) {
    return file_->error("is damaged at byte " + std::to_string(scanned->tear->at_byte) + ": " +
                        scanned->tear->reason);
  }
  return {};
}

}  // namespace clew::bridge::mcap
