// SPDX-License-Identifier: Apache-2.0
#include "recording/sample_losses.hpp"

#include <algorithm>

namespace clew::bridge {
namespace {

// A run that loses samples all the time is told so in a few lines.
constexpr std::size_t kMaxListed = 16;

}  // namespace

void SampleLosses::add_ticks(domain::Topic topic, std::uint64_t first, std::uint64_t last) {
  samples_ += last - first + 1;
  const auto before = std::find_if(losses_.rbegin(), losses_.rend(),
                                   [topic](const Loss& loss) { return loss.topic == topic; });
  if (before != losses_.rend() && before->sequences == 0 && before->last_tick + 1 == first) {
    before->last_tick = last;
    return;
  }
  add({topic, first, last, 0});
}

void SampleLosses::add_sequences(domain::Topic topic, std::uint64_t tick, std::uint64_t count) {
  samples_ += count;
  add({topic, tick, tick, count});
}

void SampleLosses::add(const Loss& loss) {
  losses_.size() < kMaxListed ? losses_.push_back(loss) : static_cast<void>(++unlisted_);
}

std::vector<std::string> SampleLosses::texts() const {
  std::vector<std::string> texts;
  for (const Loss& loss : losses_) {
    const std::string topic = "'" + std::string(domain::topic_name(loss.topic)) + "'";
    if (loss.sequences > 0) {
      texts.push_back(std::to_string(loss.sequences) + " samples of " + topic + " before tick " +
                      std::to_string(loss.first_tick));
    } else if (loss.first_tick == loss.last_tick) {
      texts.push_back(topic + " of tick " + std::to_string(loss.first_tick));
    } else {
      texts.push_back(topic + " of ticks " + std::to_string(loss.first_tick) + " to " +
                      std::to_string(loss.last_tick));
    }
  }
  if (unlisted_ > 0) texts.push_back("and more in " + std::to_string(unlisted_) + " other places");
  return texts;
}

}  // namespace clew::bridge
