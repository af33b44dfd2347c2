// SPDX-License-Identifier: Apache-2.0
#include "recorder/recorder_process.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <future>

#include "../recording/scratch_directory.hpp"
#include "line/acceptor.hpp"
#include "recording/output_file.hpp"
#include "recording/run_recording.hpp"
#include "run/limits.hpp"
#include "short_run.hpp"

namespace clew::recorder_test {
namespace {

using Clock = std::chrono::steady_clock;

/// Longer than the slowest machine takes for any answer.
constexpr auto kPatient = std::chrono::seconds(60);

/// A run that has a recorder, which lives in a thread of this process.
class RecorderProcess : public testing::Test {
 protected:
  RecorderProcess() : lock_(DomainLock::take({})) {
    EXPECT_TRUE(lock_.ok());
    // The run has made the file before it has a recorder.
    EXPECT_TRUE(mcap::OutputFile::reserve(path_, false).ok());
  }

  void begin() {
    status_ = std::async(std::launch::async,
                         [domain = lock_->domain()] { return run_recorder_process(domain, 60.0); });
    Acceptor acceptor(*lock_);
    const auto deadline = Clock::now() + kPatient;
    while (link_ == nullptr && Clock::now() < deadline) {
      auto arrivals = acceptor.arrivals(Clock::now());
      if (!arrivals.empty()) {
        hello_ = arrivals[0].second;
        link_ = std::move(arrivals[0].first);
      }
    }
    ASSERT_NE(link_, nullptr);
  }

  void assign(const RecordingOrder& order, bool again = false) {
    link_->post(FrameType::kRecord, RecorderAssignment{order, again, 0});
  }
  void send(const std::string& spool) { link_->post_bytes(FrameType::kSamples, spool); }

  /// How the recording went, as the recorder says in the end; what it reported before is kept.
  RecordingAccount account() {
    while (true) {
      const auto frame = link_->wait_for_frame(Clock::now() + kPatient);
      if (!frame.ok()) {
        ADD_FAILURE() << frame.error().text();
        return {};
      }
      if (frame->type == FrameType::kKept) kept_ = *frame->as<Kept>();
      if (frame->type == FrameType::kRecorded) return *frame->as<RecordingAccount>();
    }
  }

  /// Until the recorder has reported that it keeps so many ticks.
  void wait_until_kept(std::uint64_t ticks) {
    while (kept_.ticks < ticks) {
      const auto frame = link_->wait_for_frame(Clock::now() + kPatient);
      ASSERT_TRUE(frame.ok()) << frame.error().text();
      if (frame->type == FrameType::kKept) kept_ = *frame->as<Kept>();
    }
  }

  int status() { return status_.get(); }

  recording_test::ScratchDirectory directory_;
  std::string path_ = directory_.file("run.mcap");
  core::Result<DomainLock> lock_;
  std::unique_ptr<Link> link_;
  Hello hello_;
  Kept kept_;
  std::future<int> status_;
};

TEST_F(RecorderProcess, RecordsWhatTheRunSendsAndSaysHowItWent) {
  begin();
  EXPECT_EQ(hello_.stage, kRecorderName);
  EXPECT_EQ(hello_.idl_fingerprint, idl_fingerprint());
  assign(order_at(path_));
  send(quiet_ticks(0, 40));
  send(spooled(domain::Incident{7, "refused", "sense", "a sample of tick 7 was refused"}));
  send(spooled(domain::Intervention{9, 9, {"goal=1,2"}, {}, {}}));
  std::string state;
  append_to_spool(SpooledState{"drive", 64, "of drive"}, state);
  send(state);  // only a black box keeps it
  send(quiet_ticks(40, 80));
  link_->post(FrameType::kRecordingEnd, Text{""});

  const RecordingAccount told = account();

  EXPECT_EQ(told.failure, "");
  EXPECT_EQ(told.lost_samples, 0U);
  EXPECT_EQ(status(), 0);
  const auto recording = RunRecording::open(mcap::OutputFile::temporary_name(path_));
  ASSERT_TRUE(recording.ok()) << recording.error().text();
  EXPECT_EQ(last_tick(*recording), 79U);
  ASSERT_EQ(recording->incidents().size(), 1U);
  EXPECT_EQ(recording->incidents()[0].text, "a sample of tick 7 was refused");
  ASSERT_EQ(recording->interventions().size(), 1U);
  EXPECT_EQ(recording->interventions()[0].tick, 9U);
}

TEST_F(RecorderProcess, SaysSoWhereThereIsNoRun) {
  EXPECT_EQ(run_recorder_process(lock_->domain() + 1, 0.0), 1);
}

TEST_F(RecorderProcess, EndsWhereTheRunHasNoPlaceForIt) {
  begin();
  link_->post(FrameType::kNotice, Text{"no"});

  EXPECT_EQ(status(), 1);
}

TEST_F(RecorderProcess, EndsWithARunThatGoesAwayBeforeItSaysWhat) {
  begin();
  link_.reset();

  EXPECT_EQ(status(), 1);
}

TEST_F(RecorderProcess, EndsWithARunThatGoesAwayMeanwhile) {
  begin();
  assign(order_at(path_));
  send(quiet_ticks(0, 4));
  link_.reset();

  EXPECT_EQ(status(), 1);
}

TEST_F(RecorderProcess, SaysWhyItCannotBegin) {
  begin();
  assign(order_at(directory_.file("no/such/folder/run.mcap")));

  EXPECT_NE(account().failure.find("No such file or directory"), std::string::npos);
  EXPECT_EQ(status(), 1);
}

TEST_F(RecorderProcess, SaysThatWhatWentIntoAPipeCannotBeReadBack) {
  begin();
  assign(order_at("/dev/null"), true);

  EXPECT_EQ(account().failure,
            "/dev/null: what the recorder wrote there before it died cannot be read back");
  EXPECT_EQ(status(), 1);
}

TEST_F(RecorderProcess, GivesUpWhenASpoolIsDamaged) {
  begin();
  assign(order_at(path_));
  send("no spool");

  EXPECT_EQ(account().failure, "a component sent a damaged spool");
  EXPECT_EQ(status(), 1);
}

TEST_F(RecorderProcess, GivesUpWhenASampleIsRefused) {
  begin();
  assign(order_at(path_));
  send(spooled_sample(domain::Target(), 0) + quiet_ticks(0, 4));

  EXPECT_NE(account().failure, "");
  EXPECT_EQ(status(), 1);
}

TEST_F(RecorderProcess, ReportsWhatItHasKept) {
  begin();
  // A black box that nothing has made write forgets what it cannot need.
  assign(order_at(path_, 1.0));
  send(quiet_ticks(0, 200));
  wait_until_kept(200);
  EXPECT_EQ(kept_.ticks, 200U);

  link_->post(FrameType::kRecordingEnd, Text{""});

  EXPECT_TRUE(account().nothing);
  EXPECT_EQ(status(), 0);
}

}  // namespace
}  // namespace clew::recorder_test
