// SPDX-License-Identifier: Apache-2.0
#include "recording/run_recorder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "recording/run_hash.hpp"
#include "sample_run.hpp"
#include "scratch_directory.hpp"

namespace clew::recording_test {
namespace {

TEST(RunRecorder, PutsSamplesIntoCanonicalOrderWhateverTheInterleaving) {
  const ScratchDirectory scratch;
  const std::vector<StoredSample> canonical = samples_of_run(50);
  record(scratch.file("canonical.mcap"), canonical);
  // By topic: all commands, then all scans, then all states.
  std::vector<StoredSample> by_topic = canonical;
  std::stable_sort(by_topic.begin(), by_topic.end(),
                   [](const auto& a, const auto& b) { return a.topic < b.topic; });
  // Each sample up to 8 ticks early or late, in order within each topic.
  std::vector<std::pair<std::uint64_t, StoredSample>> keyed;
  const core::Random random({7, 0, 0, 0});
  for (const auto& sample : canonical) {
    const auto lag = static_cast<std::uint32_t>(sample.topic) * 4;
    keyed.push_back({sample.tick + lag + random.bits(lag) % 2, sample});
  }
  std::stable_sort(keyed.begin(), keyed.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<StoredSample> lagging;
  for (const auto& [key, sample] : keyed) lagging.push_back(sample);

  record(scratch.file("by_topic.mcap"), by_topic);
  record(scratch.file("lagging.mcap"), lagging);

  const std::string expected = read_bytes(scratch.file("canonical.mcap"));
  EXPECT_EQ(read_bytes(scratch.file("by_topic.mcap")), expected);
  EXPECT_EQ(read_bytes(scratch.file("lagging.mcap")), expected);
  const auto recording = RunRecording::open(scratch.file("lagging.mcap"));
  ASSERT_TRUE(recording.ok()) << recording.error().text();
  EXPECT_EQ(read_samples(recording->samples()), canonical);
}

TEST(RunRecorder, WritesATickOnceEveryTopicHasDeliveredIt) {
  const ScratchDirectory scratch;
  auto recorder = RunRecorder::create(scratch.file("a.mcap"), description(), false);
  ASSERT_TRUE(recorder.ok());

  ASSERT_TRUE(recorder->add(Topic::kScan, 0, 0, "x").ok());
  ASSERT_TRUE(recorder->add(Topic::kScan, 1, 1, "x").ok());
  ASSERT_TRUE(recorder->add(Topic::kState, 0, 0, "x").ok());
  EXPECT_EQ(recorder->complete_ticks(), 0U);
  ASSERT_TRUE(recorder->add(Topic::kCommand, 0, 0, "x").ok());

  EXPECT_EQ(recorder->complete_ticks(), 1U);
}

TEST(RunRecorder, PassesOverWhatItHasAndRefusesWhatIsNotOfTheRun) {
  const ScratchDirectory scratch;
  record(scratch.file("once.mcap"), samples_of_run(20));
  auto recorder = RunRecorder::create(scratch.file("twice.mcap"), description(), false);
  ASSERT_TRUE(recorder.ok());

  // Writers that go back by four ticks every ten write those again.
  for (std::uint64_t tick : {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  6,  7,  8,  9,
                             10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 16, 17, 18, 19}) {
    for (const auto& [topic, schema] : description().schemas) {
      ASSERT_TRUE(recorder->add(topic, tick, tick, bytes_of(topic, tick)).ok());
    }
  }
  const auto unknown = recorder->add(Topic::kEvent, 0, 0, "x");
  ASSERT_TRUE(recorder->finish().ok());

  EXPECT_EQ(read_bytes(scratch.file("twice.mcap")), read_bytes(scratch.file("once.mcap")));
  ASSERT_FALSE(unknown.ok());
  EXPECT_EQ(unknown.error().message, "topic event: is not part of this recording");
}

TEST(RunRecorder, SaysWhichSamplesAreLost) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("a.mcap");
  auto recorder = RunRecorder::create(path, description(), false);
  ASSERT_TRUE(recorder.ok());
  for (std::uint64_t tick = 0; tick < 10; ++tick) {
    ASSERT_TRUE(recorder->add(Topic::kCommand, tick, tick, "x").ok());
    // No scan at 3, 6 and 7; the state's writer numbers one sample more than it sends.
    if (tick != 3 && tick != 6 && tick != 7) {
      ASSERT_TRUE(recorder->add(Topic::kScan, tick, tick, "x").ok());
    }
    ASSERT_TRUE(recorder->add(Topic::kState, tick, tick < 5 ? tick : tick + 1, "x").ok());
  }
  ASSERT_TRUE(recorder->finish().ok());

  EXPECT_EQ(recorder->losses().samples(), 4U);
  std::vector<std::string> texts = recorder->losses().texts();
  std::sort(texts.begin(), texts.end());
  EXPECT_EQ(texts, (std::vector<std::string>{"'scan' of tick 3", "'scan' of ticks 6 to 7",
                                             "1 samples of 'state' before tick 5"}));
  const auto recording = RunRecording::open(path);
  ASSERT_TRUE(recording.ok() && recording->end());
  EXPECT_EQ(recording->end()->lost_samples, 4U);
}

/// The samples of a run that was interrupted: commands up to tick 11, scans to 14, states to 13.
std::vector<StoredSample> samples_of_interrupted_run() {
  std::vector<StoredSample> samples;
  for (const StoredSample& sample : samples_of_run(15)) {
    if (sample.topic == Topic::kCommand && sample.tick > 11) continue;
    if (sample.topic == Topic::kState && sample.tick > 13) continue;
    samples.push_back(sample);
  }
  return samples;
}

TEST(RunRecorder, CallsNothingLostThatAnAbortedRunDidNotReach) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("a.mcap");
  auto recorder = RunRecorder::create(path, description(), false);
  ASSERT_TRUE(recorder.ok());
  for (const StoredSample& sample : samples_of_interrupted_run()) {
    // Behind the last command, and yet lost: a later scan is there.
    if (sample.topic == Topic::kScan && sample.tick == 12) continue;
    ASSERT_TRUE(recorder->add(sample.topic, sample.tick, sample.tick, sample.cdr).ok());
  }
  ASSERT_TRUE(recorder->finish("interrupted").ok());

