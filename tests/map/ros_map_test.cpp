// SPDX-License-Identifier: Apache-2.0
#include "map/ros_map.hpp"

#include <gtest/gtest.h>

#include <string>

namespace clew::map {
namespace {

constexpr char kHead[] =
    "image: room.pgm\n"
    "resolution: 0.5\n"
    "origin: [-1.0, 2.0, 0.0]\n"
    "negate: 0\n"
    "occupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";

// 3 x 2: white, black and unknown (205, as map_server writes it) above black, white, white.
constexpr char kText[] = "P2\n# drawn by hand\n3 2\n255\n255 0 205\n0 254 255\n";

core::Result<BlockedMap> read(const std::string& head, const std::string& image) {
  return read_ros_map({"room.yaml", head, image});
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  text.replace(text.find(what), what.size(), with);
  return text;
}

TEST(RosMap, ReadsWhatIsFree) {
  const auto map = read(kHead, kText);

  ASSERT_TRUE(map.ok()) << map.error().text();
  EXPECT_EQ(map->grid.corner, Vec2(-1.0, 2.0));
  EXPECT_EQ(map->grid.cell_m, 0.5);
  EXPECT_EQ(map->grid.columns, 3);
  EXPECT_EQ(map->grid.rows, 2);
  // The picture's last row is the grid's first.
  EXPECT_EQ(map->blocked, (std::vector<std::uint8_t>{1, 0, 0, 0, 1, 1}));
}

TEST(RosMap, ReadsBinaryPictures) {
  const std::string bytes = {'\xff', '\0', '\xcd', '\0', '\xfe', '\xff'};

  const auto narrow = read(kHead, "P5 3 2 255\n" + bytes);
  // Two bytes a pixel, the high one first: 65535, 0, 40000, 0, 65000, 65535.
  const auto wide = read(kHead, std::string("P5\n3 2\n65535\n") +
                                    std::string("\xff\xff\0\0\x9c\x40\0\0\xfd\xe8\xff\xff", 12));

  ASSERT_TRUE(narrow.ok()) << narrow.error().text();
  ASSERT_TRUE(wide.ok()) << wide.error().text();
  EXPECT_EQ(narrow->blocked, read(kHead, kText)->blocked);
  EXPECT_EQ(wide->blocked, narrow->blocked);
}

TEST(RosMap, ReadsHeadsWhoseLinesEndAsOnOtherSystems) {
  const std::string bytes = {'\xff', '\0', '\xcd', '\0', '\xfe', '\xff'};
  const auto expected = read(kHead, kText)->blocked;

  for (const std::string head : {"P5\r\n3 2\r\n255\r\n", "P5\r3 2\r255\r", "P5 # by hand\r3 2 255 ",
                                 "P5\r\n# by hand\r\n3 2\r\n255\r\n", "P5\n3 2\n255# full\n"}) {
    const auto map = read(kHead, head + bytes);

    ASSERT_TRUE(map.ok()) << head << map.error().text();
    EXPECT_EQ(map->blocked, expected) << head;
  }
  EXPECT_EQ(read(kHead, "P2\r\n3 2\r\n255\r\n255 0 205\r\n0 254 255\r\n")->blocked, expected);
}

TEST(RosMap, TakesALineFeedAfterACarriageReturnForAPixelWhereTheSizeSaysSo) {
  // Six pixels, the first of which is grey 10: dark, and occupied.
  const auto map = read(kHead, "P5\n3 2\n255\r\n\xff\xff\xff\xff\xff");

  ASSERT_TRUE(map.ok()) << map.error().text();
  EXPECT_EQ(map->blocked, (std::vector<std::uint8_t>{0, 0, 0, 1, 0, 0}));
}

TEST(RosMap, UnknownIsWhatLiesBetweenTheThresholdsAsInMapServer) {
  // 205, by which map_server's saver means unknown: (255 - 205) / 255 = 0.19608.
  const std::string grey = "P2 1 1 255 205";

  EXPECT_EQ(read(replaced(kHead, "0.196", "0.196"), grey)->blocked.front(), 1);
  EXPECT_EQ(read(replaced(kHead, "0.196", "0.25"), grey)->blocked.front(), 0);
}

TEST(RosMap, TakesBrightForOccupiedIfNegated) {
  const auto map = read(replaced(kHead, "negate: 0", "negate: 1"), kText);

  ASSERT_TRUE(map.ok()) << map.error().text();
  EXPECT_EQ(map->blocked, (std::vector<std::uint8_t>{0, 1, 1, 1, 0, 1}));
}

TEST(RosMap, HoldsTheThresholds) {
  // Darkness of 204 of 255 is 0.2, free only below a threshold above that.
  const std::string grey = "P2 1 1 255 204";

  EXPECT_EQ(read(replaced(kHead, "0.196", "0.201"), grey)->blocked.front(), 0);
  EXPECT_EQ(read(replaced(kHead, "0.196", "0.2"), grey)->blocked.front(), 1);
}

TEST(RosMap, SaysWhatIsWrong) {
  const auto message = [](const std::string& head, const std::string& image) {
    const auto map = read(head, image);
    return map.ok() ? "no error" : map.error().text();
  };

  EXPECT_EQ(message(replaced(kHead, "resolution: 0.5", "resolution: 0"), kText),
            "room.yaml:2:13: resolution is '0'; allowed: 0.001 to 100");
  EXPECT_EQ(message(replaced(kHead, "2.0, 0.0", "2.0, 0.1"), kText),
            "room.yaml:3:9: origin is turned by 0.1 rad; allowed: 0");
  EXPECT_EQ(message(replaced(kHead, "negate: 0", "negate: 2"), kText),
            "room.yaml:4:9: negate is '2'; allowed: 0 or 1");
  EXPECT_EQ(message(replaced(kHead, "0.196", "0.7"), kText),
            "room.yaml:6:14: free_thresh is 0.7; allowed: at most occupied_thresh, 0.65");
  EXPECT_EQ(message(std::string(kHead) + "mode: scale\n", kText),
            "room.yaml:7:7: mode is 'scale'; allowed: trinary");
  EXPECT_EQ(message(kHead, "GIF89a"),
            "image of room.yaml:1: is no PGM picture: it does not begin with P2 or P5");
  EXPECT_EQ(message(kHead, "P2\n3 x\n"),
            "image of room.yaml:2: height is missing; allowed: 1 to 65536");
  EXPECT_EQ(message(kHead, "P2\n3 2\n70000\n"),
            "image of room.yaml:3: greatest grey is 70000; allowed: 1 to 65535");
  EXPECT_EQ(message(kHead, "P2\n3 2\n255\n1 2 3\n4 5\n"),
            "image of room.yaml:6: ends at pixel 5 of 6");
  EXPECT_EQ(message(kHead, "P2\n3 2\n15\n1 2 3\n4 16 5\n"),
            "image of room.yaml:5: pixel 4 is 16; allowed: 0 to 15");
  EXPECT_EQ(message(kHead, "P5\n3 2\n255\nabc"), "image of room.yaml:3: ends at pixel 3 of 6");
  EXPECT_EQ(message(kHead, "P5\n3 2\n255\nabcdefgh"),
            "image of room.yaml:3: has 2 bytes behind its last pixel, the 6th");
  EXPECT_EQ(message(kHead, "P2\n3 2\n255\n1 2 3\n4 5 6 7\n"),
            "image of room.yaml:5: goes on behind its last pixel, the 6th");
  EXPECT_EQ(message(kHead, "P2\n3 2\n255\n1 2 3\n4 5 6 x\n"),
            "image of room.yaml:5: goes on behind its last pixel, the 6th");
  EXPECT_EQ(message(kHead, "P5\n9999 9999\n255\n"),
            "image of room.yaml:3: has 99980001 pixels; allowed: at most 16777216");
}

}  // namespace
}  // namespace clew::map
