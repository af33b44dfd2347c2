// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "recording/output_file.hpp"
#include "recording/piece_files.hpp"
#include "sample_run.hpp"
#include "scratch_directory.hpp"
#include "split_run.hpp"
#include "tests/few_open_files.hpp"

namespace clew::recording_test {
namespace {

namespace fs = std::filesystem;

TEST(SplitRecording, ReplacesNoFileOfItsNamesUnlessToldTo) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("a.mcap");
  write_bytes(scratch.file("a_2.mcap"), "somebody's");

  const auto checked = check_no_pieces(path);
  ASSERT_FALSE(checked.ok());
  EXPECT_EQ(checked.error().text(), scratch.file("a_2.mcap") + ": exists; --force overwrites it");
  core::Result<void> state;
  {
    auto recorder = RunRecorder::create(path, split_by_time(), false);
    ASSERT_TRUE(recorder.ok());
    for (const auto& sample : samples_of_run(20)) {
      if (state.ok()) state = add(*recorder, sample);
    }
  }
  ASSERT_FALSE(state.ok());
  EXPECT_NE(state.error().text().find("a_2.mcap: exists"), std::string::npos);
  EXPECT_EQ(read_bytes(scratch.file("a_2.mcap")), "somebody's");

  record_split(path, split_by_time(), samples_of_run(20));
  EXPECT_EQ(RunRecording::open(path)->pieces(), 3U);
}

TEST(SplitRecording, ReplacesNoFileThatAppearsWhileItIsWritten) {
  const ScratchDirectory scratch;
  auto recorder = RunRecorder::create(scratch.file("a.mcap"), split_by_time(), false);
  ASSERT_TRUE(recorder.ok());
  for (const auto& sample : samples_of_run(10)) ASSERT_TRUE(add(*recorder, sample).ok());
  ASSERT_TRUE(fs::exists(scratch.file("a_1.mcap.tmp~")));
  write_bytes(scratch.file("a_1.mcap"), "somebody's");

  EXPECT_FALSE(recorder->finish().ok());

  EXPECT_EQ(read_bytes(scratch.file("a_1.mcap")), "somebody's");
}

/// Leaves what a recorder of 20 ticks had written when it died, in three files.
void die(const std::string& path) {
  auto recorder = RunRecorder::create(path, split_by_time(), true);
  ASSERT_TRUE(recorder.ok());
  for (const auto& sample : samples_of_run(20)) ASSERT_TRUE(add(*recorder, sample).ok());
  ASSERT_TRUE(recorder->write_ahead().ok());
}

TEST(SplitRecording, LosesNothingToARecorderThatCannotReadALaterFile) {
  for (const char* const name : {"a_1.mcap", "a_2.mcap.tmp~"}) {
    const ScratchDirectory scratch;
    die(scratch.file("a.mcap"));
    const std::string first = read_bytes(scratch.file("a.mcap.tmp~"));
    write_bytes(scratch.file(name), "no recording, but of somebody's worth");

    const auto recorder = RunRecorder::go_on(scratch.file("a.mcap"), split_by_time());

    ASSERT_FALSE(recorder.ok()) << name;
    EXPECT_NE(recorder.error().text().find(name), std::string::npos) << recorder.error().text();
    EXPECT_EQ(read_bytes(scratch.file("a.mcap.tmp~")), first);
    EXPECT_EQ(read_bytes(scratch.file(name)), "no recording, but of somebody's worth");
  }
}

TEST(RunRecorder, LeavesAFileThatIsNoBeginningOfARecording) {
  const ScratchDirectory scratch;
  const std::string there = scratch.file("a.mcap.tmp~");
  record(scratch.file("whole.mcap"), samples_of_run(5));
  const std::string whole = read_bytes(scratch.file("whole.mcap"));
  std::string damaged = whole;
  damaged[damaged.find("idl_fingerprint")] ^= 1;
  for (const std::string& bytes : {std::string("no recording at all, but a text"), damaged}) {
    write_bytes(there, bytes);
    EXPECT_FALSE(RunRecorder::go_on(scratch.file("a.mcap"), description()).ok());
    EXPECT_EQ(read_bytes(there), bytes);
  }
  const std::string begun = whole.substr(0, 100);
  write_bytes(there, begun);
  EXPECT_FALSE(RunRecorder::go_on(scratch.file("a.mcap"), description(), 3).ok());
  EXPECT_EQ(read_bytes(there), begun);
}

TEST(SplitRecording, IsLockedAsLongAsItIsWritten) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("a.mcap");
  const auto expect_locked = [&] {
    const auto reserved = mcap::OutputFile::reserve(path, true);
    ASSERT_FALSE(reserved.ok());
    EXPECT_NE(reserved.error().message.find("written by another process"), std::string::npos);
    EXPECT_FALSE(RunRecorder::go_on(path, split_by_time()).ok());
    EXPECT_FALSE(mcap::OutputFile::remove(scratch.file("a_1.mcap.tmp~")).ok());
  };
  {
    auto recorder = RunRecorder::create(path, split_by_time(), true);
    ASSERT_TRUE(recorder.ok());
    for (const auto& sample : samples_of_run(10)) ASSERT_TRUE(add(*recorder, sample).ok());
    ASSERT_TRUE(recorder->write_ahead().ok());
    expect_locked();
  }
  auto recorder = RunRecorder::go_on(path, split_by_time());
  ASSERT_TRUE(recorder.ok()) << recorder.error().text();
  expect_locked();
  ASSERT_TRUE(recorder->finish().ok());
  EXPECT_TRUE(RunRecording::open(path)->complete());
}

