// SPDX-License-Identifier: Apache-2.0
/// Recordings on the wire, as others see them: programs that know nothing of clew but its IDL.
#include "replay/live_replay.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <iterator>

#include "../recording/scratch_directory.hpp"
#include "recorded_run.hpp"
#include "replay/live_checks.hpp"

namespace clew::replay_test {
namespace {

using namespace bridge;
using domain::Topic;
using recording_test::ScratchDirectory;
using Kind = PlaybackRequest::Kind;

/// Says what it is told to when the replay halts.
class Script : public PlaybackConsole {
 public:
  explicit Script(std::vector<PlaybackRequest> at_halts = {}) : at_halts_(std::move(at_halts)) {}

  int descriptor() const override { return -1; }
  std::vector<PlaybackRequest> take() override { return std::exchange(next_, {}); }
  void show(const LiveReplayStatus& status) override {
    if (!status.halted || !next_.empty()) return;
    halts_.push_back(status.next_tick);
    if (halts_.size() <= at_halts_.size()) next_ = {at_halts_[halts_.size() - 1]};
  }
  void log(const std::string&) override {}

  const std::vector<std::uint64_t>& halts() const { return halts_; }

 private:
  std::vector<PlaybackRequest> at_halts_;
  std::vector<PlaybackRequest> next_;
  std::vector<std::uint64_t> halts_;
};

std::vector<std::string> recorded_bytes(const RunRecording& recording, Topic topic,
                                        std::uint64_t first_tick, std::uint64_t last_tick) {
  std::vector<std::string> bytes;
  SampleStream stream = recording.samples({{topic}, first_tick, last_tick});
  for (auto sample = stream.next(); sample.ok() && *sample; sample = stream.next()) {
    bytes.emplace_back((*sample)->cdr);
  }
  return bytes;
}

/// What byte_reader wrote. Its vendor fills samples up to whole words; the recording does not.
std::vector<std::string> received_bytes(const std::string& path,
                                        const std::vector<std::string>& recorded) {
  std::ifstream stream(path, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(stream), {}};
  std::vector<std::string> samples;
  for (std::size_t place = 0; place + 4 <= all.size();) {
    std::size_t size = 0;
    for (std::size_t i = 4; i-- > 0;) {
      size = size * 256 + static_cast<unsigned char>(all[place + i]);
    }
    std::string sample = all.substr(place + 4, size);
    place += 4 + size;
    const std::size_t index = samples.size();
    if (index < recorded.size() && sample.size() - recorded[index].size() < 4) {
      sample.resize(recorded[index].size());
    }
    samples.push_back(std::move(sample));
  }
  return samples;
}

class LiveReplay : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    record_run(plan_of("krishna_kalra", in_world("u-trap", 300)), path("run.mcap"));
    recording_.emplace(open_recording(path("run.mcap")));
    plan_ = replay_plan(*recording_);
    options_.middleware = GetParam();
  }

  std::string path(const std::string& name) const { return directory_.file(name); }

  void read_with_byte_reader(Topic topic) {
    const std::string name(domain::topic_name(topic));
    options_.topics.set(index_of(topic));
    options_.readers.push_back(std::string("exec " CLEW_BYTE_READER " ") + name + ' ' + path(name));
  }

  LiveReplayReport replayed(PlaybackConsole& console) {
    const auto report = replay_live(*recording_, plan_, plan_, options_, console);
    EXPECT_TRUE(report.ok()) << report.error().text();
    if (!report.ok()) return {};
    EXPECT_EQ(report->stopped, "");
    return *report;
  }

  void expect_received(Topic topic, std::uint64_t first_tick, std::uint64_t last_tick) {
    const auto recorded = recorded_bytes(*recording_, topic, first_tick, last_tick);
    const auto received = received_bytes(path(std::string(domain::topic_name(topic))), recorded);
    EXPECT_EQ(recorded.size(), last_tick - first_tick + 1);
    EXPECT_EQ(received, recorded) << domain::topic_name(topic);
  }

