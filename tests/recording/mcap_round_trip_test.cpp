// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "recording/mcap_reader.hpp"
#include "recording/mcap_writer.hpp"
#include "sample_file.hpp"
#include "scratch_directory.hpp"

namespace clew::recording_test {
namespace {

using namespace bridge::mcap;

constexpr std::size_t kMessages = 200;

class McapRoundTrip : public testing::TestWithParam<Compression> {
 protected:
  void SetUp() override { write_sample_file(path_, GetParam(), written_); }

  const ScratchDirectory scratch_;
  const std::string path_ = scratch_.file("sample.mcap");
  const std::vector<StoredMessage> written_ = sample_messages(kMessages);
};

TEST_P(McapRoundTrip, GivesBackEveryMessageInTheOrderOfTheFile) {
  const auto reader = McapReader::open(path_);
  ASSERT_TRUE(reader.ok()) << reader.error().text();

  const Content content = read_content(*reader, Order::kFile);

  EXPECT_TRUE(reader->indexed());
  EXPECT_GT(reader->segments().size(), 5U);
  EXPECT_EQ(content.messages, written_);
  EXPECT_EQ(content.errors, std::vector<std::string>());
  ASSERT_TRUE(reader->statistics());
  EXPECT_EQ(reader->statistics()->message_count, kMessages);
  EXPECT_EQ(reader->statistics()->channel_message_counts.at(1), kMessages / 2);
}

TEST_P(McapRoundTrip, GivesMessagesByTimeWithTiesInTheOrderOfTheFile) {
  const auto reader = McapReader::open(path_);
  ASSERT_TRUE(reader.ok()) << reader.error().text();
  std::vector<StoredMessage> expected = written_;
  std::stable_sort(expected.begin(), expected.end(),
                   [](const auto& a, const auto& b) { return a.log_time_ns < b.log_time_ns; });

  const Content content = read_content(*reader, Order::kLogTime);

  EXPECT_EQ(content.messages, expected);
}

TEST_P(McapRoundTrip, GivesOnlyWhatTheFilterPasses) {
  const auto reader = McapReader::open(path_);
  ASSERT_TRUE(reader.ok()) << reader.error().text();
  MessageFilter filter;
  filter.channels = std::set<std::uint16_t>{1};
  filter.first_ns = 2'000'000'000;
  filter.last_ns = 9'000'000'000;
  std::vector<StoredMessage> expected;
  for (const auto& message : written_) {
    if (message.channel_id == 1 && message.log_time_ns >= filter.first_ns &&
        message.log_time_ns <= filter.last_ns) {
      expected.push_back(message);
    }
  }

  const Content content = read_content(*reader, Order::kFile, filter);

  EXPECT_EQ(content.messages, expected);
}

TEST_P(McapRoundTrip, GivesAttachmentsMetadataSchemasAndChannels) {
  const auto reader = McapReader::open(path_);
  ASSERT_TRUE(reader.ok()) << reader.error().text();

  const Content content = read_content(*reader, Order::kFile);
  const auto facts = reader->metadata(reader->metadata().at(0));

  EXPECT_EQ(content.attachments, (std::vector<std::string>{"first=one", "second=two: 2\n"}));
  ASSERT_TRUE(facts.ok());
  EXPECT_EQ(facts->name, "facts");
  EXPECT_EQ(facts->entries, (StringMap{{"seed", "1"}}));
  EXPECT_EQ(reader->schemas().at(1).name, "clew::msg::Scan");
  EXPECT_EQ(reader->channels().at(0).metadata, (StringMap{{"key", "value"}}));
  EXPECT_EQ(reader->channels().at(1).schema_id, 0);
}

TEST_P(McapRoundTrip, IsTheSameBytesEveryTime) {
  const std::string again = scratch_.file("again.mcap");

  write_sample_file(again, GetParam(), written_);

  EXPECT_EQ(read_bytes(again), read_bytes(path_));
}

TEST_P(McapRoundTrip, IsVouchedForByVerify) {
  const auto reader = McapReader::open(path_);
  ASSERT_TRUE(reader.ok()) << reader.error().text();

  const auto verified = reader->verify();

  EXPECT_TRUE(verified.ok()) << verified.error().text();
}

INSTANTIATE_TEST_SUITE_P(Compressions, McapRoundTrip,
                         testing::Values(Compression::kNone, Compression::kZstd, Compression::kLz4),
                         [](const auto& instance) {
                           const auto name = compression_name(instance.param);
                           return name.empty() ? std::string("none") : std::string(name);
                         });

TEST(McapWriter, KeepsEachSecondInAChunkOfItsOwn) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("spans.mcap");
  WriterOptions options;
  options.chunk_span_ns = 1'000'000'000;
  auto writer = McapWriter::create(path, false, options);
  ASSERT_TRUE(writer.ok());
  const auto channel = writer->add_channel(0, "/t", "");

