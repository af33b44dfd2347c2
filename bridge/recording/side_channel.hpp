// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "recording/mcap_writer.hpp"
#include "recording/run_description.hpp"

namespace clew::bridge {

/// What a recording holds beside its samples, as JSON on a channel of its own, in the order of the
/// ticks. `Entry` has a `tick`, and `to_json(entry)` gives its message. The channel is declared
/// with its first entry, so a run without one has the bytes of before.
template <typename Entry>
class SideChannel {
 public:
  explicit SideChannel(const char* topic) : topic_(topic) {}

  const std::vector<Entry>& entries() const { return entries_; }

  /// Puts an entry in its place among those that are not written yet.
  void insert(Entry entry) {
    const auto unwritten = entries_.begin() + static_cast<std::ptrdiff_t>(written_);
    const auto later =
        std::upper_bound(unwritten, entries_.end(), entry.tick,
                         [](std::uint64_t tick, const Entry& other) { return tick < other.tick; });
    entries_.insert(later, std::move(entry));
  }

  /// What is written from here on goes into another file.
  void begin_file() { channel_.reset(); }

  /// What is not written yet gets this tick.
  void move_unwritten_to(std::uint64_t tick) {
    for (std::size_t i = written_; i < entries_.size(); ++i) entries_[i].tick = tick;
  }

  /// Writes the entries up to `tick`, inclusive. `write_before(entry)` writes what stands before
  /// one.
  template <typename WriteBefore>
  core::Result<void> write_until(std::uint64_t tick, double tick_s, mcap::McapWriter& writer,
                                 const WriteBefore& write_before) {
    for (; written_ < entries_.size() && entries_[written_].tick <= tick; ++written_) {
      const Entry& entry = entries_[written_];
      CLEW_RETURN_IF_ERROR(write_before(entry));
      if (!channel_) channel_ = writer.add_channel(0, topic_, "json");
      const std::string json = to_json(entry);
      mcap::Message message;
      message.channel_id = *channel_;
      message.sequence = static_cast<std::uint32_t>(written_);
      message.log_time_ns = tick_to_ns(entry.tick, tick_s);
      message.publish_time_ns = message.log_time_ns;
      message.data = json;
      CLEW_RETURN_IF_ERROR(writer.write(message));
    }
    return {};
  }

  /// The same, where nothing stands before an entry.
  core::Result<void> write_until(std::uint64_t tick, double tick_s, mcap::McapWriter& writer) {
    return write_until(tick, tick_s, writer, [](const Entry&) { return core::Result<void>(); });
  }

 private:
  const char* topic_;
  std::vector<Entry> entries_;
  std::size_t written_ = 0;
  std::optional<std::uint16_t> channel_;
};

}  // namespace clew::bridge
