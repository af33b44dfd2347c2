// SPDX-License-Identifier: Apache-2.0
#include "recording/run_recording.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "core/random.hpp"
#include "recording/mcap_writer.hpp"
#include "recording/run_hash.hpp"
#include "recording/run_recorder.hpp"
#include "scratch_directory.hpp"

namespace clew::recording_test {
namespace {

using namespace bridge;
using domain::Topic;

/// A sample that owns its bytes.
struct StoredSample {
  Topic topic = Topic::kCommand;
  std::uint64_t tick = 0;
  std::string cdr;
};

bool operator==(const StoredSample& a, const StoredSample& b) {
  return std::tie(a.topic, a.tick, a.cdr) == std::tie(b.topic, b.tick, b.cdr);
}

RunDescription description() {
  RunDescription run;
  run.tick_s = 0.3;
  run.seed = 42;
  run.versions = {{"clew", "0.1.0"}};
  run.idl_fingerprint = "00112233445566778899aabbccddeeff";
  run.bundle = {{"graph.yaml", "world: u-trap\n"}, {"world.yaml", "name: u-trap\n"}};
  run.schemas = {{Topic::kCommand, "struct Command {};"},
                 {Topic::kScan, "struct Scan {};"},
                 {Topic::kState, "struct State {};"}};
  return run;
}

std::string bytes_of(Topic topic, std::uint64_t tick) {
  return std::string(domain::topic_name(topic)) + std::string(tick % 7, '.') + std::to_string(tick);
}

/// The samples of a run of `ticks` ticks, in canonical order.
std::vector<StoredSample> samples_of_run(std::uint64_t ticks) {
  std::vector<StoredSample> samples;
  for (std::uint64_t tick = 0; tick < ticks; ++tick) {
    for (const auto& [topic, schema] : description().schemas) {
      samples.push_back({topic, tick, bytes_of(topic, tick)});
    }
  }
  return samples;
}

void record(const std::string& path, const std::vector<StoredSample>& samples,
            mcap::Compression compression = mcap::Compression::kNone) {
  auto recorder = RunRecorder::create(path, description(), {true, compression});
  ASSERT_TRUE(recorder) << recorder.error().text();
  for (const auto& sample : samples) {
    const auto added = recorder->add(sample.topic, sample.tick, sample.tick, sample.cdr);
    ASSERT_TRUE(added) << added.error().text();
  }
  const auto finished = recorder->finish();
  ASSERT_TRUE(finished) << finished.error().text();
}

std::vector<StoredSample> read_samples(SampleStream stream) {
  std::vector<StoredSample> samples;
  for (;;) {
    const auto sample = stream.next();
    EXPECT_TRUE(sample) << sample.error().text();
    if (!sample || !*sample) return samples;
    EXPECT_EQ((*sample)->sequence, (*sample)->tick);
    samples.push_back({(*sample)->topic, (*sample)->tick, std::string((*sample)->cdr)});
  }
}

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
  ASSERT_TRUE(recording) << recording.error().text();
  EXPECT_EQ(read_samples(recording->samples()), canonical);
}

TEST(RunRecorder, WritesATickOnceEveryTopicHasDeliveredIt) {
  const ScratchDirectory scratch;
  auto recorder = RunRecorder::create(scratch.file("a.mcap"), description(), {});
  ASSERT_TRUE(recorder);

  ASSERT_TRUE(recorder->add(Topic::kScan, 0, 0, "x"));
  ASSERT_TRUE(recorder->add(Topic::kScan, 1, 1, "x"));
  ASSERT_TRUE(recorder->add(Topic::kState, 0, 0, "x"));
  EXPECT_EQ(recorder->complete_ticks(), 0U);
  ASSERT_TRUE(recorder->add(Topic::kCommand, 0, 0, "x"));

  EXPECT_EQ(recorder->complete_ticks(), 1U);
}

TEST(RunRecorder, RefusesASampleThatIsOutOfOrder) {
  const ScratchDirectory scratch;
  auto recorder = RunRecorder::create(scratch.file("a.mcap"), description(), {});
  ASSERT_TRUE(recorder);
  ASSERT_TRUE(recorder->add(Topic::kScan, 0, 0, "x"));

  const auto skipped = recorder->add(Topic::kScan, 2, 2, "x");
  const auto repeated = recorder->add(Topic::kScan, 0, 0, "x");
  const auto late = recorder->add(Topic::kState, 1, 0, "x");
  const auto unknown = recorder->add(Topic::kEvent, 0, 0, "x");

  ASSERT_FALSE(skipped);
  EXPECT_EQ(skipped.error().message, "topic scan: tick 2 follows tick 0");
  ASSERT_FALSE(repeated);
  EXPECT_EQ(repeated.error().message, "topic scan: tick 0 follows tick 0");
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().message, "topic state: begins at tick 1, the recording at tick 0");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().message, "topic event: is not part of this recording");
}

