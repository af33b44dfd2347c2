// SPDX-License-Identifier: Apache-2.0
#include "bench/line_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "../recording/scratch_directory.hpp"

namespace clew::bench {
namespace {

using recording_test::read_bytes;
using recording_test::ScratchDirectory;
using recording_test::write_bytes;

/// A line's number is its place; other lines have none.
core::Result<std::optional<std::size_t>> place_of(const std::string& line, int) {
  if (line.empty() || line[0] < '0' || line[0] > '9') return std::optional<std::size_t>();
  return std::optional<std::size_t>(std::stoul(line));
}

std::string sorted(const std::string& bytes, int header_lines) {
  const ScratchDirectory directory;
  const std::string path = directory.file("lines");
  write_bytes(path, bytes);
  EXPECT_TRUE(sort_lines(path, header_lines, place_of).ok());
  return read_bytes(path);
}

TEST(LineReader, TellsNumbersAndPlacesOfLines) {
  const ScratchDirectory directory;
  const std::string path = directory.file("lines");
  write_bytes(path, std::string("one\n\nth\0ree\ntorn", 16));
  auto reader = LineReader::open(path);
  ASSERT_TRUE(reader.ok());

  std::vector<std::string> lines;
  std::vector<std::uint64_t> offsets;
  while (const std::string* line = reader->next()) {
    lines.push_back(*line);
    offsets.push_back(reader->offset());
  }

  EXPECT_EQ(lines, (std::vector<std::string>{"one", "", std::string("th\0ree", 6)}));
  EXPECT_EQ(offsets, (std::vector<std::uint64_t>{0, 4, 5}));
  EXPECT_EQ(reader->number(), 3);
  EXPECT_TRUE(reader->is_whole().ok());
  EXPECT_FALSE(LineReader::open("/no/such/file").ok());
}

TEST(SortLines, PutsThemInOrderAfterTheHeader) {
  EXPECT_EQ(sorted("9 header\n3 c\n1 a\n2 b\n", 1), "9 header\n1 a\n2 b\n3 c\n");
  EXPECT_EQ(sorted("3 c\n1 a\n", 0), "1 a\n3 c\n");
  EXPECT_EQ(sorted("", 0), "");
}

TEST(SortLines, KeepsTheLastOfOnePlaceAndDropsWhatHasNone) {
  EXPECT_EQ(sorted("2 old\nx\n1 a\n2 new\n", 0), "1 a\n2 new\n");
  EXPECT_EQ(sorted("1 a\n2 b\nx\n", 0), "1 a\n2 b\n");
}

TEST(SortLines, LeavesAFileThatIsInOrderAsItIs) {
  const ScratchDirectory directory;
  const std::string path = directory.file("lines");
  write_bytes(path, "1 a\n2 b\n");
  const auto before = std::filesystem::last_write_time(path);

  EXPECT_TRUE(sort_lines(path, 0, place_of).ok());

  EXPECT_EQ(std::filesystem::last_write_time(path), before);
}

TEST(SortLines, LeavesAFileAsItIsIfALineHasNoReadablePlace) {
  const ScratchDirectory directory;
  const std::string path = directory.file("lines");
  write_bytes(path, "2 b\n1 a\n");

  const auto refused = sort_lines(
      path, 0, [](const std::string& line, int number) -> core::Result<std::optional<std::size_t>> {
        if (number == 2) return core::Error{"is odd: " + line, {}, number, 0};
        return std::optional<std::size_t>(0);
      });

  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "is odd: 1 a");
  EXPECT_EQ(read_bytes(path), "2 b\n1 a\n");
}

TEST(LineFile, DropsATornLineOnly) {
  const ScratchDirectory directory;
  const std::string path = directory.file("lines");
  write_bytes(path, "one\ntw");
  {
    auto file = LineFile::open(path);
    ASSERT_TRUE(file.ok()) << file.error().text();
    EXPECT_TRUE(file->append("three").ok());
    EXPECT_FALSE(LineFile::open(path).ok());
  }

  EXPECT_EQ(read_bytes(path), "one\nthree\n");
  EXPECT_TRUE(LineFile::open(path)->clear().ok());
  EXPECT_EQ(read_bytes(path), "");
}

TEST(NewFile, TakesTheOldOnesPlaceWhenItIsWhole) {
  const ScratchDirectory directory;
  const std::string path = directory.file("lines");
  write_bytes(path, "old");
  auto file = NewFile::open(path);
  ASSERT_TRUE(file.ok());
  ASSERT_TRUE(file->write("new").ok());
  EXPECT_EQ(read_bytes(path), "old");

  ASSERT_TRUE(file->finish().ok());

  EXPECT_EQ(read_bytes(path), "new");
}

TEST(NewFile, LeavesNothingBehindUnlessItIsFinished) {
  const ScratchDirectory directory;
  {
    auto file = NewFile::open(directory.file("lines"));
    ASSERT_TRUE(file.ok() && file->write("half").ok());
  }

  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

}  // namespace
}  // namespace clew::bench
