// SPDX-License-Identifier: Apache-2.0
#include "domains/condition.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "domain/messages.hpp"
#include "ros2/message_codec.hpp"
#include "wire/codec.hpp"

namespace clew::domains {
namespace {

constexpr char kOdometry[] = "clew::msg::Odometry";
constexpr char kScan[] = "clew::msg::Scan";
constexpr char kRosScan[] = "sensor_msgs::msg::dds_::LaserScan_";

std::string bytes_of(const domain::Scan& scan) {
  bridge::Codec<domain::Scan> codec;
  return std::string(codec.encode(scan));
}

bool holds(const std::string& text, const std::string& type, const std::string& cdr) {
  const auto condition = Condition::parse(text);
  EXPECT_TRUE(condition.ok()) << text;
  const auto checked = condition->check(type);
  EXPECT_TRUE(checked.ok()) << checked.error().message;
  const auto found = condition->holds(type, cdr);
  EXPECT_TRUE(found.ok()) << text;
  return *found;
}

std::string refusal(const std::string& text, const std::string& type) {
  const auto condition = Condition::parse(text);
  if (!condition.ok()) return condition.error().message;
  const auto checked = condition->check(type);
  return checked.ok() ? "" : checked.error().message;
}

TEST(Condition, ComparesFieldsOfClewsTypes) {
  domain::Scan scan;
  scan.stamp.tick = 7;
  scan.range_max_m = 2.0;
  scan.ranges_m.push_back(1.5);
  scan.ranges_m.push_back(0.25);
  const std::string cdr = bytes_of(scan);

  EXPECT_TRUE(holds("stamp.tick == 7", kScan, cdr));
  EXPECT_FALSE(holds("stamp.tick != 7", kScan, cdr));
  EXPECT_TRUE(holds("ranges_m[1] < 0.5", kScan, cdr));
  EXPECT_TRUE(holds("ranges_m[0] >= 1.5", kScan, cdr));
  EXPECT_FALSE(holds("ranges_m[0] > 1.5", kScan, cdr));
  EXPECT_TRUE(holds("ranges_m.length <= 2", kScan, cdr));
}

TEST(Condition, DoesNotHoldForAnItemThatIsNotThere) {
  const std::string cdr = bytes_of({});

  EXPECT_FALSE(holds("ranges_m[3] < 1", kScan, cdr));
  EXPECT_FALSE(holds("ranges_m[3] >= 1", kScan, cdr));
}

TEST(Condition, ComparesFieldsOfRosTypes) {
  ros2::LaserScan scan;
  scan.header.frame_id = "front";
  scan.ranges = {2.0F, std::numeric_limits<float>::infinity()};
  std::vector<char> buffer;
  const std::string cdr(ros2::encode(scan, buffer));

  EXPECT_TRUE(holds("header.frame_id == front", kRosScan, cdr));
  EXPECT_TRUE(holds("header.frame_id != rear", kRosScan, cdr));
  EXPECT_TRUE(holds("ranges[0] == 2", kRosScan, cdr));
  EXPECT_TRUE(holds("ranges[1] > 100", kRosScan, cdr));
}

TEST(Condition, IsRefusedWithWhatIsAllowed) {
  EXPECT_EQ(refusal("blocked", kOdometry), "expected FIELD OPERATOR VALUE, found 'blocked'");
  EXPECT_EQ(refusal("blocked ~ true", kOdometry), "'~' is no operator; allowed: == != < <= > >=");
  EXPECT_EQ(refusal("ranges[x] < 1", kScan),
            "'ranges[x]' names no field; expected a path such as ranges_m[3]");
  EXPECT_EQ(refusal("a..b == 1", kScan),
            "'a..b' names no field; expected a path such as ranges_m[3]");
  EXPECT_EQ(refusal("rnages_m[0] < 1", kScan),
            "'rnages_m[0] < 1': clew::msg::Scan has no such field");
  EXPECT_EQ(refusal("ranges_m < 1", kScan), "'ranges_m < 1': clew::msg::Scan has no such field");
  EXPECT_EQ(refusal("stamp.tick == many", kScan),
            "'stamp.tick == many': the field is a number, and 'many' is none");
  EXPECT_EQ(refusal("header.frame_id < b", kRosScan),
            "'header.frame_id < b': only numbers are in an order; allowed here: == !=");
  EXPECT_EQ(refusal("blocked == yes", kOdometry), "'blocked == yes': the field is true or false");
  EXPECT_NE(refusal("a == 1", "x::Y").find("the fields of x::Y are unknown"), std::string::npos);
}

TEST(Condition, RefusesBytesOfNoMessage) {
  const auto condition = Condition::parse("stamp.tick == 7");

  EXPECT_FALSE(condition->holds(kScan, "abc").ok());
  EXPECT_FALSE(condition->holds(kRosScan, std::string(3, '\0')).ok());
}

}  // namespace
}  // namespace clew::domains
