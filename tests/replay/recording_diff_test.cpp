// SPDX-License-Identifier: Apache-2.0
#include "replay/recording_diff.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <utility>

#include "../recording/scratch_directory.hpp"
#include "recorded_run.hpp"
#include "recording_draft.hpp"

namespace clew::replay_test {
namespace {

using namespace bridge;
using domain::Topic;
using recording_test::ScratchDirectory;

constexpr std::uint64_t kLastTick = 40;

/// The recording of a run of ticks 0 to 40, and changed copies of it.
class RecordingDiffTest : public testing::Test {
 protected:
  void SetUp() override {
    record_run(plan_of("krishna_kalra", in_world("u-trap", kLastTick)), original_);
    draft_ = RecordingDraft::read(original_);
  }
  RecordingDiff diff(double tolerance = 0.0) {
    draft_.write(changed_);
    auto found = diff_recordings(open_recording(original_), open_recording(changed_), tolerance);
    EXPECT_TRUE(found.ok()) << found.error().text();
    return std::move(found).value();
  }

  ScratchDirectory scratch_;
  std::string original_ = scratch_.file("original.mcap");
  std::string changed_ = scratch_.file("changed.mcap");
  RecordingDraft draft_;
};

TEST_F(RecordingDiffTest, FindsACopyIdentical) {
  const RecordingDiff found = diff();

  EXPECT_TRUE(found.identical());
  EXPECT_EQ(found.topics.size(), domain::kTopicCount);
  for (const auto& [topic, of_topic] : found.topics) {
    EXPECT_EQ(of_topic.samples_a, kLastTick + 1);
    EXPECT_EQ(of_topic.equal, kLastTick + 1);
  }
  EXPECT_TRUE(found.configuration.empty());
}

TEST_F(RecordingDiffTest, FindsAChangedBitInEveryByteOfEveryTopic) {
  const std::uint64_t tick = 17;
  for (Topic topic : domain::kAllTopics) {
    std::string& cdr = draft_.sample(topic, tick).cdr;
    for (std::size_t place = 0; place < cdr.size(); ++place) {
      cdr[place] = static_cast<char>(cdr[place] ^ 1);

      const RecordingDiff found = diff();

      ASSERT_FALSE(found.identical()) << domain::topic_name(topic) << ", byte " << place;
      EXPECT_EQ(found.first->topic, topic);
      EXPECT_EQ(found.first->tick, tick);
      EXPECT_EQ(found.topics.at(topic).different, 1U);
      EXPECT_EQ(found.topics.at(topic).equal, kLastTick);
      cdr[place] = static_cast<char>(cdr[place] ^ 1);
    }
  }
}

TEST_F(RecordingDiffTest, NamesTheFieldAndBothValues) {
  Codec<domain::Scan> codec;
  domain::Scan scan;
  auto& sample = draft_.sample(Topic::kScan, 9);
  ASSERT_TRUE(codec.decode(sample.cdr, scan).ok());
  const double before_m = scan.ranges_m[3];
  scan.ranges_m[3] = 0.25;
  sample.cdr = codec.encode(scan);

  const RecordingDiff found = diff();

  ASSERT_FALSE(found.identical());
  ASSERT_EQ(found.first->fields.size(), 1U);
  EXPECT_EQ(found.first->fields[0].path, "ranges_m[3]");
  EXPECT_EQ(found.first->fields[0].a, FieldValue(before_m));
  EXPECT_EQ(found.first->fields[0].b, FieldValue(0.25));
}

// Of a scan's bytes: 4 of the header, 24 of the stamp, 5 numbers, 4 of the length and 4 of padding.
constexpr std::size_t kRangesAt = 4 + 24 + 5 * 8 + 4 + 4;

TEST_F(RecordingDiffTest, NamesAFieldWhoseValueIsOutsideItsRange) {
  Codec<domain::Scan> codec;
  domain::Scan scan;
  std::string& cdr = draft_.sample(Topic::kScan, 9).cdr;
  ASSERT_TRUE(codec.decode(cdr, scan).ok());
  cdr[kRangesAt + 3 * 8 + 7] = static_cast<char>(cdr[kRangesAt + 3 * 8 + 7] ^ 0x80);

  const RecordingDiff found = diff();

  ASSERT_FALSE(found.identical());
  ASSERT_EQ(found.first->fields.size(), 1U);
  EXPECT_EQ(found.first->fields[0].path, "ranges_m[3]");
  EXPECT_EQ(found.first->fields[0].a, FieldValue(scan.ranges_m[3]));
  EXPECT_EQ(found.first->fields[0].b, FieldValue(-scan.ranges_m[3]));
}

TEST_F(RecordingDiffTest, NamesAFieldThatIsNoNumber) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(&draft_.sample(Topic::kScan, 9).cdr[kRangesAt], &none, sizeof none);