  EXPECT_EQ(recorder->losses().texts(), std::vector<std::string>{"'scan' of tick 12"});
  const auto recording = RunRecording::open(path);
  ASSERT_TRUE(recording.ok() && recording->end());
  EXPECT_EQ(recording->end()->aborted, "interrupted");
  EXPECT_EQ(recording->end()->lost_samples, 1U);
  EXPECT_EQ(recording->end()->ticks, 12U);
  EXPECT_TRUE(recording->complete());
  EXPECT_EQ(recording->cut_off(), "is of a run that was aborted (interrupted)");
}

TEST(RunRecorder, GoesOnWithAnAbortedRun) {
  const ScratchDirectory scratch;
  record(scratch.file("whole.mcap"), samples_of_run(15));
  const std::string path = scratch.file("again.mcap");
  auto recorder = RunRecorder::create(path, description(), false);
  ASSERT_TRUE(recorder.ok());
  for (const StoredSample& sample : samples_of_interrupted_run()) {
    ASSERT_TRUE(recorder->add(sample.topic, sample.tick, sample.tick, sample.cdr).ok());
  }
  ASSERT_TRUE(recorder->seal("interrupted").ok());

  auto next = RunRecorder::go_on(path, description());
  ASSERT_TRUE(next.ok()) << next.error().text();
  for (const StoredSample& sample : samples_of_run(15)) {
    ASSERT_TRUE(next->add(sample.topic, sample.tick, sample.tick, sample.cdr).ok());
  }
  ASSERT_TRUE(next->finish().ok());

  EXPECT_EQ(read_bytes(path), read_bytes(scratch.file("whole.mcap")));
}

TEST(RunRecorder, GivesUpATopicThatStaysBehind) {
  const ScratchDirectory scratch;
  auto recorder = RunRecorder::create(scratch.file("a.mcap"), description(), false);
  ASSERT_TRUE(recorder.ok());
  for (std::uint64_t tick = 0; tick < RunRecorder::kMaxWaitingTicks + 10; ++tick) {
    ASSERT_TRUE(recorder->add(Topic::kScan, tick, tick, "x").ok());
    ASSERT_TRUE(recorder->add(Topic::kState, tick, tick, "x").ok());
  }

  // Ten ticks were written without a command, which now comes too late for them.
  ASSERT_TRUE(recorder->add(Topic::kCommand, 9, 9, "x").ok());

  EXPECT_EQ(recorder->losses().samples(), 10U);
  EXPECT_EQ(recorder->losses().texts(), std::vector<std::string>{"'command' of ticks 0 to 9"});
}

TEST(RunRecorder, ListsOnlyTheFirstOfManyLosses) {
  SampleLosses losses;
  for (std::uint64_t tick = 0; tick < 40; tick += 2) losses.add_ticks(Topic::kScan, tick, tick);

  const auto texts = losses.texts();

  EXPECT_EQ(losses.samples(), 20U);
  ASSERT_EQ(texts.size(), 17U);
  EXPECT_EQ(texts.back(), "and more in 4 other places");
}

/// A recorder that dies after some ticks, and one that goes on and gets the samples from
/// `durable_ticks` of the first one on.
void record_with_a_death(const std::string& path, const std::vector<StoredSample>& samples,
                         std::size_t death, mcap::Compression compression) {
  std::uint64_t durable_ticks = 0;
  {
    auto recorder = RunRecorder::create(path, packed(compression), true);
    ASSERT_TRUE(recorder.ok());
    for (std::size_t i = 0; i < death; ++i) {
      const StoredSample& sample = samples[i];
      ASSERT_TRUE(recorder->add(sample.topic, sample.tick, sample.tick, sample.cdr).ok());
    }
    if (death % 2 == 0) {
      ASSERT_TRUE(recorder->write_ahead().ok());
    }
    durable_ticks = recorder->durable_ticks();
  }
  auto recorder = RunRecorder::go_on(path, packed(compression), durable_ticks);
  ASSERT_TRUE(recorder.ok()) << recorder.error().text();
  for (const StoredSample& sample : samples) {
    if (sample.tick < durable_ticks) continue;
    ASSERT_TRUE(recorder->add(sample.topic, sample.tick, sample.tick, sample.cdr).ok());
  }
  ASSERT_TRUE(recorder->finish().ok());
}

TEST(RunRecorder, GoesOnAfterADeathAtEverySample) {
  const ScratchDirectory scratch;
  const std::vector<StoredSample> samples = samples_of_run(15);
  for (const auto compression :
       {mcap::Compression::kNone, mcap::Compression::kZstd, mcap::Compression::kLz4}) {
    record(scratch.file("whole.mcap"), samples, compression);
    const std::string whole = read_bytes(scratch.file("whole.mcap"));

    for (std::size_t death = 0; death <= samples.size(); ++death) {
      std::filesystem::remove(scratch.file("again.mcap"));
      record_with_a_death(scratch.file("again.mcap"), samples, death, compression);
      ASSERT_EQ(read_bytes(scratch.file("again.mcap")), whole) << "death at sample " << death;
    }
  }
}

TEST(RunRecorder, GoesOnAfterATearAtEveryByte) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("torn.mcap");
  const std::vector<StoredSample> samples = samples_of_run(15);
  record(path, samples);
  const std::string whole = read_bytes(path);
  std::filesystem::remove(path);