TEST(RunRecorder, RefusesATopicThatIsTooFarAhead) {
  const ScratchDirectory scratch;
  auto recorder = RunRecorder::create(scratch.file("a.mcap"), description(), {});
  ASSERT_TRUE(recorder);
  for (std::uint64_t tick = 0; tick < RunRecorder::kMaxWaitingTicks; ++tick) {
    ASSERT_TRUE(recorder->add(Topic::kScan, tick, tick, "x"));
  }

  const auto refused = recorder->add(Topic::kScan, RunRecorder::kMaxWaitingTicks, 0, "x");

  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "topic scan: is 65536 ticks ahead of another topic");
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
  ASSERT_TRUE(recording && recording->end());
  EXPECT_EQ(recording->end()->ticks, 20U);
  EXPECT_EQ(recording->end()->hash, run_hash(values));
}

TEST(RunHash, IsAFunctionOfNamesAndChains) {
  const core::Hash128 a{1, 2};
  const core::Hash128 b{3, 4};

  EXPECT_NE(run_hash({{"scan", a}, {"state", b}}), run_hash({{"scan", b}, {"state", a}}));
  EXPECT_NE(run_hash({{"scan", a}}), run_hash({{"state", a}}));
  EXPECT_EQ(run_hash({{"scan", a}, {"state", b}}),
            core::hash128("scan 00000000000000010000000000000002\n"
                          "state 00000000000000030000000000000004\n"));
}

class RunRecordingOf : public testing::TestWithParam<mcap::Compression> {};

TEST_P(RunRecordingOf, ARunGivesEverythingBack) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("run.mcap");
  const std::vector<StoredSample> samples = samples_of_run(100);

  record(path, samples, GetParam());
  const auto recording = RunRecording::open(path);
  ASSERT_TRUE(recording) << recording.error().text();
  const auto survey = recording->survey();

  EXPECT_TRUE(recording->complete());
  const RunDescription expected = description();
  const RunDescription& found = recording->description();
  EXPECT_EQ(found.tick_s, expected.tick_s);
  EXPECT_EQ(found.seed, expected.seed);
  EXPECT_EQ(found.versions, expected.versions);
  EXPECT_EQ(found.idl_fingerprint, expected.idl_fingerprint);
  EXPECT_EQ(found.bundle, expected.bundle);
  EXPECT_EQ(found.schemas, expected.schemas);
  EXPECT_EQ(read_samples(recording->samples()), samples);
  ASSERT_TRUE(survey) << survey.error().text();
  EXPECT_EQ(survey->hash, recording->end()->hash);
  EXPECT_EQ(survey->topics.at(Topic::kScan).samples, 100U);
  EXPECT_EQ(survey->topics.at(Topic::kScan).last_tick, 99U);
  EXPECT_EQ(survey->topics.at(Topic::kScan).missing_ticks, 0U);
}

INSTANTIATE_TEST_SUITE_P(Compressions, RunRecordingOf,
                         testing::Values(mcap::Compression::kNone, mcap::Compression::kZstd,
                                         mcap::Compression::kLz4));

TEST(RunRecording, GivesTheTicksAndTopicsAskedFor) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("run.mcap");
  record(path, samples_of_run(100));
  const auto recording = RunRecording::open(path);
  ASSERT_TRUE(recording) << recording.error().text();

  const auto scans = read_samples(recording->samples({{Topic::kScan}, 41, 43}));
  const auto events = read_samples(recording->samples({{Topic::kEvent}}));

  EXPECT_EQ(scans, (std::vector<StoredSample>{{Topic::kScan, 41, bytes_of(Topic::kScan, 41)},
                                              {Topic::kScan, 42, bytes_of(Topic::kScan, 42)},
                                              {Topic::kScan, 43, bytes_of(Topic::kScan, 43)}}));
  EXPECT_TRUE(events.empty());
}

