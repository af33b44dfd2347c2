// SPDX-License-Identifier: Apache-2.0
#include "process/journal.hpp"

#include <cstring>
#include <utility>

namespace clew::bridge {
namespace {

struct SpoolHeader {
  std::uint64_t tick;
  std::uint64_t sequence;
  std::uint32_t size;
  std::uint32_t topic;
};

}  // namespace

void Journal::add_bytes(domain::Topic topic, const domain::TickStamp& stamp, std::string_view cdr) {
  const auto index = static_cast<std::size_t>(topic);
  written_[index] = true;
  if (hash_) chains_[index].add(stamp.tick, stamp.sequence, cdr);
  if (!spool_) return;
  const SpoolHeader header{stamp.tick, stamp.sequence, static_cast<std::uint32_t>(cdr.size()),
                           static_cast<std::uint32_t>(topic)};
  char raw[sizeof header];
  std::memcpy(raw, &header, sizeof header);
  spooled_.append(raw, sizeof raw);
  spooled_.append(cdr);
}

std::map<std::string, core::Hash128> Journal::chains() const {
  std::map<std::string, core::Hash128> chains;
  for (domain::Topic topic : domain::kAllTopics) {
    const auto index = static_cast<std::size_t>(topic);
    if (hash_ && written_[index]) {
      chains[std::string(domain::topic_name(topic))] = chains_[index].value();
    }
  }
  return chains;
}

std::string Journal::take_spooled() {
  std::string taken;
  std::swap(taken, spooled_);
  spooled_.reserve(taken.capacity());
  return taken;
}

bool for_each_spooled(std::string_view spool,
                      const std::function<void(const SpooledSample&)>& take) {
  while (!spool.empty()) {
    SpoolHeader header;
    if (spool.size() < sizeof header) return false;
    std::memcpy(&header, spool.data(), sizeof header);
    spool.remove_prefix(sizeof header);
    if (header.size > spool.size() || header.topic >= domain::kTopicCount) return false;
    take({static_cast<domain::Topic>(header.topic), header.tick, header.sequence,
          spool.substr(0, header.size)});
    spool.remove_prefix(header.size);
  }
  return true;
}

}  // namespace clew::bridge
