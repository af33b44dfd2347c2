// SPDX-License-Identifier: Apache-2.0
#include "replay/tick_reader.hpp"

namespace clew::bridge {
namespace {

SampleFilter filter_of(const runtime::TopicSet& topics, std::uint64_t first_tick,
                       std::uint64_t last_tick) {
  SampleFilter filter;
  for (domain::Topic topic : domain::kAllTopics) {
    if (topics[index_of(topic)]) filter.topics.insert(topic);
  }
  filter.first_tick = first_tick;
  filter.last_tick = last_tick;
  return filter;
}

}  // namespace

TickReader::TickReader(const RunRecording& recording, const runtime::TopicSet& topics,
                       std::uint64_t last_tick, std::uint64_t first_tick)
    : recording_(recording),
      cut_off_(!recording.cut_off().empty()),
      topics_(topics),
      stream_(recording.samples(filter_of(topics, first_tick, last_tick))) {}

core::Result<void> TickReader::look_ahead() {
  auto sample = stream_.next();
  if (!sample.ok()) return sample.error();
  ahead_ = std::move(sample).value();
  return {};
}

core::Result<void> TickReader::note_ended() {
  const runtime::TopicSet missing = topics_ & ~current_.present_ & ~current_.ended_;
  for (domain::Topic topic : domain::kAllTopics) {
    if (!missing[index_of(topic)]) continue;
    const auto later = recording_.samples({{topic}, current_.tick_ + 1}).next();
    if (!later.ok()) return later.error();
    if (!*later) current_.ended_.set(index_of(topic));
  }
  return {};
}

core::Error TickReader::not_in_order() const {
  return {"its samples are not in the order of tick and topic at tick " +
              std::to_string(ahead_->tick) + " of " +
              std::string(domain::topic_name(ahead_->topic)),
          recording_.path()};
}

core::Result<const RecordedTick*> TickReader::next() {
  if (!started_) CLEW_RETURN_IF_ERROR(look_ahead());
  if (!ahead_) return nullptr;
  if (started_ && ahead_->tick <= current_.tick_) return not_in_order();
  started_ = true;
  current_.tick_ = ahead_->tick;
  current_.present_.reset();
  while (ahead_ && ahead_->tick == current_.tick_) {
    const auto index = static_cast<std::size_t>(ahead_->topic);
    // Later topics of this tick have been read already if it comes too late.
    if ((current_.present_ >> index).any()) return not_in_order();
    current_.present_.set(index);
    current_.cdr_[index].assign(ahead_->cdr);
    CLEW_RETURN_IF_ERROR(look_ahead());
  }
  if (cut_off_) CLEW_RETURN_IF_ERROR(note_ended());
  if ((current_.ended_ & ~may_end_).any()) return nullptr;
  return &current_;
}

}  // namespace clew::bridge
