// SPDX-License-Identifier: Apache-2.0
#include "recording/message_stream.hpp"

#include <algorithm>
#include <utility>

namespace clew::bridge::mcap {

MessageStream::MessageStream(std::shared_ptr<const InputFile> file,
                             std::shared_ptr<const FileIndex> index, const ReadLimits& limits,
                             Order order, MessageFilter filter)
    : file_(std::move(file)),
      index_(std::move(index)),
      limits_(limits),
      order_(order),
      filter_(std::move(filter)),
      declarations_(index_->declarations) {
  const auto& segments = index_->segments;
  for (std::size_t ordinal = 0; ordinal < segments.size(); ++ordinal) {
    const Segment& segment = segments[ordinal];
    const bool wanted =
        segment.end_time_ns >= filter_.first_ns && segment.start_time_ns <= filter_.last_ns;
    if (wanted) waiting_.push_back(ordinal);
  }
  std::reverse(waiting_.begin(), waiting_.end());
  if (order_ == Order::kLogTime) {
    std::stable_sort(waiting_.begin(), waiting_.end(), [&segments](std::size_t a, std::size_t b) {
      return segments[a].start_time_ns > segments[b].start_time_ns;
    });
  }
}

bool MessageStream::comes_later(const OpenSegment& a, const OpenSegment& b) const {
  if (order_ == Order::kLogTime) {
    const std::uint64_t time_a = a.entries[a.position].log_time_ns;
    const std::uint64_t time_b = b.entries[b.position].log_time_ns;
    if (time_a != time_b) return time_a > time_b;
  }
  return a.ordinal > b.ordinal;
}

void MessageStream::enter(std::unique_ptr<OpenSegment> segment) {
  open_.push_back(std::move(segment));
  std::push_heap(open_.begin(), open_.end(),
                 [this](const auto& a, const auto& b) { return comes_later(*a, *b); });
}

void MessageStream::return_given() {
  if (!given_) return;
  ++given_->position;
  if (given_->position < given_->entries.size()) {
    enter(std::move(given_));
  } else {
    open_bytes_ -= given_->content.memory_bytes();
    spare_ = std::move(given_);
  }
}

bool MessageStream::must_open_another() const {
  if (waiting_.empty()) return false;
  if (open_.empty()) return true;
  if (order_ == Order::kFile) return false;
  const OpenSegment& top = *open_.front();
  return index_->segments[waiting_.back()].start_time_ns <= top.entries[top.position].log_time_ns;
}

core::Result<void> MessageStream::open_another() {
  auto segment = spare_ ? std::move(spare_) : std::make_unique<OpenSegment>();
  segment->ordinal = waiting_.back();
  segment->position = 0;
  segment->entries.clear();
  waiting_.pop_back();
  const Segment& place = index_->segments[segment->ordinal];
  if (const auto loaded = segment->content.load(*file_, place, limits_, declarations_);
      !loaded.ok()) {
    // What the file system says names the file itself.
    if (!loaded.error().file.empty()) return loaded.error();
    return file_->error("is damaged at byte " + std::to_string(place.offset) + ": " +
                        loaded.error().message);
  }
  // What a reader of the file was told of: see McapReader::channels().
  if (declarations_.channels().size() != index_->declarations.channels().size()) {
    return file_->error("is damaged at byte " + std::to_string(place.offset) +
                        ": a chunk declares a channel that the file's summary does not");
  }
  for (const auto& entry : segment->content.entries()) {
    if (filter_.passes(entry.log_time_ns, entry.channel_id)) segment->entries.push_back(entry);
  }
  if (order_ == Order::kLogTime) {
    std::stable_sort(segment->entries.begin(), segment->entries.end(),
                     [](const auto& a, const auto& b) { return a.log_time_ns < b.log_time_ns; });
  }
  if (segment->entries.empty()) {
    spare_ = std::move(segment);
    return {};
  }
  open_bytes_ += segment->content.memory_bytes();
  if (open_bytes_ > limits_.open_bytes) {
    return file_->error("has chunks of which more than " + std::to_string(limits_.open_bytes) +
                        " bytes overlap in time");
  }
  enter(std::move(segment));
  return {};
}

core::Error MessageStream::end_with(const core::Error& error) {
  waiting_.clear();
  open_.clear();
  return error;
}

core::Result<std::optional<Message>> MessageStream::next() {
  return_given();
  while (must_open_another()) {
    if (const auto opened = open_another(); !opened.ok()) return end_with(opened.error());
  }
  if (open_.empty()) return std::optional<Message>();
  std::pop_heap(open_.begin(), open_.end(),
                [this](const auto& a, const auto& b) { return comes_later(*a, *b); });
  given_ = std::move(open_.back());
  open_.pop_back();
  return std::optional<Message>(given_->content.message(given_->entries[given_->position]));
}

}  // namespace clew::bridge::mcap
