// SPDX-License-Identifier: Apache-2.0
#include "bench/compressed_lines.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "../recording/scratch_directory.hpp"
#include "bench/line_file.hpp"

namespace clew::bench {
namespace {

using recording_test::read_bytes;
using recording_test::ScratchDirectory;
using recording_test::write_bytes;

/// 200,000 lines, more than one buffer of either side.
std::string many_lines() {
  std::string text;
  for (int i = 0; i < 200000; ++i) text += "line " + std::to_string(i) + '\n';
  return text;
}

std::size_t count_lines(LineReader& reader) {
  std::size_t count = 0;
  while (reader.next() != nullptr) ++count;
  return count;
}

TEST(CompressedLines, TakeThePlaceOfTheFileAndGiveItBack) {
  for (const std::string& text : {many_lines(), std::string("one\n"), std::string()}) {
    const ScratchDirectory directory;
    const std::string path = directory.file("lines");
    write_bytes(path, text);

    ASSERT_TRUE(compress_file(path).ok());
    EXPECT_FALSE(std::filesystem::exists(path));
    ASSERT_TRUE(expand_file(path).ok());

    EXPECT_FALSE(std::filesystem::exists(path + ".zst"));
    EXPECT_EQ(read_bytes(path), text);
  }
}

TEST(CompressedLines, AreReadLikeThePlainFile) {
  const ScratchDirectory directory;
  const std::string path = directory.file("lines");
  write_bytes(path, many_lines());
  ASSERT_TRUE(compress_file(path).ok());
  EXPECT_LT(std::filesystem::file_size(path + ".zst"), many_lines().size() / 5);

  auto reader = LineReader::open(path);

  ASSERT_TRUE(reader.ok());
  EXPECT_EQ(*reader->next(), "line 0");
  EXPECT_EQ(count_lines(*reader), 199999u);
  EXPECT_TRUE(reader->is_whole().ok());
}

TEST(CompressedLines, SayThatTheyAreDamaged) {
  const ScratchDirectory directory;
  const std::string path = directory.file("lines");
  write_bytes(path, many_lines());
  ASSERT_TRUE(compress_file(path).ok());
  const std::string whole = read_bytes(path + ".zst");
  std::string flipped = whole;
  flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 1);

  for (const std::string& bytes :
       {whole.substr(0, whole.size() / 2), flipped, std::string("no zstd at all")}) {
    write_bytes(path + ".zst", bytes);
    auto reader = LineReader::open(path);
    ASSERT_TRUE(reader.ok());
    count_lines(*reader);

    const auto is_whole = reader->is_whole();
    ASSERT_FALSE(is_whole.ok());
    EXPECT_NE(is_whole.error().text().find("lines.zst: is damaged: "), std::string::npos);
    EXPECT_FALSE(expand_file(path).ok());
    EXPECT_FALSE(std::filesystem::exists(path));
  }
}

TEST(CompressedLines, NeedAFile) {
  EXPECT_FALSE(compress_file("/no/such/file").ok());
  EXPECT_FALSE(expand_file("/no/such/file").ok());
}

}  // namespace
}  // namespace clew::bench
