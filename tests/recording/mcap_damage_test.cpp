// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "recording/mcap_reader.hpp"
#include "recording/mcap_writer.hpp"
#include "sample_file.hpp"
#include "scratch_directory.hpp"

namespace clew::recording_test {
namespace {

using namespace bridge::mcap;

class McapDamage : public testing::TestWithParam<Compression> {
 protected:
  void write(std::size_t messages) {
    written_ = sample_messages(messages);
    write_sample_file(path_, GetParam(), written_);
    bytes_ = read_bytes(path_);
  }

  /// With one bit flipped, the file gives a prefix of what was written or says that it is damaged;
  /// verify(), which reads every byte under some CRC, always does.
  void expect_noticed(std::uint64_t bit) {
    std::string damaged = bytes_;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    write_bytes(path_, damaged);
    const auto reader = McapReader::open(path_);
    if (!reader.ok()) return;
    const Content content = read_content(*reader, Order::kFile);
    ASSERT_TRUE(is_prefix(content.messages, written_)) << "bit " << bit;
    const bool all = content.messages.size() == written_.size() && content.attachments == attached_;
    ASSERT_TRUE(all || !content.errors.empty() || reader->tear()) << "bit " << bit;
    EXPECT_TRUE(reader->tear() || !reader->verify().ok()) << "bit " << bit;
  }

