// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

#include "recording/run_recorder.hpp"
#include "recording/run_recording.hpp"
#include "wire/codec.hpp"

namespace clew::recording_test {

using namespace bridge;
using domain::Topic;

/// A sample that owns its bytes.
struct StoredSample {
  Topic topic = Topic::kCommand;
  std::uint64_t tick = 0;
  std::string cdr;
};

inline bool operator==(const StoredSample& a, const StoredSample& b) {
  return std::tie(a.topic, a.tick, a.cdr) == std::tie(b.topic, b.tick, b.cdr);
}

inline RunDescription description() {
  RunDescription run;
  run.tick_s = 0.3;
  run.seed = 42;
  run.versions = {{"clew", "0.1.0"}};
  run.idl_fingerprint = "00112233445566778899aabbccddeeff";
  run.bundle = {{"graph.yaml", "world: u-trap\n"}, {"world.yaml", "name: u-trap\n"}};
  for (const Topic topic : {Topic::kCommand, Topic::kScan, Topic::kState}) {
    run.schemas[topic] = idl_text(topic);
  }
  return run;
}

/// The same, with its chunks packed.
inline RunDescription packed(mcap::Compression compression) {
  RunDescription run = description();
  run.compression = compression;
  return run;
}

inline std::string bytes_of(Topic topic, std::uint64_t tick) {
  return std::string(domain::topic_name(topic)) + std::string(tick % 7, '.') + std::to_string(tick);
}

/// The samples of a run of `ticks` ticks, in canonical order.
inline std::vector<StoredSample> samples_of_run(std::uint64_t ticks) {
  std::vector<StoredSample> samples;
  for (std::uint64_t tick = 0; tick < ticks; ++tick) {
    for (const auto& [topic, schema] : description().schemas) {
      samples.push_back({topic, tick, bytes_of(topic, tick)});
    }
  }
  return samples;
}

inline void record(const std::string& path, const std::vector<StoredSample>& samples,
                   mcap::Compression compression = mcap::Compression::kNone) {
  auto recorder = RunRecorder::create(path, packed(compression), true);
  ASSERT_TRUE(recorder.ok()) << recorder.error().text();
  for (const auto& sample : samples) {
    const auto added = recorder->add(sample.topic, sample.tick, sample.tick, sample.cdr);
    ASSERT_TRUE(added.ok()) << added.error().text();
  }
  const auto finished = recorder->finish();
  ASSERT_TRUE(finished.ok()) << finished.error().text();
}

inline std::vector<StoredSample> read_samples(SampleStream stream) {
  std::vector<StoredSample> samples;
  for (;;) {
    const auto sample = stream.next();
    EXPECT_TRUE(sample.ok()) << sample.error().text();
    if (!sample.ok() || !*sample) return samples;
    EXPECT_EQ((*sample)->sequence, (*sample)->tick);
    samples.push_back({(*sample)->topic, (*sample)->tick, std::string((*sample)->cdr)});
  }
}

}  // namespace clew::recording_test
