// SPDX-License-Identifier: Apache-2.0
/// A file with a bit of everything, and what a reader must find in it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "recording/compression.hpp"
#include "recording/mcap_reader.hpp"

namespace clew::recording_test {

/// A message that owns its data.
struct StoredMessage {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  std::string data;
};

bool operator==(const StoredMessage& a, const StoredMessage& b);

/// `count` messages on channels 0 and 1 in turn, with data of 0 to 60 bytes, in an order in which
/// log times go back now and then: 0, 2, 1, 3, 5, 4, ... times 100 ms.
std::vector<StoredMessage> sample_messages(std::size_t count);

/// Writes those messages, about ten a chunk, with two attachments and two metadata records between.
void write_sample_file(const std::string& path, bridge::mcap::Compression compression,
                       const std::vector<StoredMessage>& messages);

/// Everything that a reader gives; the messages read before an error, too.
struct Content {
  std::vector<StoredMessage> messages;
  std::vector<std::string> attachments;  ///< `name=data`
  std::vector<std::string> errors;
};
Content read_content(const bridge::mcap::McapReader& reader, bridge::mcap::Order order,
                     const bridge::mcap::MessageFilter& filter = {});

/// Whether `part` is the beginning of `whole`, or all of it.
template <typename T>
bool is_prefix(const std::vector<T>& part, const std::vector<T>& whole) {
  if (part.size() > whole.size()) return false;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (!(part[i] == whole[i])) return false;
  }
  return true;
}

}  // namespace clew::recording_test
