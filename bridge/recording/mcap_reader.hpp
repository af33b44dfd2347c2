// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "recording/mcap_index.hpp"
#include "recording/mcap_records.hpp"
#include "recording/message_stream.hpp"

namespace clew::bridge::mcap {

/// Reads an MCAP file that may be cut off, damaged or hostile: by the index at its end if that is
/// whole, else by one pass from the front, which keeps every whole record and reports the rest.
///
/// What can be vouched for is what the format protects by CRCs: messages and declarations in
/// chunks, attachments, the summary. A changed byte there is an error where it is read. The header
/// and metadata have no CRC of their own; verify() covers them.
class McapReader {
 public:
  static core::Result<McapReader> open(const std::string& path, const ReadLimits& limits = {});

  const Header& header() const { return index_->header; }
  const std::map<std::uint16_t, Schema>& schemas() const { return index_->declarations.schemas(); }
  const std::map<std::uint16_t, Channel>& channels() const {
    return index_->declarations.channels();
  }
  const std::vector<Segment>& segments() const { return index_->segments; }
  const std::vector<AttachmentIndex>& attachments() const { return index_->attachments; }
  const std::vector<MetadataIndex>& metadata() const { return index_->metadata; }
  /// Counts, if the file's own index is in use.
  const std::optional<Statistics>& statistics() const { return index_->statistics; }
  bool indexed() const { return index_->from_summary; }
  /// Where the file stops making sense, if it does.
  const std::optional<Tear>& tear() const { return index_->tear; }

  /// `data` points into `buffer`.
  core::Result<Attachment> attachment(const AttachmentIndex& place, ByteBuffer& buffer) const;
  core::Result<Metadata> metadata(const MetadataIndex& place) const;

  /// The messages that pass the filter, in the given order. May outlive this reader; several at
  /// once do not disturb each other.
  MessageStream messages(Order order, MessageFilter filter = {}) const;

  /// Reads everything once: every CRC, the one of the whole data section included. An error is a
  /// changed byte; a tear is none.
  core::Result<void> verify() const;

 private:
  McapReader(std::shared_ptr<const InputFile> file, std::shared_ptr<const FileIndex> index,
             const ReadLimits& limits);

  std::shared_ptr<const InputFile> file_;
  std::shared_ptr<const FileIndex> index_;
  ReadLimits limits_;
};

}  // namespace clew::bridge::mcap