  ScratchDirectory directory_;
  std::optional<RunRecording> recording_;
  runtime::RunPlan plan_;
  LiveReplayOptions options_;
};

INSTANTIATE_TEST_SUITE_P(Vendors, LiveReplay, testing::Values("cyclonedds", "fastdds"),
                         [](const auto& instance) { return instance.param; });

TEST_P(LiveReplay, AThirdPartyReceivesEveryTopicByteForByte) {
  for (Topic topic : domain::kAllTopics) read_with_byte_reader(topic);
  Script script;

  const LiveReplayReport report = replayed(script);

  // The run reached its target; its last tick is that of its recording.
  const std::uint64_t last_tick = report.ticks - 1;
  EXPECT_GT(report.ticks, 200u);
  EXPECT_EQ(report.samples.size(), domain::kTopicCount);
  for (Topic topic : domain::kAllTopics) {
    EXPECT_EQ(report.samples.at(topic), report.ticks);
    expect_received(topic, 0, last_tick);
  }
}

TEST_P(LiveReplay, PublishesARangeInSingleTicks) {
  read_with_byte_reader(Topic::kScan);
  options_.range.first_tick = 40;
  options_.range.last_tick = 60;
  options_.paused = true;
  Script script({{Kind::kStep}, {Kind::kStep, 4, 0.0}, {Kind::kResume}});

  const LiveReplayReport report = replayed(script);

  EXPECT_EQ(script.halts(), (std::vector<std::uint64_t>{40, 41, 45}));
  EXPECT_EQ(report.ticks, 21u);
  expect_received(Topic::kScan, 40, 60);
}

TEST_P(LiveReplay, EndsWhereItIsToldTo) {
  read_with_byte_reader(Topic::kOdometry);
  options_.paused = true;
  Script script({{Kind::kStep, 7, 0.0}, {Kind::kEnd}});

  const LiveReplayReport report = replayed(script);

  EXPECT_EQ(report.ticks, 7u);
  expect_received(Topic::kOdometry, 0, 6);
}

TEST_P(LiveReplay, StopsWhenItsLastReaderLeaves) {
  read_with_byte_reader(Topic::kScan);
  options_.readers.back() += " --leave-after 5";
  options_.paused = true;
  Script script({{Kind::kStep, 5, 0.0}});

  const auto report = replay_live(*recording_, plan_, plan_, options_, script);

  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_EQ(report->stopped,
            "a participant left after tick 4: replay has not found a reader of 'scan'");
  EXPECT_EQ(report->ticks, 5u);
}

TEST_P(LiveReplay, NamesEveryTopicThatNobodyReads) {
  read_with_byte_reader(Topic::kScan);
  options_.topics.set(index_of(Topic::kTarget));
  options_.topics.set(index_of(Topic::kCommand));
  options_.wait_s = 1.0;
  Script script;

  const auto report = replay_live(*recording_, plan_, plan_, options_, script);

  ASSERT_TRUE(report.ok()) << report.error().text();
  EXPECT_EQ(report->stopped,
            "startup timed out after 1 s:\n"
            "  replay has not found a reader of 'command'\n"
            "  replay has not found a reader of 'target'");
  EXPECT_EQ(report->ticks, 0u);
}

TEST(LiveReplayTopics, AreFoundByNameWithOrWithoutASlash) {
  const ScratchDirectory directory;
  record_run(plan_of("reactive", in_world("open-field", 5)), directory.file("run.mcap"));
  const RunRecording recording = open_recording(directory.file("run.mcap"));

  EXPECT_EQ(*recorded_topic(recording, "scan"), Topic::kScan);
  EXPECT_EQ(*recorded_topic(recording, "/odometry"), Topic::kOdometry);
  EXPECT_EQ(recorded_topic(recording, "odometri").error().message,
            "unknown topic of this recording 'odometri' (did you mean 'odometry'?); allowed: "
            "command, odometry, scan, state, target");
  // The graph has no classify.
  EXPECT_FALSE(recorded_topic(recording, "landmark").ok());
}

}  // namespace
}  // namespace clew::replay_test
