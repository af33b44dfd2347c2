// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "recording/input_file.hpp"
#include "recording/mcap_records.hpp"

namespace clew::bridge::mcap {

/// What a reader takes from a file that may be hostile.
struct ReadLimits {
  /// Of one record, and of one chunk's content.
  std::uint64_t record_bytes = std::uint64_t{256} << 20;
  /// Of the chunks that must be open together because their times overlap.
  std::uint64_t open_bytes = std::uint64_t{1} << 30;
};

/// What is wrong with a record; who reads the file adds its name.
inline core::Error damage(std::string what) { return {std::move(what)}; }

/// A part of the data section that holds messages: one chunk, or a run of records outside chunks.
struct Segment {
  bool chunk = true;
  std::uint64_t offset = 0;  ///< of its first record in the file
  std::uint64_t bytes = 0;
  std::uint64_t start_time_ns = 0;  ///< least log time; 0 without messages
  std::uint64_t end_time_ns = 0;    ///< greatest log time; 0 without messages
};

/// Where a file stops making sense.
struct Tear {
  std::uint64_t at_byte = 0;  ///< everything before it was read
  std::string reason;
  bool at_end = false;  ///< nothing is wrong but that the file ends here
};

/// The schemas and channels of a file. One id means one thing in the whole file.
class Declarations {
 public:
  /// False if the id was declared with other content.
  [[nodiscard]] bool add(Schema schema);
  [[nodiscard]] bool add(Channel channel);
  const std::map<std::uint16_t, Schema>& schemas() const { return schemas_; }
  const std::map<std::uint16_t, Channel>& channels() const { return channels_; }

 private:
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
};

/// What is where in a file: from its summary, or from a scan of all of it.
struct FileIndex {
  Header header;
  Declarations declarations;
  std::vector<Segment> segments;  ///< in the order of the file
  std::vector<AttachmentIndex> attachments;
  std::vector<MetadataIndex> metadata;
  std::optional<Statistics> statistics;  ///< if the file's summary has them
  bool from_summary = false;
  std::optional<Tear> tear;
};

/// The index that the summary at the file's end gives, if it is there, whole and consistent: CRC,
/// places inside the file and apart from each other, as many chunks as counted, and every channel
/// and schema known. Nothing otherwise: a scan will tell.
core::Result<std::optional<FileIndex>> index_from_summary(
    const std::shared_ptr<const InputFile>& file, const ReadLimits& limits);

/// Whether the file ends in a footer, with an intact summary if it names one.
core::Result<bool> has_intact_ending(const std::shared_ptr<const InputFile>& file,
                                     const ReadLimits& limits);

/// The index that reading all records from the front gives. The first record that is cut off or
/// broken ends it, and is reported as its tear. Refused: what does not begin as MCAP, and a data
/// section that differs from its CRC.
core::Result<FileIndex> index_from_scan(const std::shared_ptr<const InputFile>& file,
                                        const ReadLimits& limits);

/// The header of a file; refused is what does not begin as MCAP. `end` is where it ends.
core::Result<Header> read_header(FileWindow& window, const InputFile& file,
                                 const ReadLimits& limits, std::uint64_t& end);

}  // namespace clew::bridge::mcap