  for (std::size_t kept_bytes = 0; kept_bytes < whole.size(); ++kept_bytes) {
    write_bytes(path + ".tmp~", std::string_view(whole).substr(0, kept_bytes));
    auto recorder = RunRecorder::go_on(path, description());
    ASSERT_TRUE(recorder.ok()) << recorder.error().text();
    for (const StoredSample& sample : samples) {
      ASSERT_TRUE(recorder->add(sample.topic, sample.tick, sample.tick, sample.cdr).ok());
    }
    ASSERT_TRUE(recorder->finish().ok());
    ASSERT_EQ(read_bytes(path), whole) << "torn at byte " << kept_bytes;
  }
}

TEST(RunRecorder, DoesNotGoOnWithWhatIsNotItsOwn) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("a.mcap");
  record(path, samples_of_run(15));
  std::filesystem::rename(path, path + ".tmp~");
  const std::string before = read_bytes(path + ".tmp~");
  RunDescription other = description();
  other.seed = 43;

  const auto other_run = RunRecorder::go_on(path, other);
  const auto compressed = RunRecorder::go_on(path, packed(mcap::Compression::kZstd));
  const auto too_short = RunRecorder::go_on(path, description(), 16);

  ASSERT_FALSE(other_run.ok());
  EXPECT_NE(other_run.error().message.find("does not write"), std::string::npos);
  ASSERT_FALSE(compressed.ok());
  ASSERT_FALSE(too_short.ok());
  EXPECT_EQ(too_short.error().message, "holds 15 ticks of the 16 that were written to it");
  EXPECT_EQ(read_bytes(path + ".tmp~"), before);
}

TEST(RunRecorder, WritesTheRunsHash) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("a.mcap");
  std::map<std::string, core::HashChain> chains;
  for (const auto& sample : samples_of_run(20)) {
    chains[std::string(domain::topic_name(sample.topic))].add(sample.tick, sample.tick, sample.cdr);
  }
  std::map<std::string, core::Hash128> values;
  for (const auto& [name, chain] : chains) values[name] = chain.value();

  record(path, samples_of_run(20));

  const auto recording = RunRecording::open(path);
  ASSERT_TRUE(recording.ok() && recording->end());
  EXPECT_EQ(recording->end()->ticks, 20U);
  EXPECT_EQ(recording->end()->hash, run_hash(values));
}

}  // namespace
}  // namespace clew::recording_test
