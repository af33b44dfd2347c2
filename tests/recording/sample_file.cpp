// SPDX-License-Identifier: Apache-2.0
#include "sample_file.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "recording/mcap_writer.hpp"

namespace clew::recording_test {

using bridge::mcap::Attachment;
using bridge::mcap::McapWriter;
using bridge::mcap::Metadata;
using bridge::mcap::WriterOptions;

bool operator==(const StoredMessage& a, const StoredMessage& b) {
  return std::tie(a.channel_id, a.sequence, a.log_time_ns, a.publish_time_ns, a.data) ==
         std::tie(b.channel_id, b.sequence, b.log_time_ns, b.publish_time_ns, b.data);
}

std::vector<StoredMessage> sample_messages(std::size_t count) {
  constexpr std::uint64_t kOrder[] = {0, 2, 1};
  constexpr std::uint64_t kStep_ns = 100'000'000;
  std::vector<StoredMessage> messages;
  for (std::size_t i = 0; i < count; ++i) {
    StoredMessage message;
    message.channel_id = static_cast<std::uint16_t>(i % 2);
    message.sequence = static_cast<std::uint32_t>(i / 2);
    message.log_time_ns = (3 * (i / 3) + kOrder[i % 3]) * kStep_ns;
    message.publish_time_ns = message.log_time_ns + i;
    message.data = std::string(i % 61, static_cast<char>('a' + i % 26));
    messages.push_back(std::move(message));
  }
  return messages;
}

void write_sample_file(const std::string& path, bridge::mcap::Compression compression,
                       const std::vector<StoredMessage>& messages) {
  WriterOptions options;
  options.library = "test";
  options.compression = compression;
  options.chunk_bytes = 700;
  auto writer = McapWriter::create(path, true, options);
  ASSERT_TRUE(writer.ok()) << writer.error().text();
  ASSERT_TRUE(writer->write(Attachment{0, 0, "first", "text/plain", "one"}).ok());
  ASSERT_TRUE(writer->write(Metadata{"facts", {{"seed", "1"}}}).ok());
  const auto schema = writer->add_schema("clew::msg::Scan", "omgidl", "struct Scan {};");
  writer->add_channel(schema, "/scan", "cdr", {{"key", "value"}});
  writer->add_channel(0, "/raw", "");
  for (const auto& message : messages) {
    ASSERT_TRUE(
        writer
            ->write(bridge::mcap::Message{message.channel_id, message.sequence, message.log_time_ns,
                                          message.publish_time_ns, message.data})
            .ok());
  }
  ASSERT_TRUE(writer->write(Attachment{1, 2, "second", "application/yaml", "two: 2\n"}).ok());
  ASSERT_TRUE(writer->write(Metadata{"end", {}}).ok());
  const auto finished = writer->finish();
  ASSERT_TRUE(finished.ok()) << finished.error().text();
}

Content read_content(const bridge::mcap::McapReader& reader, bridge::mcap::Order order,
                     const bridge::mcap::MessageFilter& filter) {
  Content content;
  auto stream = reader.messages(order, filter);
  for (;;) {
    const auto message = stream.next();
    if (!message.ok()) content.errors.push_back(message.error().text());
    if (!message.ok() || !*message) break;
    content.messages.push_back({(*message)->channel_id, (*message)->sequence,
                                (*message)->log_time_ns, (*message)->publish_time_ns,
                                std::string((*message)->data)});
  }
  bridge::mcap::ByteBuffer buffer;
  for (const auto& place : reader.attachments()) {
    const auto attachment = reader.attachment(place, buffer);
    if (attachment.ok()) {
      content.attachments.push_back(attachment->name + "=" + std::string(attachment->data));
    } else {
      content.errors.push_back(attachment.error().text());
    }
  }
  return content;
}

}  // namespace clew::recording_test