  const RecordingDiff found = diff(0.5);

  ASSERT_FALSE(found.identical());
  ASSERT_EQ(found.first->fields.size(), 1U);
  EXPECT_EQ(found.first->fields[0].path, "ranges_m[0]");
  EXPECT_TRUE(same_bits(*found.first->fields[0].b, FieldValue(none)));
}

TEST_F(RecordingDiffTest, NamesAnUnknownEnumeratorByItsNumber) {
  // Before the outcome: the header, the stamp, the pose, two speeds and the path's length.
  constexpr std::size_t kOutcomeAt = 4 + 24 + 24 + 16 + 8;
  draft_.sample(Topic::kState, 9).cdr[kOutcomeAt] = 9;

  const RecordingDiff found = diff();

  ASSERT_FALSE(found.identical());
  ASSERT_EQ(found.first->fields.size(), 1U);
  EXPECT_EQ(found.first->fields[0].path, "outcome");
  EXPECT_EQ(found.first->fields[0].a, FieldValue(std::string_view("OUTCOME_RUNNING")));
  EXPECT_EQ(found.first->fields[0].b, FieldValue(std::uint64_t{9}));
}

TEST_F(RecordingDiffTest, NamesTheByteWhereThereIsNoMessage) {
  draft_.sample(Topic::kScan, 9).cdr[kRangesAt - 8] = 127;  // more ranges than there are bytes

  const RecordingDiff found = diff();

  ASSERT_FALSE(found.identical());
  EXPECT_EQ(found.first->fields[0].path, "(byte 68)");
}

TEST_F(RecordingDiffTest, ReportsTheFirstDifferenceInOrderOfTickAndTopic) {
  draft_.sample(Topic::kTarget, 5).cdr.back() ^= 1;
  draft_.sample(Topic::kEvent, 5).cdr.back() ^= 1;
  draft_.sample(Topic::kCommand, 6).cdr.back() ^= 1;

  const RecordingDiff found = diff();

  ASSERT_FALSE(found.identical());
  EXPECT_EQ(found.first->tick, 5U);
  EXPECT_EQ(found.first->topic, Topic::kEvent);
}

TEST_F(RecordingDiffTest, TakesOtherBytesOfTheSameMessageForADifference) {
  // Byte 3 of the encapsulation header is for options that no field tells of.
  draft_.sample(Topic::kState, 3).cdr[3] = 1;

  const RecordingDiff found = diff(1e-3);

  ASSERT_FALSE(found.identical());
  EXPECT_EQ(found.first->fields[0].path, "(byte 3)");
}

TEST_F(RecordingDiffTest, CountsMissingSamplesAsDifferences) {
  draft_.drop(Topic::kLandmark, 12, 14);

  const RecordingDiff found = diff();

  ASSERT_FALSE(found.identical());
  EXPECT_EQ(found.first->topic, Topic::kLandmark);
  EXPECT_EQ(found.first->tick, 12U);
  EXPECT_EQ(found.first->fields[0].path, "(sample)");
  EXPECT_TRUE(found.first->fields[0].a.has_value());
  EXPECT_FALSE(found.first->fields[0].b.has_value());
  EXPECT_EQ(found.topics.at(Topic::kLandmark).only_a, 3U);
  EXPECT_EQ(found.topics.at(Topic::kLandmark).samples_b, kLastTick + 1 - 3);
}

TEST_F(RecordingDiffTest, CountsATopicThatOnlyOneHas) {
  draft_.drop(Topic::kEvent, 0, kLastTick);
  draft_.description.schemas.erase(Topic::kEvent);

  const RecordingDiff found = diff();

  EXPECT_FALSE(found.identical());
  EXPECT_EQ(found.topics.at(Topic::kEvent).only_a, kLastTick + 1);
}

TEST_F(RecordingDiffTest, ComparesATornRecordingUpToTheTear) {
  const std::string bytes = recording_test::read_bytes(original_);
  const std::string torn = scratch_.file("torn.mcap");
  recording_test::write_bytes(torn, bytes.substr(0, bytes.size() / 2));
  const RunRecording recording = open_recording(torn);
  ASSERT_FALSE(recording.complete());

  const auto found = diff_recordings(open_recording(original_), recording);

  ASSERT_TRUE(found.ok()) << found.error().text();
  ASSERT_FALSE(found->identical());
  EXPECT_EQ(found->first->fields[0].path, "(sample)");
  for (const auto& [topic, of_topic] : found->topics) {
    EXPECT_EQ(of_topic.different, 0U);
    EXPECT_EQ(of_topic.only_b, 0U);
    EXPECT_EQ(of_topic.equal + of_topic.only_a, kLastTick + 1);
  }
}

TEST_F(RecordingDiffTest, PassesOverNumbersWithinAToleranceOnRequest) {
  Codec<domain::Odometry> codec;
  domain::Odometry odometry;
  auto& sample = draft_.sample(Topic::kOdometry, 9);
  ASSERT_TRUE(codec.decode(sample.cdr, odometry).ok());
  odometry.pose_odom_robot.x_m += 1e-6;
  sample.cdr = codec.encode(odometry);

  EXPECT_FALSE(diff().identical());
  EXPECT_FALSE(diff(1e-7).identical());
  EXPECT_TRUE(diff(1e-5).identical());
}

TEST_F(RecordingDiffTest, ListsDifferencesOfTheConfigurationAndDoesNotCountThem) {
  draft_.description.seed = 7;
  draft_.description.versions["clew"] = "9.9.9";
  draft_.description.bundle["robot.yaml"] = "format: clew-robot/1\nradius_m: 0.2\n";
  draft_.description.bundle["extra.yaml"] = "a: 1\n";

  const RecordingDiff found = diff();

  EXPECT_TRUE(found.identical());
  std::map<std::string, std::pair<std::string, std::string>> listed;
  for (const auto& difference : found.configuration) {
    listed[difference.what] = {difference.a, difference.b};
  }
  ASSERT_EQ(listed.size(), 4U);
  EXPECT_EQ(listed["seed"], std::pair(std::string("1"), std::string("7")));
  EXPECT_EQ(listed["version clew"].second, "9.9.9");
  EXPECT_EQ(listed["robot.yaml"].second, "line 1: format: clew-robot/1");
  EXPECT_EQ(listed["extra.yaml"], std::pair(std::string(), std::string("present")));
}

TEST_F(RecordingDiffTest, RefusesMessageTypesOfAnotherVersion) {
  draft_.description.idl_fingerprint = "00112233445566778899aabbccddeeff";
  draft_.write(changed_);

  const auto found = diff_recordings(open_recording(original_), open_recording(changed_));

  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().file, changed_);
  EXPECT_NE(
      found.error().message.find("other message types (IDL 00112233445566778899aabbccddeeff)"),
      std::string::npos);
}

TEST_F(RecordingDiffTest, RefusesSamplesThatAreNotInOrder) {
  std::swap(draft_.samples[10], draft_.samples[11]);
  draft_.write(changed_);

  const auto found = diff_recordings(open_recording(original_), open_recording(changed_));

  ASSERT_FALSE(found.ok());
  EXPECT_NE(found.error().message.find("not in the order of tick and topic"), std::string::npos);
}

}  // namespace
}  // namespace clew::replay_test
