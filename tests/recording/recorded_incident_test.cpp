// SPDX-License-Identifier: Apache-2.0
#include "recording/recorded_incident.hpp"

#include <gtest/gtest.h>

#include "recording/run_hash.hpp"
#include "recording/run_recorder.hpp"
#include "recording/run_recording.hpp"
#include "sample_run.hpp"
#include "scratch_directory.hpp"

namespace clew::recording_test {
namespace {

TEST(RecordedIncident, ReadsWhatItWrote) {
  const auto found =
      incident_from_json(7, to_json(domain::Incident{1, "refused", "control", "a \"writer\""}));

  ASSERT_TRUE(found);
  EXPECT_EQ(found->tick, 7u);
  EXPECT_EQ(found->kind, "refused");
  EXPECT_EQ(found->stage, "control");
  EXPECT_EQ(found->text, "a \"writer\"");
}

TEST(RecordedIncident, IsNothingElse) {
  for (const char* json : {"", "{", "[]", "{}", R"({"kind": "refused", "stage": "control"})",
                           R"({"kind": 1, "stage": "control", "text": ""})"}) {
    EXPECT_FALSE(incident_from_json(7, json)) << json;
  }
}

TEST(RecordedIncident, SteersNoTerminalWhoeverWroteIt) {
  const auto found =
      incident_from_json(7, R"({"kind": "refused", "stage": "run", "text": "\u001b[2J"})");

  ASSERT_TRUE(found);
  EXPECT_EQ(found->text, "\\x1b[2J");
}

/// Records ticks below `end`; an incident of tick 5 is told when tick 30 is written.
void record(RunRecorder& recorder, std::uint64_t end) {
  for (const StoredSample& sample : samples_of_run(end)) {
    if (sample.tick == 31) recorder.add_incident({5, domain::kForeignReader, "drive", "a reader"});
    ASSERT_TRUE(recorder.add(sample.topic, sample.tick, sample.tick, sample.cdr).ok());
  }
}

TEST(RecordedIncident, StandsBeforeTheNextTickOrAfterTheLast) {
  const ScratchDirectory scratch;
  const std::string path = scratch.file("a.mcap");
  auto recorder = RunRecorder::create(path, description(), false);
  ASSERT_TRUE(recorder.ok());

  record(*recorder, 200);
  recorder->add_incident({5, domain::kForeignReader, "drive", "a reader"});
  recorder->add_incident({999, domain::kRefused, "run", "after all"});
  ASSERT_TRUE(recorder->finish().ok());
  const auto recording = RunRecording::open(path);
  ASSERT_TRUE(recording.ok()) << recording.error().text();

  const auto& found = recording->incidents();
  ASSERT_EQ(found.size(), 2u) << "the same is written once";
  EXPECT_EQ(found[0].tick, 31u);
  EXPECT_EQ(found[0].text, "a reader");
  EXPECT_EQ(found[1].tick, 200u);
  EXPECT_EQ(found[1].text, "after all");
}

TEST(RecordedIncident, IsInNoHashAndChangesNoSample) {
  const ScratchDirectory scratch;
  auto without = RunRecorder::create(scratch.file("without.mcap"), description(), false);
  auto with = RunRecorder::create(scratch.file("with.mcap"), description(), false);
  ASSERT_TRUE(without.ok() && with.ok());

  with->add_incident({0, domain::kRefused, "run", "before all"});
  record(*with, 200);
  for (const StoredSample& sample : samples_of_run(200)) {
    ASSERT_TRUE(without->add(sample.topic, sample.tick, sample.tick, sample.cdr).ok());
  }
  ASSERT_TRUE(with->finish().ok());
  ASSERT_TRUE(without->finish().ok());
  const auto undisturbed = RunRecording::open(scratch.file("without.mcap"));
  const auto disturbed = RunRecording::open(scratch.file("with.mcap"));
  ASSERT_TRUE(undisturbed.ok() && disturbed.ok());

  EXPECT_EQ(disturbed->incidents().size(), 2u);
  EXPECT_TRUE(disturbed->interventions().empty()) << "nobody has changed the run";
  EXPECT_EQ(read_samples(disturbed->samples()), read_samples(undisturbed->samples()));
  ASSERT_TRUE(disturbed->survey().ok());
  EXPECT_EQ(disturbed->survey()->hash, undisturbed->survey()->hash);
}

TEST(RecordedIncident, IsKeptByARecorderThatGoesOn) {
  const ScratchDirectory scratch;
  auto whole = RunRecorder::create(scratch.file("whole.mcap"), description(), false);
  ASSERT_TRUE(whole.ok());
  record(*whole, 200);
  ASSERT_TRUE(whole->finish().ok());

  {
    auto killed = RunRecorder::create(scratch.file("again.mcap"), description(), false);
    ASSERT_TRUE(killed.ok());
    record(*killed, 100);
    ASSERT_TRUE(killed->write_ahead().ok());
  }
  auto again = RunRecorder::go_on(scratch.file("again.mcap"), description());
  ASSERT_TRUE(again.ok()) << again.error().text();
  record(*again, 200);
  ASSERT_TRUE(again->finish().ok());

  EXPECT_EQ(read_bytes(scratch.file("again.mcap")), read_bytes(scratch.file("whole.mcap")));
}

}  // namespace
}  // namespace clew::recording_test
