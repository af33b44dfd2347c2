// SPDX-License-Identifier: Apache-2.0
/// A recording of before the goal's heading and odometry's covariance (IDL 909fcf76...), of the
/// graph default, kept as it is: it can be read, and is not replayed.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "recorded_run.hpp"
#include "replay/recorded_plan.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"
#include "wire/codec.hpp"

namespace clew::replay_test {
namespace {

using bridge::RunRecording;
using domain::Topic;

constexpr char kFingerprint[] = "909fcf761c239b955a230bbbd53100e1";

RunRecording older() {
  return open_recording(tests::source_path("tests/golden/older/default.mcap"));
}

TEST(OlderRecording, HoldsTheHashThatItsRecorderWrote) {
  const RunRecording recording = older();

  ASSERT_EQ(recording.description().idl_fingerprint, kFingerprint);
  const auto survey = recording.survey();

  ASSERT_TRUE(survey.ok()) << survey.error().text();
  EXPECT_EQ(survey->hash, recording.end()->hash);
}

TEST(OlderRecording, GivesEverySampleInTodaysTypes) {
  const RunRecording recording = older();
  domain::Messages messages;
  bridge::SampleStream samples = recording.samples();
  std::map<Topic, std::uint64_t> counts;
  std::uint64_t virtual_targets = 0;
  std::uint64_t entries = 0;
  while (true) {
    const auto sample = samples.next();
    ASSERT_TRUE(sample.ok()) << sample.error().text();
    if (!*sample) break;
    ++counts[(*sample)->topic];
    domain::visit_topic((*sample)->topic, [&](auto constant) {
      auto& message = std::get<index_of(decltype(constant)::value)>(messages);
      const auto decoded = bridge::decode((*sample)->cdr, &message, bridge::Values::kValid);
      ASSERT_TRUE(decoded.ok()) << decoded.error().text();
      EXPECT_EQ(message.stamp.tick, (*sample)->tick);
    });
    const auto& guidance = std::get<domain::Guidance>(messages);
    if ((*sample)->topic == Topic::kGuidance && guidance.target_is_virtual) ++virtual_targets;
    if ((*sample)->topic == Topic::kEvent) {
      entries += std::get<domain::Event>(messages).entries.size();
    }
  }

  for (const auto& [topic, schema] : recording.description().schemas) {
    EXPECT_EQ(counts[topic], recording.end()->ticks) << domain::topic_name(topic);
    EXPECT_EQ(recording.description_of_samples().schemas.at(topic), bridge::idl_text(topic));
  }
  EXPECT_GT(virtual_targets, 0u);
  EXPECT_GT(entries, 0u);
  const auto& target = std::get<domain::Target>(messages);
  EXPECT_GT(target.radius_m, 0.0);
  EXPECT_FALSE(target.has_heading);
  EXPECT_EQ(std::get<domain::State>(messages).outcome, domain::Outcome::kTimeout);
}

TEST(OlderRecording, KnowsWhichFieldsItHas) {
  const RunRecording recording = older();

  EXPECT_TRUE(recording.has_field(Topic::kOdometry, "pose_odom_robot.heading_rad"));
  EXPECT_FALSE(recording.has_field(Topic::kOdometry, "covariance.x_m2"));
  EXPECT_FALSE(recording.has_field(Topic::kCommand, "virtual_targets.length"));
}

TEST(OlderRecording, IsNotReplayedAndBothVersionsAreNamed) {
  const RunRecording recording = older();

  const auto plan = bridge::recorded_plan(recording, stages::all());

  ASSERT_FALSE(plan.ok());
  EXPECT_NE(plan.error().text().find(std::string("(IDL ") + kFingerprint + ")"), std::string::npos)
      << plan.error().text();
  EXPECT_NE(plan.error().text().find("(IDL " + std::string(bridge::idl_fingerprint()) + ")"),
            std::string::npos)
      << plan.error().text();
}

}  // namespace
}  // namespace clew::replay_test
