// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "recording/mcap_reader.hpp"
#include "recording/mcap_writer.hpp"
#include "scratch_directory.hpp"

namespace clew::recording_test {
namespace {

using namespace bridge::mcap;

/// A file of one schema, one channel and one message, put together field by field from the
/// specification; its four CRCs come from another implementation (Python's zlib.crc32).
constexpr char kOneMessage[] =
    // clang-format off
"89 4d 43 41 50 30 0d 0a"  // magic
"01 09 00 00 00 00 00 00 00"  // Header
"  00 00 00 00"  // profile ""
"  01 00 00 00 4c"  // library "L"
"06 86 00 00 00 00 00 00 00"  // Chunk
"  0a 00 00 00 00 00 00 00"  // start time 10
"  0a 00 00 00 00 00 00 00"  // end time 10
"  5e 00 00 00 00 00 00 00"  // uncompressed size 94
"  fa fd 11 c9"  // uncompressed CRC
"  00 00 00 00"  // compression ""
"  5e 00 00 00 00 00 00 00"  // records, 94 bytes
  "03 16 00 00 00 00 00 00 00"  // Schema
  "  01 00"  // id 1
  "  01 00 00 00 54"  // name "T"
  "  06 00 00 00 6f 6d 67 69 64 6c"  // encoding "omgidl"
  "  01 00 00 00 49"  // data "I"
  "04 15 00 00 00 00 00 00 00"  // Channel
  "  00 00"  // id 0
  "  01 00"  // schema 1
  "  02 00 00 00 2f 74"  // topic "/t"
  "  03 00 00 00 63 64 72"  // message encoding "cdr"
  "  00 00 00 00"  // metadata: none
  "05 18 00 00 00 00 00 00 00"  // Message
  "  00 00"  // channel 0
  "  07 00 00 00"  // sequence 7
  "  0a 00 00 00 00 00 00 00"  // log time 10
  "  0b 00 00 00 00 00 00 00"  // publish time 11
  "  ab cd"  // data
"07 16 00 00 00 00 00 00 00"  // MessageIndex
"  00 00"  // channel 0
"  10 00 00 00"  // 16 bytes of entries
"  0a 00 00 00 00 00 00 00"  // log time 10
"  3d 00 00 00 00 00 00 00"  // offset 61
"0f 04 00 00 00 00 00 00 00"  // DataEnd
"  96 e8 77 3e"  // CRC of all before
"03 16 00 00 00 00 00 00 00"  // Schema (again)
"  01 00"  // id 1
"  01 00 00 00 54"  // name "T"
"  06 00 00 00 6f 6d 67 69 64 6c"  // encoding "omgidl"
"  01 00 00 00 49"  // data "I"
"04 15 00 00 00 00 00 00 00"  // Channel (again)
"  00 00"  // id 0
"  01 00"  // schema 1
"  02 00 00 00 2f 74"  // topic "/t"
"  03 00 00 00 63 64 72"  // message encoding "cdr"
"  00 00 00 00"  // metadata: none
"0b 38 00 00 00 00 00 00 00"  // Statistics
"  01 00 00 00 00 00 00 00"  // 1 message
"  01 00"  // 1 schema
"  01 00 00 00"  // 1 channel
"  00 00 00 00"  // 0 attachments
"  00 00 00 00"  // 0 metadata
"  01 00 00 00"  // 1 chunk
"  0a 00 00 00 00 00 00 00"  // start time 10
"  0a 00 00 00 00 00 00 00"  // end time 10
"  0a 00 00 00 00 00 01 00 00 00 00 00 00 00"  // channel 0 has 1 message
"08 4a 00 00 00 00 00 00 00"  // ChunkIndex
"  0a 00 00 00 00 00 00 00"  // start time 10
"  0a 00 00 00 00 00 00 00"  // end time 10
"  1a 00 00 00 00 00 00 00"  // chunk at 26
"  8f 00 00 00 00 00 00 00"  // chunk of 143 bytes
"  0a 00 00 00 00 00 a9 00 00 00 00 00 00 00"  // index of channel 0 at 169
"  1f 00 00 00 00 00 00 00"  // indexes of 31 bytes
"  00 00 00 00"  // compression ""
"  5e 00 00 00 00 00 00 00"  // compressed size
"  5e 00 00 00 00 00 00 00"  // uncompressed size
"0e 11 00 00 00 00 00 00 00"  // SummaryOffset
"  03"  // of schemas
"  d5 00 00 00 00 00 00 00"  // at 213
"  1f 00 00 00 00 00 00 00"  // 31 bytes
"0e 11 00 00 00 00 00 00 00"  // SummaryOffset
"  04"  // of channels
"  f4 00 00 00 00 00 00 00"  // at 244
"  1e 00 00 00 00 00 00 00"  // 30 bytes
"0e 11 00 00 00 00 00 00 00"  // SummaryOffset
"  0b"  // of statistics
"  12 01 00 00 00 00 00 00"  // at 274
"  41 00 00 00 00 00 00 00"  // 65 bytes
"0e 11 00 00 00 00 00 00 00"  // SummaryOffset
"  08"  // of chunk indexes
"  53 01 00 00 00 00 00 00"  // at 339
"  53 00 00 00 00 00 00 00"  // 83 bytes
"02 14 00 00 00 00 00 00 00"  // Footer
"  d5 00 00 00 00 00 00 00"  // summary at 213
"  a6 01 00 00 00 00 00 00"  // summary offsets at 422
"  40 57 32 96"  // CRC from the summary to here
"89 4d 43 41 50 30 0d 0a";  // magic
// clang-format on

std::string bytes_of(const char* hexadecimal) {
  std::istringstream in(hexadecimal);
  std::string bytes;
  std::string digits;
  // Two digits at a time; between string literals there may be no space.
  for (char c; in >> c;) {
    digits += c;
    if (digits.size() == 2) {
      bytes += static_cast<char>(std::stoi(digits, nullptr, 16));
      digits.clear();
    }
  }
  return bytes;
}

TEST(McapGolden, WritesTheBytesOfTheSpecification) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("one.mcap");
  WriterOptions options;
  options.library = "L";

