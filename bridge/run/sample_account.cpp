// SPDX-License-Identifier: Apache-2.0
#include "run/sample_account.hpp"

#include <cstring>
#include <utility>

#include "core/archive.hpp"
#include "run/spool.hpp"

namespace clew::bridge {
namespace {

struct SpoolHeader {
  std::uint64_t tick;
  std::uint64_t sequence;  ///< of a state: bytes of the stage's name, which is in front of it
  std::uint32_t size;
  std::uint32_t topic;  ///< or kState, kIntervention or kIncident
};
constexpr std::uint32_t kState = domain::kTopicCount;
constexpr std::uint32_t kIntervention = kState + 1;
constexpr std::uint32_t kIncident = kState + 2;

void append(std::string& spool, const SpoolHeader& header) {
  char raw[sizeof header];
  std::memcpy(raw, &header, sizeof header);
  spool.append(raw, sizeof raw);
}

template <typename Told>
std::string spooled_as(std::uint32_t kind, const Told& told) {
  core::StateWriter writer;
  writer(told);
  std::string spool;
  append(spool, {told.tick, 0, static_cast<std::uint32_t>(writer.bytes().size()), kind});
  return spool + writer.bytes();
}

/// Hands on what spooled_as has written; false if it is not that.
template <typename Told>
bool hand_on(std::string_view bytes, const std::function<void(const Told&)>& to) {
  Told told;
  core::StateReader reader(bytes);
  reader(told);
  if (!reader.complete()) return false;
  if (to) to(told);
  return true;
}

}  // namespace

void append_to_spool(const SampleView& sample, std::string& spool) {
  append(spool, {sample.tick, sample.sequence, static_cast<std::uint32_t>(sample.cdr.size()),
                 static_cast<std::uint32_t>(sample.topic)});
  spool.append(sample.cdr);
}

void SampleAccount::add_bytes(domain::Topic topic, const domain::TickStamp& stamp,
                              std::string_view cdr) {
  const auto index = index_of(topic);
  written_[index] = true;
  if (hash_) chains_[index].add(stamp.tick, stamp.sequence, cdr);
  if (!spool_) return;
  append_to_spool({topic, stamp.tick, stamp.sequence, cdr}, spooled_);
}

void append_to_spool(const SpooledState& state, std::string& spool) {
  const std::size_t size = state.stage.size() + state.state.size();
  append(spool, {state.tick, state.stage.size(), static_cast<std::uint32_t>(size), kState});
  spool.append(state.stage).append(state.state);
}

void SampleAccount::spool_state(const SpooledState& state) { append_to_spool(state, spooled_); }

std::map<std::string, core::Hash128> SampleAccount::chains() const {
  std::map<std::string, core::Hash128> chains;
  for (domain::Topic topic : domain::kAllTopics) {
    const auto index = index_of(topic);
    if (hash_ && written_[index]) {
      chains[std::string(domain::topic_name(topic))] = chains_[index].value();
    }
  }
  return chains;
}

std::string SampleAccount::take_spooled() {
  std::string taken;
  std::swap(taken, spooled_);
  spooled_.reserve(taken.capacity());
  return taken;
}

std::string spooled(const domain::Intervention& intervention) {
  return spooled_as(kIntervention, intervention);
}

std::string spooled(const domain::Incident& incident) { return spooled_as(kIncident, incident); }

bool for_each_spooled(std::string_view spool, const SpoolVisitor& visitor) {
  while (!spool.empty()) {
    SpoolHeader header;
    if (spool.size() < sizeof header) return false;
    std::memcpy(&header, spool.data(), sizeof header);
    spool.remove_prefix(sizeof header);
    if (header.size > spool.size() || header.topic > kIncident) return false;
    const std::string_view bytes = spool.substr(0, header.size);
    if (header.topic < kState) {
      visitor.on_sample(
          {static_cast<domain::Topic>(header.topic), header.tick, header.sequence, bytes});
    } else if (header.topic == kIntervention) {
      if (!hand_on(bytes, visitor.on_intervention)) return false;
    } else if (header.topic == kIncident) {
      if (!hand_on(bytes, visitor.on_incident)) return false;
    } else {
      if (header.sequence > bytes.size()) return false;
      visitor.on_state(
          {bytes.substr(0, header.sequence), header.tick, bytes.substr(header.sequence)});
    }
    spool.remove_prefix(header.size);
  }
  return true;
}

}  // namespace clew::bridge