TEST(RunRecording, FindsEveryTickAgainByItsTime) {
  for (const double tick_s : {0.3, 0.1, 0.05, 1.0 / 3.0}) {
    for (std::uint64_t tick = 0; tick < 2'000'000; tick += 997) {
      ASSERT_EQ(ns_to_tick(tick_to_ns(tick, tick_s), tick_s), tick) << tick_s;
    }
  }
}

TEST(RunRecording, OpensUpToTheTearAtAnyByte) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("run.mcap");
  const std::vector<StoredSample> samples = samples_of_run(12);
  record(path, samples);
  const std::string whole = read_bytes(path);
  std::size_t readable_before = 0;

  for (std::size_t kept_bytes = 0; kept_bytes < whole.size(); ++kept_bytes) {
    write_bytes(path, std::string_view(whole).substr(0, kept_bytes));
    const auto recording = RunRecording::open(path);
    if (!recording) {
      ASSERT_EQ(readable_before, 0U) << recording.error().text();
      continue;
    }
    ASSERT_FALSE(recording->complete());
    const auto found = read_samples(recording->samples());
    ASSERT_GE(found.size(), readable_before);
    ASSERT_TRUE(std::equal(found.begin(), found.end(), samples.begin()));
    ASSERT_TRUE(recording->survey());
    readable_before = found.size();
  }

  EXPECT_EQ(readable_before, samples.size());
}

TEST(RunRecording, LosesAtMostASecondOfACrashedRun) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("run.mcap");
  constexpr std::uint64_t kTicks = 100;
  {
    auto recorder = RunRecorder::create(path, description(), {});
    ASSERT_TRUE(recorder);
    for (const auto& sample : samples_of_run(kTicks)) {
      ASSERT_TRUE(recorder->add(sample.topic, sample.tick, sample.tick, sample.cdr));
    }
  }

  const auto recording = RunRecording::open(path + ".tmp~");

  ASSERT_TRUE(recording) << recording.error().text();
  EXPECT_FALSE(recording->complete());
  const auto survey = recording->survey();
  ASSERT_TRUE(survey);
  // The last tick, 99, is at 29.7 s; the chunk of second 29, ticks 97 to 99, is lost.
  EXPECT_EQ(survey->topics.at(Topic::kState).last_tick, 96U);
}

TEST(RunRecording, NoticesAChangedDescription) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("run.mcap");
  record(path, samples_of_run(3));
  std::string bytes = read_bytes(path);
  const auto seed = bytes.find(
      "seed\x02\0\0\0"
      "42",
      0, 10);
  ASSERT_NE(seed, std::string::npos);
  bytes[seed + 8] = '5';
  write_bytes(path, bytes);

  const auto recording = RunRecording::open(path);

  ASSERT_FALSE(recording);
  EXPECT_EQ(recording.error().text(),
            path +
                ": its metadata record 'clew' does not match its digest: some of its bytes were "
                "changed");
}

TEST(RunRecording, RefusesAnMcapFileOfSomethingElse) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("other.mcap");
  auto writer = mcap::McapWriter::create(path, false, {});
  ASSERT_TRUE(writer && writer->finish());

  const auto recording = RunRecording::open(path);

  ASSERT_FALSE(recording);
  EXPECT_EQ(recording.error().text(),
            path + ": is no recording of a run: it has no metadata record 'clew'");
}

TEST(RunRecording, NoticesSamplesThatAreNotThoseOfTheRun) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("forged.mcap");
  auto writer = mcap::McapWriter::create(path, false, {});
  ASSERT_TRUE(writer && writer->write(to_metadata(description())));
  const auto schema = writer->add_schema("clew::msg::Scan", "omgidl", "struct Scan {};");
  const auto channel = writer->add_channel(schema, "/scan", "cdr");
  ASSERT_TRUE(writer->write(mcap::Message{channel, 0, 0, 0, "x"}));
  ASSERT_TRUE(writer->write(to_metadata(RunEnd{1, {1, 1}})));
  ASSERT_TRUE(writer->finish());

  const auto recording = RunRecording::open(path);
  ASSERT_TRUE(recording) << recording.error().text();
  const auto survey = recording->survey();

  ASSERT_FALSE(survey);
  EXPECT_NE(survey.error().message.find("its recorder wrote 00000000000000010000000000000001"),
            std::string::npos);
}

}  // namespace
}  // namespace clew::recording_test
