// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "sample_run.hpp"
#include "scratch_directory.hpp"

namespace clew::recording_test {

/// Ticks last 0.3 s: a file holds those of two seconds, six or seven.
inline RunDescription split_by_time() {
  RunDescription run = description();
  run.split.seconds = 2.0;
  return run;
}

inline core::Result<void> add(RunRecorder& recorder, const StoredSample& sample) {
  return recorder.add(sample.topic, sample.tick, sample.tick, sample.cdr);
}

inline void record_split(const std::string& path, const RunDescription& run,
                         const std::vector<StoredSample>& samples) {
  auto recorder = RunRecorder::create(path, run, true);
  ASSERT_TRUE(recorder.ok()) << recorder.error().text();
  for (const auto& sample : samples) ASSERT_TRUE(add(*recorder, sample).ok());
  const auto finished = recorder->finish();
  ASSERT_TRUE(finished.ok()) << finished.error().text();
}

inline std::vector<std::string> files_in(const ScratchDirectory& scratch) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(
           std::filesystem::path(scratch.file("x")).parent_path())) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// A recorder that dies after some samples, and one that goes on and gets those that the first one
/// had not called durable.
inline void record_with_a_death(const std::string& path, const RunDescription& run,
                                const std::vector<StoredSample>& samples, std::size_t death) {
  std::uint64_t durable_ticks = 0;
  {
    auto recorder = RunRecorder::create(path, run, true);
    ASSERT_TRUE(recorder.ok()) << recorder.error().text();
    for (std::size_t i = 0; i < death; ++i) ASSERT_TRUE(add(*recorder, samples[i]).ok());
    ASSERT_TRUE(recorder->write_ahead().ok());
    durable_ticks = recorder->durable_ticks();
  }
  auto next = RunRecorder::go_on(path, run, durable_ticks);
  ASSERT_TRUE(next.ok()) << "after sample " << death << ": " << next.error().text();
  for (const StoredSample& sample : samples) {
    if (sample.tick >= durable_ticks) {
      const auto added = add(*next, sample);
      ASSERT_TRUE(added.ok()) << "after sample " << death << ": " << added.error().text();
    }
  }
  const auto finished = next->finish();
  ASSERT_TRUE(finished.ok()) << finished.error().text();
}

}  // namespace clew::recording_test
