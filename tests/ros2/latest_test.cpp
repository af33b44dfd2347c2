// SPDX-License-Identifier: Apache-2.0
#include "robot/latest.hpp"

#include <gtest/gtest.h>

namespace clew::robot {
namespace {

constexpr double kTimeout_s = 0.5;

Time at(double seconds) {
  return Time{} +
         std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(seconds));
}
ros2::Odometry stamped(std::int32_t sec, std::uint32_t nanosec = 0) {
  ros2::Odometry message;
  message.header.stamp = {sec, nanosec};
  return message;
}

TEST(LatestMessage, IsAsOldAsItsArrivalWhateverItsStamp) {
  Latest<ros2::Odometry> latest(kTimeout_s);

  ASSERT_TRUE(latest.take(stamped(2000000000), "a", at(10.0)));

  EXPECT_NEAR(latest.age_s(at(10.25)), 0.25, 1e-9);
  EXPECT_TRUE(latest.take(stamped(5), "a", at(10.5))) << "a clock that was set back";
  EXPECT_NEAR(latest.age_s(at(10.5)), 0.0, 1e-9);
}

TEST(LatestMessage, ARepeatedStampIsNoNews) {
  Latest<ros2::Odometry> latest(kTimeout_s);
  latest.take(stamped(5, 7), "a", at(1.0));

  EXPECT_FALSE(latest.take(stamped(5, 7), "a", at(2.0)));
  EXPECT_NEAR(latest.age_s(at(2.0)), 1.0, 1e-9);
  EXPECT_TRUE(latest.take(stamped(5, 8), "a", at(2.0)));
}

TEST(LatestMessage, WithoutStampsEachIsNews) {
  Latest<ros2::Odometry> latest(kTimeout_s);
  latest.take(stamped(0), "a", at(1.0));

  EXPECT_TRUE(latest.take(stamped(0), "a", at(2.0)));
}

TEST(LatestMessage, OneWriterIsListenedToUntilItIsSilent) {
  Latest<ros2::Odometry> latest(kTimeout_s);
  EXPECT_TRUE(latest.listens_to("a", at(1.0)));
  latest.take(stamped(1), "a", at(1.0));

  EXPECT_FALSE(latest.listens_to("b", at(1.4)));
  EXPECT_TRUE(latest.listens_to("a", at(1.4)));
  EXPECT_TRUE(latest.listens_to("b", at(1.6)));
  EXPECT_TRUE(latest.take(stamped(1), "b", at(1.6))) << "the same stamp, of another writer";
  EXPECT_FALSE(latest.listens_to("a", at(1.7)));
}

}  // namespace
}  // namespace clew::robot
