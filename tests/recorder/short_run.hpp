// SPDX-License-Identifier: Apache-2.0
/// A run of drive and recovery, as far as a recorder sees it: samples of two topics.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "recorder/recording_sink.hpp"
#include "recording/run_recording.hpp"
#include "run/spool.hpp"
#include "wire/codec.hpp"

namespace clew::recorder_test {

using namespace bridge;

inline RecordingOrder order_at(const std::string& path, double keep_last_s = 0.0) {
  RecordingOrder order;
  order.path = path;
  order.keep_last_s = keep_last_s;
  order.description.tick_s = 0.1;
  order.description.bundle = {{"graph.yaml", "world: u-trap\n"}};
  order.description.idl_fingerprint = std::string(idl_fingerprint());
  for (const domain::Topic topic : {domain::Topic::kEvent, domain::Topic::kState}) {
    order.description.schemas[topic] = idl_text(topic);
  }
  return order;
}

/// The same sample as an entry of a spool.
template <typename Message>
std::string spooled_sample(Message message, std::uint64_t tick) {
  message.stamp.tick = tick;
  message.stamp.sequence = tick;
  Codec<Message> codec;
  std::string spool;
  append_to_spool({domain::topic_of<Message>(), tick, tick, codec.encode(message)}, spool);
  return spool;
}

/// Both topics of the ticks [first, end): nothing happens in them.
inline std::string quiet_ticks(std::uint64_t first, std::uint64_t end) {
  std::string spool;
  for (std::uint64_t tick = first; tick < end; ++tick) {
    spool += spooled_sample(domain::Event(), tick) + spooled_sample(domain::State(), tick);
  }
  return spool;
}

/// Hands a spool over, as the recorder's process does.
inline core::Result<void> add(RunSink& sink, const std::string& spool) {
  core::Result<void> added;
  for_each_spooled(spool, {[&](const SampleView& sample) {
                             if (added.ok()) added = sink.add(sample);
                           },
                           [&](const SpooledState& state) { sink.add_state(state); }});
  return added;
}

/// The last tick of which a recording holds a sample.
inline std::uint64_t last_tick(const RunRecording& recording) {
  std::uint64_t last = 0;
  SampleStream samples = recording.samples();
  while (true) {
    const auto sample = samples.next();
    EXPECT_TRUE(sample.ok()) << sample.error().text();
    if (!sample.ok() || !sample->has_value()) return last;
    last = std::max(last, (*sample)->tick);
  }
}

}  // namespace clew::recorder_test
