// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "recording/mcap_index.hpp"

namespace clew::bridge::mcap {
namespace {

/// A part of the file that the summary points to.
struct Place {
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
};

/// The bytes from the summary's first one up to the closing magic, without it.
struct Ending {
  Footer footer;
  ByteBuffer bytes;

  std::string_view summary() const {
    return bytes.view().substr(0, bytes.size() - kRecordHeadBytes - kFooterContentBytes);
  }
};

/// Nothing if there is no footer and magic, or what the footer says is impossible or fails its CRC.
core::Result<std::optional<Ending>> read_ending(const InputFile& file, const ReadLimits& limits) {
  if (file.size() < kMagic.size() + kTailBytes) return std::optional<Ending>();
  Ending ending;
  const std::uint64_t footer_start = file.size() - kTailBytes;
  CLEW_RETURN_IF_ERROR(file.read(footer_start, kTailBytes, ending.bytes));
  const std::string_view tail = ending.bytes.view();
  const auto record = first_record(tail);
  if (!record || record->opcode != Opcode::kFooter ||
      record->content.size() != kFooterContentBytes || !parse(record->content, ending.footer) ||
      tail.substr(tail.size() - kMagic.size()) != kMagic) {
    return std::optional<Ending>();
  }
  const std::uint64_t summary_start = ending.footer.summary_start;
  const std::uint64_t start = summary_start == 0 ? footer_start : summary_start;
  const std::uint64_t end = file.size() - kMagic.size();
  if (start < kMagic.size() || start > footer_start || end - start > limits.record_bytes) {
    return std::optional<Ending>();
  }
  CLEW_RETURN_IF_ERROR(file.read(start, static_cast<std::size_t>(end - start), ending.bytes));
  const std::string_view covered =
      ending.bytes.view().substr(0, ending.bytes.size() - sizeof ending.footer.summary_crc);
  if (ending.footer.summary_crc != 0 && ending.footer.summary_crc != crc32(covered)) {
    return std::optional<Ending>();
  }
  return std::optional<Ending>(std::move(ending));
}

/// Collects the records of a summary.
class SummaryReader {
 public:
  /// False if a record is malformed, or contradicts another.
  bool enter(const RecordView& record) {
    switch (record.opcode) {
      case Opcode::kSchema:
        return declare<Schema>(record.content);
      case Opcode::kChannel:
        return declare<Channel>(record.content);
      case Opcode::kStatistics:
        return parse(record.content, index_.statistics.emplace());
      case Opcode::kChunkIndex:
        return enter_chunk(record.content);
      case Opcode::kAttachmentIndex:
        return parse(record.content, index_.attachments.emplace_back());
      case Opcode::kMetadataIndex:
        return parse(record.content, index_.metadata.emplace_back());
      default:
        return true;
    }
  }

  /// The index, or nothing if it is not enough to read the file by. Messages stand before
  /// `data_end`, the summary's start.
  std::optional<FileIndex> finish(std::uint64_t data_end) && {
    sort_by_place();
    if (!counts_agree() || !channels_known() || !places_are_apart(data_end)) return std::nullopt;
    index_.from_summary = true;
    return std::move(index_);
  }

 private:
  template <typename Declaration>
  bool declare(std::string_view content) {
    Declaration declaration;
    return parse(content, declaration) && index_.declarations.add(std::move(declaration));
  }

  bool enter_chunk(std::string_view content) {
    ChunkIndex chunk;
    if (!parse(content, chunk)) return false;
    index_.segments.push_back(
        {true, chunk.chunk_offset, chunk.chunk_bytes, chunk.start_time_ns, chunk.end_time_ns});
    return true;
  }

  void sort_by_place() {
    const auto earlier = [](const auto& a, const auto& b) { return a.offset < b.offset; };
    std::sort(index_.segments.begin(), index_.segments.end(), earlier);
    std::sort(index_.attachments.begin(), index_.attachments.end(), earlier);
    std::sort(index_.metadata.begin(), index_.metadata.end(), earlier);
  }

  bool counts_agree() const {
    const auto& statistics = index_.statistics;
    return statistics && statistics->chunk_count == index_.segments.size() &&
           statistics->attachment_count == index_.attachments.size() &&
           statistics->metadata_count == index_.metadata.size() &&
           (statistics->message_count == 0 || statistics->chunk_count > 0);
  }

  bool channels_known() const {
    if (index_.declarations.channels().size() != index_.statistics->channel_count) return false;
    for (const auto& [id, channel] : index_.declarations.channels()) {
      if (channel.schema_id != 0 && index_.declarations.schemas().count(channel.schema_id) == 0) {
        return false;
      }
    }
    return true;
  }

  /// Two places that overlap would let a small file be read for ever.
  bool places_are_apart(std::uint64_t data_end) const {
    std::vector<Place> places;
    for (const auto& segment : index_.segments) places.push_back({segment.offset, segment.bytes});
    for (const auto& entry : index_.attachments) places.push_back({entry.offset, entry.bytes});
    for (const auto& entry : index_.metadata) places.push_back({entry.offset, entry.bytes});
    std::sort(places.begin(), places.end(),
              [](const Place& a, const Place& b) { return a.offset < b.offset; });
    std::uint64_t free_from = kMagic.size();
    for (const Place& place : places) {
      if (place.offset < free_from || place.offset > data_end ||
          place.bytes > data_end - place.offset || place.bytes < kRecordHeadBytes) {
        return false;
      }
      free_from = place.offset + place.bytes;
    }
    return true;
  }

  FileIndex index_;
};

}  // namespace

core::Result<std::optional<FileIndex>> index_from_summary(
    const std::shared_ptr<const InputFile>& file, const ReadLimits& limits) {
  auto ending = read_ending(*file, limits);
  if (!ending.ok()) return ending.error();
  if (!*ending || (*ending)->footer.summary_start == 0) return std::optional<FileIndex>();
  std::string_view rest = (*ending)->summary();
  SummaryReader reader;
  while (!rest.empty()) {
    const auto record = first_record(rest);
    if (!record || !reader.enter(*record)) return std::optional<FileIndex>();
    rest.remove_prefix(record->total_bytes());
  }
  auto index = std::move(reader).finish((*ending)->footer.summary_start);
  if (!index) return std::optional<FileIndex>();
  FileWindow window(file);
  std::uint64_t header_end = 0;
  auto header = read_header(window, *file, limits, header_end);
  if (!header.ok()) return header.error();
  index->header = *header;
  return index;
}

core::Result<bool> has_intact_ending(const std::shared_ptr<const InputFile>& file,
                                     const ReadLimits& limits) {
  const auto ending = read_ending(*file, limits);
  if (!ending.ok()) return ending.error();
  return ending->has_value();
}

}  // namespace clew::bridge::mcap
