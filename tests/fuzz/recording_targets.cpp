// SPDX-License-Identifier: Apache-2.0
/// Whatever the bytes: McapReader refuses them, or gives messages that keep its promises, and
/// RunRecording refuses them, or gives samples of its topics.
#include <stdlib.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "fuzzed_file.hpp"
#include "recording/mcap_reader.hpp"
#include "recording/mcap_writer.hpp"
#include "recording/run_recorder.hpp"
#include "recording/run_recording.hpp"
#include "target.hpp"
#include "wire/codec.hpp"

namespace clew::fuzz {
namespace {

using namespace bridge;
using namespace bridge::mcap;

// Small, so that a file which announces much is met by these limits and not by the machine's.
constexpr std::uint64_t kMostBytes = 1 << 22;

/// Counts the messages, none if one cannot be read; log times must not go back where order by time
/// was asked for.
std::optional<std::uint64_t> read_messages(const McapReader& reader, Order order) {
  auto stream = reader.messages(order);
  std::uint64_t count = 0;
  std::uint64_t last_ns = 0;
  while (true) {
    const auto message = stream.next();
    if (!message.ok()) return std::nullopt;
    if (!*message) return count;
    CLEW_CHECK(reader.channels().count((*message)->channel_id) == 1, "a channel that is not there");
    CLEW_CHECK(order == Order::kFile || (*message)->log_time_ns >= last_ns, "time goes back");
    last_ns = (*message)->log_time_ns;
    ++count;
  }
}

void read_mcap_file(const std::string& path) {
  ReadLimits limits;
  limits.record_bytes = kMostBytes;
  limits.open_bytes = kMostBytes;
  const auto reader = McapReader::open(path, limits);
  if (!is_good(reader)) return;
  const auto as_written = read_messages(*reader, Order::kFile);
  const auto by_time = read_messages(*reader, Order::kLogTime);
  CLEW_CHECK(!as_written || !by_time || *as_written == *by_time, "an order loses messages");
  ByteBuffer buffer;
  for (const AttachmentIndex& place : reader->attachments()) {
    if (const auto found = reader->attachment(place, buffer); !found.ok()) continue;
  }
  for (const MetadataIndex& place : reader->metadata()) {
    if (const auto found = reader->metadata(place); !found.ok()) continue;
  }
  static_cast<void>(is_good(reader->verify()));
}

void read_run_file(const std::string& path) {
  const auto recording = RunRecording::open(path);
  if (!is_good(recording)) return;
  CLEW_CHECK(recording->description().tick_s > 0.0, "ticks that take no time");
  auto todays = recording->samples();
  for (auto sample = todays.next(); sample.ok() && *sample; sample = todays.next()) {
    CLEW_CHECK((*sample)->cdr.size() < 1U << 28U, "a sample of any size");
  }
  auto stream = recording->raw_samples();
  std::uint64_t count = 0;
  for (auto sample = stream.next(); sample.ok() && *sample; sample = stream.next()) {
    CLEW_CHECK(recording->description().schemas.count((*sample)->topic) == 1, "an unknown topic");
    ++count;
  }
  const auto survey = recording->survey();
  if (!survey.ok()) return;
  std::uint64_t surveyed = 0;
  for (const auto& [topic, found] : survey->topics) surveyed += found.samples;
  CLEW_CHECK(surveyed == count, "a survey of other samples");
  CLEW_CHECK(!recording->end() || recording->end()->hash == survey->hash, "another run's hash");
}

void read_mcap(std::string_view bytes) {
  const FuzzedFile file(bytes);
  read_mcap_file(file.path());
}

void read_run(std::string_view bytes) {
  const FuzzedFile file(bytes);
  read_run_file(file.path());
}

constexpr Compression kCompressions[] = {Compression::kNone, Compression::kZstd, Compression::kLz4};

std::string file_of(const std::string& directory, const std::string& kind,
                    Compression compression) {
  const auto name = compression_name(compression);
  return directory + '/' + kind + (name.empty() ? "" : "-" + std::string(name)) + ".mcap";
}

/// Some of everything, in small chunks.
void write_mcap(const std::string& path, Compression compression) {
  WriterOptions options;
  options.compression = compression;
  options.chunk_bytes = 200;
  auto writer = McapWriter::create(path, true, options);
  CLEW_CHECK(writer.ok(), writer.error().text());
  const auto schema = writer->add_schema("clew::msg::Scan", "omgidl", "struct Scan {};");
  const auto scan = writer->add_channel(schema, "/scan", "cdr", {{"key", "value"}});
  const auto raw = writer->add_channel(0, "/raw", "");
  for (std::uint32_t i = 0; i < 12; ++i) {
    const std::uint64_t time_ns = (i % 3 == 1 ? i + 1 : i) * std::uint64_t{1000};
    const std::string data(i * 7, 'x');
    const auto written = writer->write(Message{i % 2 == 0 ? scan : raw, i, time_ns, time_ns, data});
    CLEW_CHECK(written.ok(), "the seed cannot be written");
  }
  const bool ended = writer->write(Attachment{0, 0, "a", "text/plain", "one"}).ok() &&
                     writer->write(Metadata{"m", {{"seed", "1"}}}).ok() && writer->finish().ok();
  CLEW_CHECK(ended, "the seed cannot be written");
}

/// Without a single CRC, so that no change is met by one.
void write_unprotected_mcap(const std::string& path) {
  std::string records;
  append(records, Schema{1, "S", "omgidl", "struct S {};"});
  append(records, Channel{0, 1, "/t", "cdr", {}});
  append(records, Message{0, 0, 5, 5, "first"});
  append(records, Message{0, 1, 3, 3, "second"});
  std::string bytes(kMagic);
  append(bytes, Header{"", "seed"});
  ChunkIndex index{3, 5, bytes.size(), 0, {}, 0, "", records.size(), records.size()};
  Chunk chunk{3, 5, records.size(), 0, "", records};
  append(bytes, chunk);
  index.chunk_bytes = bytes.size() - index.chunk_offset;
  append(bytes, DataEnd{});
  const std::uint64_t summary_start = bytes.size();
  append(bytes, Schema{1, "S", "omgidl", "struct S {};"});
  append(bytes, Channel{0, 1, "/t", "cdr", {}});
  Statistics statistics;
  statistics.message_count = 2;
  statistics.schema_count = 1;
  statistics.channel_count = 1;
  statistics.chunk_count = 1;
  statistics.message_start_time_ns = 3;
  statistics.message_end_time_ns = 5;
  append(bytes, statistics);
  append(bytes, index);
  append(bytes, Footer{summary_start, 0, 0});
  bytes += kMagic;
  std::ofstream(path, std::ios::binary) << bytes;
}

/// A text of one letter and a list of one number.
std::string older_scan() {
  std::string bytes("\0\1\0\0\2\0\0\0a\0\0\0\1\0\0\0\0\0\0\0", 20);
  return bytes.append(4, '\0').append(8, '\0');
}

void write_run(const std::string& path, Compression compression) {
  RunDescription run;
  run.tick_s = 0.3;
  run.versions = {{"clew", "0.1.0"}};
  run.idl_fingerprint = "00112233445566778899aabbccddeeff";
  run.bundle = {{"graph.yaml", "world: w\n"}};
  // Of today, and of another version.
  run.schemas = {{domain::Topic::kCommand, std::string(idl_text(domain::Topic::kCommand))},
                 {domain::Topic::kScan,
                  "@final struct Scan { string<9> gone; sequence<double, 8> ranges_m; };"}};
  run.compression = compression;
  auto recorder = RunRecorder::create(path, run, true);
  CLEW_CHECK(recorder.ok(), recorder.error().text());
  for (std::uint64_t tick = 0; tick < 6; ++tick) {
    const bool added = recorder->add(domain::Topic::kCommand, tick, tick, "command").ok() &&
                       recorder->add(domain::Topic::kScan, tick, tick, older_scan()).ok();
    CLEW_CHECK(added, "the seed cannot be written");
  }
  CLEW_CHECK(recorder->finish().ok(), "the seed cannot be written");
}

/// The bytes of the files that `write` makes in a folder of its own.
template <typename Write>
Seeds written(const Write& write) {
  std::string folder = (std::filesystem::temp_directory_path() / "clew-seeds-XXXXXX").string();
  CLEW_CHECK(::mkdtemp(folder.data()) != nullptr, "no folder can be made");
  write(folder);
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  Seeds seeds;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  std::filesystem::remove_all(folder);
  return seeds;
}

Seeds mcap_files() {
  return written([](const std::string& folder) {
    for (const auto compression : kCompressions) {
      write_mcap(file_of(folder, "sample", compression), compression);
    }
    write_unprotected_mcap(folder + "/unprotected.mcap");
  });
}

Seeds run_files() {
  return written([](const std::string& folder) {
    for (const auto compression : kCompressions) {
      write_run(file_of(folder, "run", compression), compression);
    }
  });
}

}  // namespace

std::vector<Target> recording_targets() {
  return {{"mcap", read_mcap, mcap_files}, {"run_recording", read_run, run_files}};
}

}  // namespace clew::fuzz