  const ScratchDirectory scratch_;
  const std::string path_ = scratch_.file("sample.mcap");
  std::vector<StoredMessage> written_;
  const std::vector<std::string> attached_ = {"first=one", "second=two: 2\n"};
  std::string bytes_;
};

TEST_P(McapDamage, GivesThePrefixBeforeATearAtAnyByte) {
  write(40);
  std::size_t readable_before = 0;

  for (std::size_t kept_bytes = 0; kept_bytes < bytes_.size(); ++kept_bytes) {
    write_bytes(path_, std::string_view(bytes_).substr(0, kept_bytes));
    const auto reader = McapReader::open(path_);
    if (!reader.ok()) {
      // Only what ends in the header cannot be opened: magic (8), opcode and length (9), profile
      // (4), library "test" (8).
      EXPECT_LT(kept_bytes, 8U + 9U + 4U + 8U);
      EXPECT_NE(reader.error().message, "");
      continue;
    }
    ASSERT_TRUE(reader->tear()) << kept_bytes;
    EXPECT_LE(reader->tear()->at_byte, kept_bytes);
    const Content content = read_content(*reader, Order::kFile);
    ASSERT_TRUE(content.errors.empty()) << kept_bytes << ": " << content.errors[0];
    ASSERT_TRUE(is_prefix(content.messages, written_)) << kept_bytes;
    ASSERT_TRUE(is_prefix(content.attachments, attached_)) << kept_bytes;
    ASSERT_GE(content.messages.size(), readable_before) << kept_bytes;
    readable_before = content.messages.size();
  }

  EXPECT_EQ(readable_before, written_.size());
}

TEST_P(McapDamage, NeverGivesWrongDataForOneFlippedBit) {
  write(400);
  // All three compressions together: 3,000 places, and 30,000 for tools/soak.
  const std::uint32_t flips = std::getenv("CLEW_SOAK") != nullptr ? 10'000 : 1'000;
  const core::Random random({20240607, 0, static_cast<std::uint32_t>(GetParam()), 0});

  for (std::uint32_t flip = 0; flip < flips; ++flip) {
    expect_noticed(random.bits(flip) % (8 * bytes_.size()));
  }
}

TEST_P(McapDamage, NoticesEveryFlippedBitOfTheRecordThatEndsTheData) {
  write(40);
  std::string end;
  append(end, DataEnd{});
  // Opcode and length; its CRC is that of the data.
  const std::size_t place = bytes_.find(end.substr(0, kRecordHeadBytes));
  ASSERT_NE(place, std::string::npos);

  for (std::size_t bit = 0; bit < 8 * end.size(); ++bit) expect_noticed(8 * place + bit);
}

INSTANTIATE_TEST_SUITE_P(Compressions, McapDamage,
                         testing::Values(Compression::kNone, Compression::kZstd, Compression::kLz4),
                         [](const auto& instance) {
                           const auto name = compression_name(instance.param);
                           return name.empty() ? std::string("none") : std::string(name);
                         });

/// Magic and a header, then `records`.
std::string file_of(std::string_view records) {
  std::string bytes(kMagic);
  append(bytes, Header{"", "test"});
  bytes += records;
  return bytes;
}

/// The tear that reading a file of these records reports.
std::string tear_of(std::string_view records) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("hostile.mcap");
  write_bytes(path, file_of(records));
  const auto reader = McapReader::open(path);
  if (!reader.ok()) return "refused: " + reader.error().message;
  return reader->tear() ? reader->tear()->reason : "accepted";
}

std::string chunk_record(std::string_view compression, std::uint64_t uncompressed_bytes,
                         std::string_view records) {
  Chunk chunk;
  chunk.compression = compression;
  chunk.uncompressed_bytes = uncompressed_bytes;
  chunk.records = records;
  std::string out;
  append(out, chunk);
  return out;
}

/// A file of one chunk with one message, whose summary declares channel 0 and names the chunk
/// `times` times.
std::string indexed_file(const std::string& chunk, std::uint32_t times) {
  const std::uint64_t chunk_offset = file_of("").size();
  std::string bytes = file_of(chunk);
  append(bytes, DataEnd{});
  const std::uint64_t summary_start = bytes.size();
  append(bytes, Channel{0, 0, "/t", "", {}});
  Statistics statistics;
  statistics.message_count = times;
  statistics.channel_count = 1;
  statistics.chunk_count = times;
  append(bytes, statistics);
  ChunkIndex index;
  index.chunk_offset = chunk_offset;
  index.chunk_bytes = chunk.size();
  for (std::uint32_t i = 0; i < times; ++i) append(bytes, index);
  append(bytes, Footer{summary_start, 0, 0});
  return bytes + std::string(kMagic);
}

TEST(McapHostile, RefusesALengthBeyondTheEnd) {
  // A message record of 2^63 bytes.
  const std::string head("\x05\0\0\0\0\0\0\0\x80", 9);

  EXPECT_EQ(tear_of(head + "abc"), "a record is cut off");
}

TEST(McapHostile, RefusesAChunkThatSaysItIsHuge) {
  const std::string huge = chunk_record("zstd", std::uint64_t{1} << 60, "x");

  EXPECT_EQ(tear_of(huge), "a chunk of 1152921504606846976 bytes; at most 268435456 are read");
}

TEST(McapHostile, RefusesAChunkThatUnpacksToMoreThanItSays) {
  std::string packed;
  compress(Compression::kZstd, std::string(100'000, 'x'), packed);
  const std::string zstd_bomb = chunk_record("zstd", 10, packed);
  compress(Compression::kLz4, std::string(100'000, 'x'), packed);
  const std::string lz4_bomb = chunk_record("lz4", 10, packed);

  EXPECT_EQ(tear_of(zstd_bomb), "zstd data cannot be unpacked: Destination buffer is too small");
  EXPECT_EQ(tear_of(lz4_bomb),
            "lz4 data cannot be unpacked: it does not hold the 10 bytes that were announced");
}

TEST(McapHostile, RefusesAnUnknownCompression) {
  EXPECT_EQ(tear_of(chunk_record("none", 1, "x")),
            "a chunk with compression 'none'; known are '', 'zstd' and 'lz4'");
}

TEST(McapHostile, RefusesAMessageOfAnUndeclaredChannel) {
  std::string message;
  append(message, Message{3, 0, 0, 0, "x"});

  EXPECT_EQ(tear_of(message), "a message of channel 3, which no record before it declares");
}

TEST(McapHostile, RefusesAChannelThatChanges) {
  std::string records;
  append(records, Channel{1, 0, "/a", "", {}});
  append(records, Channel{1, 0, "/b", "", {}});

  EXPECT_EQ(tear_of(records), "channel 1 is declared twice, differently");
}

TEST(McapHostile, RefusesZerosAtTheEnd) {
  EXPECT_EQ(tear_of(std::string(100, '\0')), "a record of kind 0");
}

TEST(McapHostile, RefusesWhatIsNoMcap) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("no.mcap");
  write_bytes(path, "This is a text of more than seventeen bytes.");

  const auto reader = McapReader::open(path);

  ASSERT_FALSE(reader.ok());
  EXPECT_EQ(reader.error().text(), path + ": is not an MCAP file");
}

TEST(McapHostile, RefusesAFileThatDoesNotExist) {
  const auto reader = McapReader::open("/nowhere/no.mcap");

  ASSERT_FALSE(reader.ok());
  EXPECT_EQ(reader.error().text(), "/nowhere/no.mcap: cannot be read: No such file or directory");
}

TEST(McapHostile, DoesNotFollowAnIndexThatReadsOneChunkManyTimes) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("again.mcap");
  std::string inner;
  append(inner, Channel{0, 0, "/t", "", {}});
  append(inner, Message{0, 0, 0, 0, "x"});
  write_bytes(path, indexed_file(chunk_record("", inner.size(), inner), 1000));

  const auto reader = McapReader::open(path);

  ASSERT_TRUE(reader.ok()) << reader.error().text();
  EXPECT_FALSE(reader->indexed());
  EXPECT_EQ(read_content(*reader, Order::kFile).messages.size(), 1U);
}

TEST(McapHostile, RefusesAChannelThatTheSummaryDoesNotDeclare) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("other-channel.mcap");
  std::string inner;
  append(inner, Channel{7, 0, "/t", "", {}});
  append(inner, Message{7, 0, 0, 0, "x"});
  write_bytes(path, indexed_file(chunk_record("", inner.size(), inner), 1));

  const auto reader = McapReader::open(path);
  ASSERT_TRUE(reader.ok()) << reader.error().text();
  const Content content = read_content(*reader, Order::kFile);

  EXPECT_TRUE(reader->indexed());
  EXPECT_TRUE(content.messages.empty());
  ASSERT_EQ(content.errors.size(), 1U);
  // The chunk comes right after the header.
  EXPECT_EQ(content.errors[0], path + ": is damaged at byte " + std::to_string(file_of("").size()) +
                                   ": a chunk declares a channel that the file's summary does not");
}

TEST(McapHostile, BoundsTheChunksThatOverlapInTime) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("overlap.mcap");
  WriterOptions options;
  options.chunk_bytes = 1;
  auto writer = McapWriter::create(path, false, options);
  ASSERT_TRUE(writer.ok());
  const auto channel = writer->add_channel(0, "/t", "");
  for (std::uint32_t i = 0; i < 100; ++i) {
    ASSERT_TRUE(writer->write(Message{channel, i, 5, 5, std::string(1000, 'x')}).ok());
  }
  ASSERT_TRUE(writer->finish().ok());
  ReadLimits limits;
  limits.open_bytes = 20'000;

  const auto reader = McapReader::open(path, limits);
  ASSERT_TRUE(reader.ok()) << reader.error().text();
  const Content by_time = read_content(*reader, Order::kLogTime);
  const Content as_written = read_content(*reader, Order::kFile);

  ASSERT_EQ(by_time.errors.size(), 1U);
  EXPECT_EQ(by_time.errors[0],
            path + ": has chunks of which more than 20000 bytes overlap in time");
  EXPECT_EQ(as_written.messages.size(), 100U);
}

TEST(McapReader, PassesOverUnknownRecordsAndBytesAtTheEndOfKnownOnes) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("later.mcap");
  // A record of a later version, and a channel with a field of a later version: 4 bytes more.
  std::string records("\x7F\x02\0\0\0\0\0\0\0ab", 11);
  std::string channel;
  append(channel, Channel{0, 0, "/t", "", {}});
  channel[1] = static_cast<char>(channel[1] + 4);
  records += channel + "more";
  append(records, Message{0, 1, 2, 3, "x"});
  append(records, DataEnd{});
  append(records, Footer{});
  write_bytes(path, file_of(records) + std::string(kMagic));

  const auto reader = McapReader::open(path);

  ASSERT_TRUE(reader.ok()) << reader.error().text();
  EXPECT_FALSE(reader->tear()) << reader->tear()->reason;
  EXPECT_EQ(read_content(*reader, Order::kFile).messages,
            (std::vector<StoredMessage>{{0, 1, 2, 3, "x"}}));
}

}  // namespace
}  // namespace clew::recording_test