  auto writer = McapWriter::create(path, false, options);
  ASSERT_TRUE(writer.ok());
  const auto schema = writer->add_schema("T", "omgidl", "I");
  const auto channel = writer->add_channel(schema, "/t", "cdr");
  ASSERT_TRUE(writer->write(Message{channel, 7, 10, 11, "\xAB\xCD"}).ok());
  ASSERT_TRUE(writer->finish().ok());

  EXPECT_EQ(read_bytes(path), bytes_of(kOneMessage));
}

TEST(McapGolden, ReadsTheBytesOfTheSpecification) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("one.mcap");
  write_bytes(path, bytes_of(kOneMessage));

  const auto reader = McapReader::open(path);
  ASSERT_TRUE(reader.ok()) << reader.error().text();
  auto messages = reader->messages(Order::kFile);
  const auto message = messages.next();
  ASSERT_TRUE(message.ok() && *message);

  EXPECT_TRUE(reader->indexed());
  EXPECT_FALSE(reader->tear());
  EXPECT_EQ(reader->header().library, "L");
  EXPECT_EQ(reader->schemas().at(1).data, "I");
  EXPECT_EQ(reader->channels().at(0).topic, "/t");
  EXPECT_EQ((*message)->sequence, 7U);
  EXPECT_EQ((*message)->log_time_ns, 10U);
  EXPECT_EQ((*message)->publish_time_ns, 11U);
  EXPECT_EQ((*message)->data, "\xAB\xCD");
  const auto end = messages.next();
  EXPECT_TRUE(end.ok() && !*end);
}

TEST(McapGolden, ComputesTheCheckValueOfTheCrc) {
  // The check value of CRC-32/ISO-HDLC in every catalogue.
  EXPECT_EQ(crc32("123456789"), 0xCBF43926U);
}

}  // namespace
}  // namespace clew::recording_test
