// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "recording/piece_files.hpp"
#include "sample_file.hpp"
#include "sample_run.hpp"
#include "scratch_directory.hpp"
#include "split_run.hpp"

namespace clew::recording_test {
namespace {

namespace fs = std::filesystem;

TEST(SplitRecording, IsInFilesByTimeAndReadAsOne) {
  const ScratchDirectory scratch;
  record_split(scratch.file("a.mcap"), split_by_time(), samples_of_run(20));

  EXPECT_EQ(files_in(scratch), (std::vector<std::string>{"a.mcap", "a_1.mcap", "a_2.mcap"}));
  const auto recording = RunRecording::open(scratch.file("a.mcap"));
  ASSERT_TRUE(recording.ok()) << recording.error().text();
  EXPECT_EQ(recording->pieces(), 3U);
  EXPECT_TRUE(recording->complete());
  EXPECT_EQ(read_samples(recording->samples()), samples_of_run(20));
  SampleFilter some;
  some.topics = {Topic::kScan};
  some.first_tick = 5;
  some.last_tick = 8;
  const auto scans = read_samples(recording->samples(some));
  ASSERT_EQ(scans.size(), 4U);
  EXPECT_EQ(scans.front().tick, 5U);
  EXPECT_EQ(scans.back().tick, 8U);
}

TEST(SplitRecording, HasTheHashOfOneFile) {
  const ScratchDirectory scratch;
  record(scratch.file("one.mcap"), samples_of_run(20));
  record_split(scratch.file("a.mcap"), split_by_time(), samples_of_run(20));

  const auto one = RunRecording::open(scratch.file("one.mcap"));
  const auto split = RunRecording::open(scratch.file("a.mcap"));

  ASSERT_TRUE(one.ok() && split.ok() && one->end() && split->end());
  EXPECT_EQ(split->end()->hash, one->end()->hash);
  EXPECT_EQ(split->end()->ticks, 20U);
  const auto survey = split->survey();
  ASSERT_TRUE(survey.ok()) << survey.error().text();
  EXPECT_EQ(survey->hash, one->end()->hash);
}

TEST(SplitRecording, GoesOnInAnotherFileFromASizeOn) {
  const ScratchDirectory scratch;
  RunDescription run = description();
  run.split.bytes = 6000;
  std::vector<StoredSample> samples = samples_of_run(60);
  for (StoredSample& sample : samples) sample.cdr.append(300, 'x');
  record_split(scratch.file("a.mcap"), run, samples);

  const auto recording = RunRecording::open(scratch.file("a.mcap"));
  ASSERT_TRUE(recording.ok()) << recording.error().text();
  EXPECT_GT(recording->pieces(), 5U);
  EXPECT_EQ(read_samples(recording->samples()), samples);
  for (std::uint64_t piece = 0; piece < recording->pieces(); ++piece) {
    // What every file repeats, a tick more, and the index at the end.
    EXPECT_LT(fs::file_size(piece_path(scratch.file("a.mcap"), piece)), 6000U + 9000U);
  }
}

TEST(SplitRecording, SaysWhichFileIsNotThere) {
  const ScratchDirectory scratch;
  record_split(scratch.file("a.mcap"), split_by_time(), samples_of_run(20));
  fs::remove(scratch.file("a_2.mcap"));

  const auto recording = RunRecording::open(scratch.file("a.mcap"));

  ASSERT_TRUE(recording.ok()) << recording.error().text();
  EXPECT_FALSE(recording->complete());
  EXPECT_EQ(recording->cut_off(), "lacks its next file, " + scratch.file("a_2.mcap"));
  EXPECT_EQ(read_samples(recording->samples()), samples_of_run(14));
}

TEST(SplitRecording, SaysWhichFilesItDoesNotRead) {
  const ScratchDirectory scratch;
  record_split(scratch.file("a.mcap"), split_by_time(), samples_of_run(20));
  fs::remove(scratch.file("a_1.mcap"));

  const auto recording = RunRecording::open(scratch.file("a.mcap"));

  ASSERT_TRUE(recording.ok()) << recording.error().text();
  EXPECT_EQ(recording->cut_off(), "lacks its next file, " + scratch.file("a_1.mcap") + "; " +
                                      scratch.file("a_2.mcap") +
                                      " is there, but is not read: it comes later");

  fs::rename(scratch.file("a_2.mcap"), scratch.file("b.mcap"));
  write_bytes(scratch.file("a_1.mcap.tmp~"), "");  // reserved by a recorder that died
  const auto died = RunRecording::open(scratch.file("a.mcap"));
  ASSERT_TRUE(died.ok()) << died.error().text();
  EXPECT_EQ(died->unread_piece(), "");
}

TEST(SplitRecording, IsOpenedByItsFirstFile) {
  const ScratchDirectory scratch;
  record_split(scratch.file("a.mcap"), split_by_time(), samples_of_run(20));

  const auto second = RunRecording::open(scratch.file("a_1.mcap"));

  ASSERT_FALSE(second.ok());
  EXPECT_NE(second.error().text().find("is file 2 of a recording that is split"),
            std::string::npos);
}

TEST(SplitRecording, DoesNotTakeAFileOfAnotherRecordingForItsOwn) {
  const ScratchDirectory scratch;
  record_split(scratch.file("a.mcap"), split_by_time(), samples_of_run(20));
  std::vector<StoredSample> others = samples_of_run(20);
  others[0].cdr += '!';
  record_split(scratch.file("b.mcap"), split_by_time(), others);
  fs::copy_file(scratch.file("b_1.mcap"), scratch.file("a_1.mcap"),
                fs::copy_options::overwrite_existing);

  const auto recording = RunRecording::open(scratch.file("a.mcap"));

  ASSERT_FALSE(recording.ok());
  EXPECT_NE(recording.error().text().find("does not follow"), std::string::npos);
}

TEST(SplitRecording, HasTheSameFilesAfterADeathAtEverySample) {
  const std::vector<StoredSample> samples = samples_of_run(20);
  const ScratchDirectory whole;
  record_split(whole.file("a.mcap"), split_by_time(), samples);
  for (std::size_t death = 0; death <= samples.size(); ++death) {
    const ScratchDirectory scratch;
    record_with_a_death(scratch.file("a.mcap"), split_by_time(), samples, death);
    ASSERT_EQ(files_in(scratch), files_in(whole)) << death;
    for (const std::string& name : files_in(whole)) {
      ASSERT_EQ(read_bytes(scratch.file(name)), read_bytes(whole.file(name))) << death << name;
    }
  }
}

TEST(SplitRecording, OpensUpToWhereItsRecorderDied) {
  const ScratchDirectory scratch;
  {
    auto recorder = RunRecorder::create(scratch.file("a.mcap"), split_by_time(), true);
    ASSERT_TRUE(recorder.ok());
    for (const auto& sample : samples_of_run(12)) ASSERT_TRUE(add(*recorder, sample).ok());
    ASSERT_TRUE(recorder->write_ahead().ok());
  }

  const auto recording = RunRecording::open(scratch.file("a.mcap.tmp~"));

  ASSERT_TRUE(recording.ok()) << recording.error().text();
  EXPECT_FALSE(recording->complete());
  EXPECT_EQ(read_samples(recording->samples()), samples_of_run(12));
}

TEST(ChosenTopics, AreAllThatARecordingHolds) {
  const ScratchDirectory scratch;
  RunDescription run = description();
  run.schemas.erase(Topic::kScan);
  run.left_out = {Topic::kScan};
  const core::Hash128 of_all{1, 2};
  auto recorder = RunRecorder::create(scratch.file("a.mcap"), run, true);
  ASSERT_TRUE(recorder.ok());
  for (const auto& sample : samples_of_run(5)) ASSERT_TRUE(add(*recorder, sample).ok());
  ASSERT_TRUE(recorder->finish({}, of_all).ok());

  const auto recording = RunRecording::open(scratch.file("a.mcap"));

  ASSERT_TRUE(recording.ok()) << recording.error().text();
  EXPECT_EQ(recording->description().left_out, std::set<Topic>{Topic::kScan});
  EXPECT_EQ(read_samples(recording->samples()).size(), 10U);
  ASSERT_TRUE(recording->end());
  EXPECT_EQ(recording->end()->ticks, 5U);
  EXPECT_EQ(recording->end()->run_hash, of_all);
  EXPECT_TRUE(recording->survey().ok());
}

TEST(Channels, TellTheirWritersQosAsRosbag2Does) {
  const ScratchDirectory scratch;
  record(scratch.file("a.mcap"), samples_of_run(2));

  const auto reader = mcap::McapReader::open(scratch.file("a.mcap"));

  ASSERT_TRUE(reader.ok());
  ASSERT_EQ(reader->channels().size(), 3U);
  for (const auto& [id, channel] : reader->channels()) {
    const auto qos = channel.metadata.find("offered_qos_profiles");
    ASSERT_NE(qos, channel.metadata.end()) << channel.topic;
    EXPECT_EQ(qos->second.find("- history: keep_last\n  depth: 512\n  reliability: reliable\n"
                               "  durability: transient_local\n"),
              0U);
  }
}

}  // namespace
}  // namespace clew::recording_test