TEST(SplitRecording, CountsNoDescriptionAsSize) {
  const ScratchDirectory scratch;
  RunDescription run = description();
  run.split.bytes = 1000;
  run.bundle["world.yaml"] = std::string(50000, '#');
  record_split(scratch.file("a.mcap"), run, samples_of_run(20));

  const auto recording = RunRecording::open(scratch.file("a.mcap"));

  ASSERT_TRUE(recording.ok()) << recording.error().text();
  EXPECT_GT(recording->pieces(), 1U);
  EXPECT_LT(recording->pieces(), 8U);  // by the samples; were the world counted, 20
  EXPECT_EQ(read_samples(recording->samples()), samples_of_run(20));
}

TEST(SplitRecording, LiesBesideTheFileThatALinkLeadsTo) {
  const ScratchDirectory scratch;
  fs::create_directory(scratch.file("far"));
  write_bytes(scratch.file("far/b.mcap"), "older");
  fs::create_symlink(scratch.file("far/b.mcap"), scratch.file("a.mcap"));
  const std::vector<StoredSample> samples = samples_of_run(20);
  record_with_a_death(scratch.file("a.mcap"), split_by_time(), samples, samples.size());

  EXPECT_EQ(files_in(scratch), (std::vector<std::string>{"a.mcap", "far"}));
  for (const char* const name : {"a.mcap", "far/b.mcap"}) {
    const auto recording = RunRecording::open(scratch.file(name));
    ASSERT_TRUE(recording.ok()) << recording.error().text();
    EXPECT_EQ(recording->pieces(), 3U);
    EXPECT_EQ(read_samples(recording->samples()), samples);
  }
}

TEST(SplitRecording, IsReadWhereEachOfItsFilesIsALink) {
  const ScratchDirectory scratch;
  fs::create_directory(scratch.file("store"));
  record_split(scratch.file("a.mcap"), split_by_time(), samples_of_run(20));
  for (const char* const name : {"a.mcap", "a_1.mcap", "a_2.mcap"}) {
    const std::string stored = scratch.file(std::string("store/of-") + name);
    fs::rename(scratch.file(name), stored + ".bin");
    fs::create_symlink(stored + ".bin", scratch.file(name));
  }

  const auto recording = RunRecording::open(scratch.file("a.mcap"));

  ASSERT_TRUE(recording.ok()) << recording.error().text();
  EXPECT_EQ(recording->pieces(), 3U);
}

