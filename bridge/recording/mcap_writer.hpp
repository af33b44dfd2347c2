// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "recording/chunk_builder.hpp"
#include "recording/compression.hpp"
#include "recording/mcap_records.hpp"
#include "recording/output_file.hpp"
#include "recording/spill_buffer.hpp"

namespace clew::bridge::mcap {

struct WriterOptions {
  std::string profile;
  std::string library;
  Compression compression = Compression::kNone;
  /// A chunk is closed before it grows beyond this; a larger message has a chunk of its own.
  std::uint64_t chunk_bytes = 1 << 20;
  /// A chunk holds only messages whose log times lie in the same interval [i, i + 1) * this;
  /// 0: any.
  std::uint64_t chunk_span_ns = 0;
};

/// Writes an MCAP file: chunked, indexed, with every CRC the format has. The same calls give the
/// same bytes. Every error is one of the file's (OutputFile), and stays: later calls give it again.
class McapWriter {
 public:
  static core::Result<McapWriter> create(const std::string& path, bool overwrite,
                                         WriterOptions options);
  /// Writes into `file`, from its beginning.
  static core::Result<McapWriter> create(OutputFile file, WriterOptions options);

  /// Declares a schema and returns its id, from 1.
  std::uint16_t add_schema(std::string name, std::string encoding, std::string data);
  /// Declares a channel and returns its id, from 0. `schema_id` is one that was returned, or 0.
  std::uint16_t add_channel(std::uint16_t schema_id, std::string topic,
                            std::string message_encoding, StringMap metadata = {});

  /// Adds a message of a channel that was declared; it reaches the file with its chunk.
  core::Result<void> write(const Message& message);
  /// These stand between chunks: they close the open one.
  core::Result<void> write(const Attachment& attachment);
  core::Result<void> write(const Metadata& metadata);

  /// Closes the open chunk, if there is anything in it, and hands it to the operating system.
  core::Result<void> flush();

  /// Leaves the open chunk in the file as it is now, in case of a crash; the file is the same once
  /// the chunk is closed.
  core::Result<void> write_ahead();
  /// Chunks closed so far.
  std::uint64_t chunk_count() const { return statistics_.chunk_count; }
  /// Of the file so far, with what is in the open chunk, not compressed.
  std::uint64_t size_bytes() const { return file_.position() + chunk_.size_bytes(); }
  /// OutputFile::keep.
  void keep(bool keep) { file_.keep(keep); }
  /// Writes what the file held back. OutputFile::hold().
  core::Result<void> release() { return file_.release(); }

  /// Closes the chunk, writes the summary and closes the file, which keeps its temporary name.
  /// Nothing may follow.
  core::Result<void> seal();
  /// The same, and gives the file its name: OutputFile::give_name().
  core::Result<void> finish(bool overwrite = true);
  /// OutputFile::share_lock().
  core::Result<FileLock> share_lock() const { return file_.share_lock(); }

 private:
  McapWriter(OutputFile file, WriterOptions options);
  core::Result<void> append_to_data_section(std::string_view bytes);
  core::Result<void> append_ending();
  bool belongs_to_next_chunk(const Message& message) const;
  core::Result<void> append_to_summary(std::string_view bytes);

  OutputFile file_;
  WriterOptions options_;
  std::uint32_t data_section_crc_ = 0;
  std::uint32_t summary_crc_ = 0;
  ChunkBuilder chunk_;
  std::string record_;  ///< of the moment, kept for its memory

  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  Statistics statistics_;
  SpillBuffer chunk_indexes_;  ///< encoded
  std::vector<AttachmentIndex> attachment_indexes_;
  std::vector<MetadataIndex> metadata_indexes_;
};

}  // namespace clew::bridge::mcap
