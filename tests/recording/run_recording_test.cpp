// SPDX-License-Identifier: Apache-2.0
#include "recording/run_recording.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "recording/mcap_writer.hpp"
#include "recording/run_hash.hpp"
#include "sample_run.hpp"
#include "scratch_directory.hpp"

namespace clew::recording_test {
namespace {

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
  ASSERT_TRUE(recording.ok()) << recording.error().text();
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
  ASSERT_TRUE(survey.ok()) << survey.error().text();
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
  ASSERT_TRUE(recording.ok()) << recording.error().text();

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
    if (!recording.ok()) {
      ASSERT_EQ(readable_before, 0U) << recording.error().text();
      continue;
    }
    ASSERT_FALSE(recording->complete());
    const auto found = read_samples(recording->samples());
    ASSERT_GE(found.size(), readable_before);
    ASSERT_TRUE(std::equal(found.begin(), found.end(), samples.begin()));
    ASSERT_TRUE(recording->survey().ok());
    readable_before = found.size();
  }

  EXPECT_EQ(readable_before, samples.size());
}

TEST(RunRecording, LosesNothingThatWasWrittenAhead) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("run.mcap");
  {
    auto recorder = RunRecorder::create(path, description(), false);
    ASSERT_TRUE(recorder.ok());
    for (const auto& sample : samples_of_run(100)) {
      ASSERT_TRUE(recorder->add(sample.topic, sample.tick, sample.tick, sample.cdr).ok());
    }
    ASSERT_TRUE(recorder->write_ahead().ok());
  }

  const auto recording = RunRecording::open(path + ".tmp~");

  ASSERT_TRUE(recording.ok()) << recording.error().text();
  EXPECT_EQ(read_samples(recording->samples()), samples_of_run(100));
}

TEST(RunRecording, LosesAtMostASecondOfACrashedRun) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("run.mcap");
  constexpr std::uint64_t kTicks = 100;
  {
    auto recorder = RunRecorder::create(path, description(), false);
    ASSERT_TRUE(recorder.ok());
    for (const auto& sample : samples_of_run(kTicks)) {
      ASSERT_TRUE(recorder->add(sample.topic, sample.tick, sample.tick, sample.cdr).ok());
    }
  }

  const auto recording = RunRecording::open(path + ".tmp~");

  ASSERT_TRUE(recording.ok()) << recording.error().text();
  EXPECT_FALSE(recording->complete());
  const auto survey = recording->survey();
  ASSERT_TRUE(survey.ok());
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

  ASSERT_FALSE(recording.ok());
  EXPECT_EQ(recording.error().text(),
            path +
                ": its metadata record 'clew' does not match its digest: some of its bytes were "
                "changed");
}

TEST(RunRecording, RefusesAnMcapFileOfSomethingElse) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("other.mcap");
  auto writer = mcap::McapWriter::create(path, false, {});
  ASSERT_TRUE(writer.ok() && writer->finish().ok());

  const auto recording = RunRecording::open(path);

  ASSERT_FALSE(recording.ok());
  EXPECT_EQ(recording.error().text(),
            path + ": is no recording of a run: it has no metadata record 'clew'");
}

TEST(RunRecording, NoticesSamplesThatAreNotThoseOfTheRun) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("forged.mcap");
  auto writer = mcap::McapWriter::create(path, false, {});
  ASSERT_TRUE(writer.ok() && writer->write(to_metadata(description())).ok());
  const auto schema = writer->add_schema("clew::msg::Scan", "omgidl", "struct Scan {};");
  const auto channel = writer->add_channel(schema, "/scan", "cdr");
  ASSERT_TRUE(writer->write(mcap::Message{channel, 0, 0, 0, "x"}).ok());
  ASSERT_TRUE(writer->write(to_metadata(RunEnd{1, {1, 1}, 0, {}})).ok());
  ASSERT_TRUE(writer->finish().ok());

  const auto recording = RunRecording::open(path);
  ASSERT_TRUE(recording.ok()) << recording.error().text();
  const auto survey = recording->survey();

  ASSERT_FALSE(survey.ok());
  EXPECT_NE(survey.error().message.find("its recorder wrote 00000000000000010000000000000001"),
            std::string::npos);
}

}  // namespace
}  // namespace clew::recording_test