/// A file for each of `ticks` ticks.
void record_files(const std::string& path, std::uint64_t ticks) {
  RunDescription run = description();
  run.split.seconds = run.tick_s;
  record_split(path, run, samples_of_run(ticks));
}

TEST(SplitRecording, NamesTheLimitOfOpenFiles) {
  const ScratchDirectory scratch;
  record(scratch.file("a.mcap"), samples_of_run(2));
  const FewOpenFiles none(0);
  const auto recording = RunRecording::open(scratch.file("a.mcap"));

  ASSERT_FALSE(recording.ok());
  EXPECT_NE(recording.error().text().find("this process may have " + std::to_string(none.limit()) +
                                          " (ulimit -n)"),
            std::string::npos)
      << recording.error().text();
}

TEST(SplitRecording, MayHaveMoreFilesThanAProcessMayOpen) {
  const ScratchDirectory scratch;
  constexpr std::uint64_t kFiles = 3 * mcap::InputFile::kMostOpen;
  record_files(scratch.file("a.mcap"), kFiles);
  for (const rlim_t more : {rlim_t{1}, rlim_t{mcap::InputFile::kMostOpen}}) {
    const FewOpenFiles few(more);
    const auto recording = RunRecording::open(scratch.file("a.mcap"));
    ASSERT_TRUE(recording.ok()) << recording.error().text();

    EXPECT_EQ(recording->pieces(), kFiles);
    EXPECT_TRUE(recording->complete());
    EXPECT_EQ(read_samples(recording->samples()), samples_of_run(kFiles));
    EXPECT_TRUE(recording->survey().ok());
  }
}

TEST(SplitRecording, LeavesRoomForOtherFiles) {
  const ScratchDirectory scratch;
  record_files(scratch.file("a.mcap"), 3 * mcap::InputFile::kMostOpen);
  const FewOpenFiles few(mcap::InputFile::kMostOpen + 1);
  const auto recording = RunRecording::open(scratch.file("a.mcap"));
  ASSERT_TRUE(recording.ok()) << recording.error().text();

  const int other = ::open("/dev/null", O_RDONLY | O_CLOEXEC);

  EXPECT_GE(other, 0);
  ::close(other);
}

TEST(SplitRecording, IsReadToTheEndWhileItsFilesGetTheirNames) {
  const ScratchDirectory scratch;
  constexpr std::uint64_t kFiles = 2 * mcap::InputFile::kMostOpen;
  record_files(scratch.file("a.mcap"), kFiles);
  fs::rename(scratch.file("a.mcap"), scratch.file("a.mcap.tmp~"));
  const auto recording = RunRecording::open(scratch.file("a.mcap.tmp~"));
  ASSERT_TRUE(recording.ok()) << recording.error().text();
  EXPECT_EQ(recording->pieces(), kFiles);

  fs::rename(scratch.file("a.mcap.tmp~"), scratch.file("a.mcap"));

  EXPECT_EQ(read_samples(recording->samples()), samples_of_run(kFiles));
}

TEST(SplitRecording, IsRefusedWhereAFileWasReplacedWhileItWasRead) {
  const ScratchDirectory scratch;
  record_files(scratch.file("a.mcap"), 2 * mcap::InputFile::kMostOpen);
  const auto recording = RunRecording::open(scratch.file("a.mcap"));
  ASSERT_TRUE(recording.ok()) << recording.error().text();

  fs::copy_file(scratch.file("a.mcap"), scratch.file("other"));
  fs::rename(scratch.file("other"), scratch.file("a.mcap"));
  const auto survey = recording->survey();

  ASSERT_FALSE(survey.ok());
  EXPECT_EQ(survey.error().text(),
            scratch.file("a.mcap") + ": is another file than when it was opened");
}

}  // namespace
}  // namespace clew::recording_test
