// SPDX-License-Identifier: Apache-2.0
#include "wire/message_json.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "message_equality.hpp"
#include "random_messages.hpp"

namespace clew::bridge {
namespace {

using nlohmann::ordered_json;

/// What reading `text` as a command's JSON is answered with; empty if it is taken.
std::string refusal(const std::string& text) {
  domain::Command command;
  const auto read = read_json(ordered_json::parse(text), "command", &command);
  return read.ok() ? "" : read.error().text();
}

template <typename Message>
std::string guidance_refusal(const std::string& text) {
  Message message;
  const auto read = read_json(ordered_json::parse(text), "it", &message);
  return read.ok() ? "" : read.error().text();
}

TEST(MessageJson, NamesFieldsAndEnumeratorsAsTheIdlDoes) {
  domain::Command command;
  command.stamp = {7, 2.1, 7};
  command.motion.kind = domain::CommandKind::kTurnAndStep;
  command.motion.step_m = 0.1;

  EXPECT_EQ(json_of(&command).dump(),
            R"({"stamp":{"tick":7,"sim_time_s":2.1,"sequence_number":7},)"
            R"("motion":{"kind":"COMMAND_TURN_AND_STEP","turn_rad":0.0,"step_m":0.1,)"
            R"("speed_mps":0.0,"turn_rate_radps":0.0,"left_mps":0.0,"right_mps":0.0},)"
            R"("virtual_targets":[]})");
}

TEST(MessageJson, GivesEveryTopicBackAsItWas) {
  RandomMessages random(1);
  for (const domain::Topic topic : domain::kAllTopics) {
    domain::visit_topic(topic, [&](auto constant) {
      using Message = typename decltype(constant)::Message;
      for (int i = 0; i < 100; ++i) {
        Message message;
        random.fill(message);

        const std::string text = json_of(&message).dump();
        Message again;
        const auto read = read_json(ordered_json::parse(text), "it", &again);

        ASSERT_TRUE(read.ok()) << read.error().text();
        ASSERT_TRUE(again == message) << text;
      }
    });
  }
}

TEST(MessageJson, LeavesAFieldThatIsNotThereAsItIs) {
  domain::Command command;
  command.stamp.tick = 5;
  command.motion.kind = domain::CommandKind::kTurnAndStep;
  command.motion.turn_rad = 0.25;

  const auto read =
      read_json(ordered_json::parse(R"({"motion": {"step_m": 1}})"), "command", &command);

  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_EQ(command.stamp.tick, 5u);
  EXPECT_EQ(command.motion.turn_rad, 0.25);
  EXPECT_EQ(command.motion.step_m, 1.0);
}

TEST(MessageJson, SaysWhichFieldIsWrongAndWhatIsAllowed) {
  EXPECT_EQ(refusal(R"({"motion": {"step_m": "1"}})"),
            R"(command.motion.step_m is "1"; allowed: a number)");
  EXPECT_EQ(refusal(R"({"motion": {"stepm": 1}})"),
            "unknown field of command.motion 'stepm' (did you mean 'step_m'?); allowed: kind, "
            "turn_rad, step_m, speed_mps, turn_rate_radps, left_mps, right_mps");
  EXPECT_EQ(refusal(R"({"motion": {"kind": "STOP"}})").substr(0, 50),
            "unknown value of command.motion.kind 'STOP'; allow");
  EXPECT_EQ(refusal(R"({"motion": [1]})"), "command.motion is [1]; allowed: an object");
  EXPECT_EQ(refusal(R"({"stamp": {"tick": -1}})"),
            "command.stamp.tick is -1; allowed: a whole number from 0 to 18446744073709551615");
  EXPECT_EQ(guidance_refusal<domain::Guidance>(R"({"has_override": 1})"),
            "it.has_override is 1; allowed: true, false");
  EXPECT_EQ(guidance_refusal<domain::Landmark>(R"({"classes": [1, 2]})"),
            "it.classes is [1,2]; allowed: a list of 3 items");
  EXPECT_EQ(guidance_refusal<domain::Landmark>(R"({"classes": [1, 2, 256]})"),
            "it.classes[2] is 256; allowed: a whole number from 0 to 255");
  EXPECT_EQ(guidance_refusal<domain::Odometry>(
                R"({"contact_bearings_rad": [0, 0, 0, 0, 0, 0, 0, 0, 0]})"),
            "it.contact_bearings_rad is [0,0,0,0,0,0,0,0,0]; allowed: a list of up to 8 items");
}

TEST(MessageJson, RefusesWhatNoComponentWouldTake) {
  EXPECT_NE(refusal(R"({"motion": {"kind": "COMMAND_TURN_AND_STEP", "turn_rad": 9}})"), "");
}

}  // namespace
}  // namespace clew::bridge
