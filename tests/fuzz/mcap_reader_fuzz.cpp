// SPDX-License-Identifier: Apache-2.0
/// Whatever the bytes: McapReader refuses them, or gives messages that keep its promises.
#include <cstdint>
#include <optional>

#include "core/check.hpp"
#include "fuzzed_file.hpp"
#include "recording/mcap_reader.hpp"

namespace clew::fuzz {
namespace {

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

void read(const std::string& path) {
  ReadLimits limits;
  limits.record_bytes = kMostBytes;
  limits.open_bytes = kMostBytes;
  const auto reader = McapReader::open(path, limits);
  if (!reader.ok()) {
    CLEW_CHECK(!reader.error().message.empty(), "an error without a message");
    return;
  }
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
  if (const auto verified = reader->verify(); !verified.ok()) {
    CLEW_CHECK(!verified.error().message.empty(), "an error without a message");
  }
}

}  // namespace
}  // namespace clew::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const clew::fuzz::FuzzedFile file(bytes, size);
  clew::fuzz::read(file.path());
  return 0;
}