  // Ten messages of 0.3 s: 0-0.9 | 1.2-1.8 | 2.1-2.7
  for (std::uint32_t i = 0; i < 10; ++i) {
    ASSERT_TRUE(writer->write(Message{channel, i, i * 300'000'000ULL, 0, "x"}).ok());
  }
  ASSERT_TRUE(writer->finish().ok());

  const auto reader = McapReader::open(path);
  ASSERT_TRUE(reader.ok());
  ASSERT_EQ(reader->segments().size(), 3U);
  EXPECT_EQ(reader->segments()[0].end_time_ns, 900'000'000U);
  EXPECT_EQ(reader->segments()[1].start_time_ns, 1'200'000'000U);
  EXPECT_EQ(reader->segments()[2].start_time_ns, 2'100'000'000U);
}

TEST(McapWriter, GivesALargeMessageAChunkOfItsOwn) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("large.mcap");
  WriterOptions options;
  options.chunk_bytes = 1000;
  auto writer = McapWriter::create(path, false, options);
  ASSERT_TRUE(writer.ok());
  const auto channel = writer->add_channel(0, "/t", "");
  const std::string large(5000, 'x');

  ASSERT_TRUE(writer->write(Message{channel, 0, 0, 0, "small"}).ok());
  ASSERT_TRUE(writer->write(Message{channel, 1, 1, 1, large}).ok());
  ASSERT_TRUE(writer->write(Message{channel, 2, 2, 2, "small"}).ok());
  ASSERT_TRUE(writer->finish().ok());

  const auto reader = McapReader::open(path);
  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(reader->segments().size(), 3U);
  const Content content = read_content(*reader, Order::kFile);
  ASSERT_EQ(content.messages.size(), 3U);
  EXPECT_EQ(content.messages[1].data, large);
}

TEST(McapWriter, LeavesWhatItWroteReadableWhenItIsCutOff) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("cut.mcap");
  {
    auto writer = McapWriter::create(path, false, {});
    ASSERT_TRUE(writer.ok());
    const auto channel = writer->add_channel(0, "/t", "");
    ASSERT_TRUE(writer->write(Message{channel, 0, 0, 0, "kept"}).ok());
    ASSERT_TRUE(writer->flush().ok());
    ASSERT_TRUE(writer->write(Message{channel, 1, 1, 1, "lost with the open chunk"}).ok());
  }

  const auto reader = McapReader::open(path + ".tmp~");

  ASSERT_TRUE(reader.ok()) << reader.error().text();
  ASSERT_TRUE(reader->tear());
  EXPECT_EQ(reader->tear()->at_byte, read_bytes(path + ".tmp~").size());
  const Content content = read_content(*reader, Order::kFile);
  ASSERT_EQ(content.messages.size(), 1U);
  EXPECT_EQ(content.messages[0].data, "kept");
  EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
}  // namespace clew::recording_test
