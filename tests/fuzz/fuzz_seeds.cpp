// SPDX-License-Identifier: Apache-2.0
/// Writes the small files that fuzzing begins with:
/// `fuzz_seeds MCAP_DIRECTORY RUN_DIRECTORY CODEC_DIRECTORY`.
#include <cstdio>
#include <fstream>
#include <string>

#include "core/check.hpp"
#include "random_messages.hpp"
#include "recording/mcap_writer.hpp"
#include "recording/run_recorder.hpp"
#include "wire/codec.hpp"

namespace clew::fuzz {
namespace {

using namespace bridge;
using namespace bridge::mcap;

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
  statistics.schema_count = statistics.channel_count = statistics.chunk_count = 1;
  statistics.message_start_time_ns = 3;
  statistics.message_end_time_ns = 5;
  append(bytes, statistics);
  append(bytes, index);
  append(bytes, Footer{summary_start, 0, 0});
  bytes += kMagic;
  std::ofstream(path, std::ios::binary) << bytes;
}

void write_run(const std::string& path, Compression compression) {
  RunDescription run;
  run.tick_s = 0.3;
  run.versions = {{"clew", "0.1.0"}};
  run.idl_fingerprint = "00112233445566778899aabbccddeeff";
  run.bundle = {{"graph.yaml", "world: w\n"}};
  run.schemas = {{domain::Topic::kCommand, "struct C {};"}, {domain::Topic::kScan, "struct S {};"}};
  run.compression = compression;
  auto recorder = RunRecorder::create(path, run, true);
  CLEW_CHECK(recorder.ok(), recorder.error().text());
  for (std::uint64_t tick = 0; tick < 6; ++tick) {
    const bool added = recorder->add(domain::Topic::kCommand, tick, tick, "command").ok() &&
                       recorder->add(domain::Topic::kScan, tick, tick, "scan").ok();
    CLEW_CHECK(added, "the seed cannot be written");
  }
  CLEW_CHECK(recorder->finish().ok(), "the seed cannot be written");
}

/// A message of each topic, behind the byte that codec_fuzz chooses the topic by.
void write_messages(const std::string& directory) {
  RandomMessages random(1);
  for (const domain::Topic topic : domain::kAllTopics) {
    domain::visit_topic(topic, [&](auto constant) {
      typename decltype(constant)::Message message;
      random.fill(message);
      std::vector<char> buffer;
      std::ofstream file(directory + '/' + std::string(domain::topic_name(topic)),
                         std::ios::binary);
      file << static_cast<char>(constant.kIndex) << encode(&message, buffer);
    });
  }
}

}  // namespace
}  // namespace clew::fuzz

int main(int argc, char** argv) {
  using namespace clew::fuzz;
  if (argc != 4) {
    std::fputs("usage: fuzz_seeds MCAP_DIRECTORY RUN_DIRECTORY CODEC_DIRECTORY\n", stderr);
    return 2;
  }
  for (const auto compression : kCompressions) {
    write_mcap(file_of(argv[1], "sample", compression), compression);
    write_run(file_of(argv[2], "run", compression), compression);
  }
  write_unprotected_mcap(std::string(argv[1]) + "/unprotected.mcap");
  write_messages(argv[3]);
  return 0;
}
