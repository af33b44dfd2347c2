// SPDX-License-Identifier: Apache-2.0
#include "recording/spill_buffer.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "recording/mcap_reader.hpp"
#include "recording/mcap_writer.hpp"
#include "scratch_directory.hpp"

namespace clew::recording_test {
namespace {

using namespace bridge::mcap;

std::string content(const SpillBuffer& buffer) {
  std::string bytes;
  const auto read = buffer.read([&bytes](std::string_view piece) {
    bytes += piece;
    return core::Result<void>();
  });
  EXPECT_TRUE(read.ok());
  return bytes;
}

TEST(SpillBuffer, GivesBackWhatItTookWithoutLeavingAFile) {
  const ScratchDirectory scratch;
  SpillBuffer buffer(scratch.file("neighbour"));
  std::string expected;

  // Four times what stays in memory, in pieces that do not divide it.
  for (int i = 0; expected.size() < 4 * SpillBuffer::kMemoryBytes; ++i) {
    const std::string piece(1 + static_cast<std::size_t>(i) % 997, static_cast<char>('a' + i % 26));
    ASSERT_TRUE(buffer.append(piece).ok());
    expected += piece;
    ASSERT_EQ(buffer.size(), expected.size());
  }

  EXPECT_EQ(content(buffer), expected);
  EXPECT_EQ(content(buffer), expected);
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
}

TEST(SpillBuffer, GoesElsewhereIfItsNeighboursDirectoryIsNotThere) {
  SpillBuffer buffer("/nowhere/at/all");
  const std::string bytes(SpillBuffer::kMemoryBytes + 1, 'x');

  ASSERT_TRUE(buffer.append(bytes).ok());

  EXPECT_EQ(content(buffer), bytes);
}

TEST(McapWriter, IndexesMoreChunksThanItKeepsInMemory) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("long.mcap");
  WriterOptions options;
  options.chunk_span_ns = 1;
  auto writer = McapWriter::create(path, false, options);
  ASSERT_TRUE(writer.ok());
  const auto channel = writer->add_channel(0, "/t", "");
  // A chunk's index takes 9 + 8 * 4 + 4 + 2 + 8 + 8 + 4 + 8 + 8 = 83 bytes: 5000 are more than fit.
  constexpr std::uint32_t kChunks = 5000;

  for (std::uint32_t i = 0; i < kChunks; ++i) {
    ASSERT_TRUE(writer->write(Message{channel, i, i, i, "x"}).ok());
  }
  ASSERT_TRUE(writer->finish().ok());
  const auto reader = McapReader::open(path);

  ASSERT_TRUE(reader.ok()) << reader.error().text();
  EXPECT_TRUE(reader->indexed());
  EXPECT_EQ(reader->segments().size(), kChunks);
  EXPECT_TRUE(reader->verify().ok());
}

}  // namespace
}  // namespace clew::recording_test
