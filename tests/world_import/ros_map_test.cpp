// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <vector>

#include "core/math.hpp"
#include "tests/world_import/source_files.hpp"

namespace clew::world_import {
namespace {

std::string head(const std::string& image, const std::string& more = "",
                 const std::string& origin = "[0, 0, 0]") {
  return "image: " + image + "\nresolution: 0.5\norigin: " + origin +
         "\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n" + more;
}

/// 6 x 4 cells of half a metre: all free but for one that is occupied, in column 3, row 1 from
/// below.
constexpr char kPlain[] =
    "P2\n# made by hand\n6 4\n255\n"
    "254 254 254 254 254 254\n254 254 254 254 254 254\n254 254 254 0 254 254\n"
    "254 254 254 254 254 254\n";

TEST(RosMap, AnOccupiedCellIsASquareOfTheWorld) {
  SourceFiles files;
  files.write("m.pgm", kPlain);
  const auto world = world_from(files.write("m.yaml", head("m.pgm")));

  EXPECT_EQ(world.bounds_max(), core::Vec2(3.0, 2.0));
  ASSERT_EQ(world.polygons().size(), 1U);
  EXPECT_TRUE(is_blocked(world, 1.75, 0.75));
  EXPECT_FALSE(is_blocked(world, 1.25, 0.75));
  EXPECT_FALSE(is_blocked(world, 1.75, 1.25));
  EXPECT_DOUBLE_EQ(world.clearance_m({1.0, 0.75}, 1.0, 0.0), 0.5);
}

TEST(RosMap, StartAndTargetAreFarApartAndFitTheRobot) {
  SourceFiles files;
  files.write("m.pgm", kPlain);
  const auto world = world_from(files.write("m.yaml", head("m.pgm")));

  // Opposite corners of 6 x 4 cells, the robot of 0.15 m on the middle of a cell of 0.5 m.
  EXPECT_NEAR((world.start().position() - world.target()).norm(), std::hypot(2.5, 1.5), 1e-9);
  EXPECT_TRUE(world.check_robot_fits(0.15).ok());
}

TEST(RosMap, EndsOfLinesOfOtherSystemsAndBinaryPicturesAreTheSame) {
  SourceFiles files;
  std::string binary = "P5\r\n# other\r\n6 4\r\n255\r\n";
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 6; ++column) {
      binary += row == 2 && column == 3 ? '\0' : '\xfe';
    }
  }
  files.write("plain.pgm", kPlain);
  files.write("binary.pgm", binary);
  const auto plain = import_world(files.write("plain.yaml", head("plain.pgm")), {});
  const auto other = import_world(files.write("binary.yaml", head("binary.pgm")), {});

  ASSERT_TRUE(plain.ok());
  ASSERT_TRUE(other.ok()) << other.error().text();
  const auto after_name = [](const std::string& text) { return text.substr(text.find("bounds")); };
  EXPECT_EQ(after_name(*plain), after_name(*other));
}

TEST(RosMap, ATurnedMapIsTurnedAndBlockedBesideIt) {
  SourceFiles files;
  files.write("m.pgm", kPlain);
  const auto world = world_from(files.write("m.yaml", head("m.pgm", "", "[1, 2, 0.5235988]")));

  const double c = std::cos(0.5235988);
  const double s = std::sin(0.5235988);
  const auto place = [&](double x, double y) {
    return core::Vec2(1.0 + c * x - s * y, 2.0 + s * x + c * y);
  };
  const core::Vec2 occupied = place(1.75, 0.75);
  const core::Vec2 free = place(1.25, 0.75);
  EXPECT_TRUE(is_blocked(world, occupied.x(), occupied.y()));
  EXPECT_FALSE(is_blocked(world, free.x(), free.y()));
  // Just outside each side of the map.
  for (const core::Vec2& outside :
       {place(1.5, -0.1), place(3.1, 1.0), place(1.5, 2.1), place(-0.1, 1.0)}) {
    EXPECT_TRUE(is_blocked(world, outside.x(), outside.y())) << outside.transpose();
  }
}

/// Grey levels of a row, in the middle of a free map; the state of each.
std::string row_picture(const std::vector<int>& greys) {
  std::string text = "P2\n" + std::to_string(greys.size()) + " 3\n255\n";
  for (const int row : {0, 1, 0}) {
    for (const int grey : greys) text += std::to_string(row == 1 ? grey : 254) + ' ';
  }
  return text;
}

/// Which cells of the row are blocked, by columns of half a metre.
std::string blocked_in_row(const std::string& more, const std::vector<int>& greys,
                           const ImportOptions& options = {}) {
  SourceFiles files;
  files.write("m.pgm", row_picture(greys));
  const auto world = world_from(files.write("m.yaml", head("m.pgm", more)), options);
  std::string text;
  for (std::size_t i = 0; i < greys.size(); ++i) {
    text += is_blocked(world, 0.25 + 0.5 * static_cast<double>(i), 0.75) ? '#' : '.';
  }
  return text;
}

// Darkness: 254 -> 0.004, 206 -> 0.192, 150 -> 0.41, 140 -> 0.45, 90 -> 0.647, 89 -> 0.651, 0 -> 1.
const std::vector<int> kGreys = {254, 206, 150, 140, 90, 89, 0};

TEST(RosMapModes, TrinaryTakesWhatIsBetweenForUnknown) {
  ImportOptions unknown_is_free;
  unknown_is_free.unknown_is_blocked = false;

  EXPECT_EQ(blocked_in_row("", kGreys), "..#####");
  EXPECT_EQ(blocked_in_row("mode: trinary\n", kGreys, unknown_is_free), ".....##");
}

TEST(RosMapModes, ScaleIsOccupiedFromOneHalfOfTheWay) {
  // Half-way between 0.196 and 0.65 is 0.423.
  EXPECT_EQ(blocked_in_row("mode: scale\n", kGreys), "...####");
}

TEST(RosMapModes, RawValuesArePercentages) {
  ImportOptions unknown_is_free;
  unknown_is_free.unknown_is_blocked = false;
  SourceFiles files;
  std::string picture = "P2\n6 3\n255\n";
  for (const int row : {0, 1, 0}) {
    for (const int value : {0, 19, 20, 65, 100, 101}) {
      picture += std::to_string(row == 1 ? value : 0) + ' ';
    }
  }
  files.write("m.pgm", picture);
  const std::string path = files.write("m.yaml", head("m.pgm", "mode: raw\n"));
  const auto free = world_from(path, unknown_is_free);
  const auto blocked = world_from(path);

  std::string if_free;
  std::string if_blocked;
  for (int i = 0; i < 6; ++i) {
    if_free += is_blocked(free, 0.25 + 0.5 * i, 0.75) ? '#' : '.';
    if_blocked += is_blocked(blocked, 0.25 + 0.5 * i, 0.75) ? '#' : '.';
  }
  EXPECT_EQ(if_free, "...##.");
  EXPECT_EQ(if_blocked, "..####");
}

TEST(RosMapModes, NegateTurnsBrightnessAround) {
  SourceFiles files;
  files.write("m.pgm", "P2\n4 3\n255\n0 0 0 0 0 0 255 0 0 0 0 0\n");
  std::string text = head("m.pgm");
  text.replace(text.find("negate: 0"), 9, "negate: 1");
  const auto world = world_from(files.write("m.yaml", text));

  EXPECT_TRUE(is_blocked(world, 1.25, 0.75));
  EXPECT_FALSE(is_blocked(world, 0.75, 0.75));
}

TEST(RosMap, ReadsPngAndTakesTransparentPixelsForUnknownInScale) {
  SourceFiles files;
  const std::vector<std::uint8_t> pixels = {
      255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255,  //
      255, 255, 255, 255, 10,  0,   20,  255, 255, 255, 255, 0,   255, 255, 255, 255,  //
      255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255, 255};
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 4;
  image.height = 3;
  image.format = PNG_FORMAT_RGBA;
  ASSERT_NE(
      png_image_write_to_file(&image, files.path("m.png").c_str(), 0, pixels.data(), 0, nullptr),
      0);
  const auto trinary = world_from(files.write("t.yaml", head("m.png")));
  const auto scale = world_from(files.write("s.yaml", head("m.png", "mode: scale\n")));

  EXPECT_TRUE(is_blocked(trinary, 0.75, 0.75));
  EXPECT_FALSE(is_blocked(trinary, 1.25, 0.75));
  EXPECT_TRUE(is_blocked(scale, 0.75, 0.75));
  EXPECT_TRUE(is_blocked(scale, 1.25, 0.75));
}

TEST(RosMap, IsRefusedWithItsPlace) {
  SourceFiles files;
  files.write("m.pgm", kPlain);
  files.write("black.pgm", "P2\n2 2\n255\n0 0 0 0\n");
  files.write("short.pgm", "P5\n6 4\n255\nabc");
  const auto refused = [&](const std::string& text) {
    return refusal_of(files.write("bad.yaml", text));
  };

  EXPECT_NE(refused(head("m.pgm", "mode: other\n")).find("bad.yaml:7"), std::string::npos);
  EXPECT_NE(refused(head("m.pgm", "speed: 1\n")).find("speed"), std::string::npos);
  EXPECT_NE(refused(head("none.pgm")).find(":1:8: there is no image '"), std::string::npos);
  EXPECT_NE(refused(head("short.pgm")).find("ends at pixel 3 of 24"), std::string::npos);
  EXPECT_NE(refused(head("black.pgm")).find("no cell has room for a robot of 0.15 m"),
            std::string::npos);
  EXPECT_NE(refused("image: m.pgm\n").find("resolution"), std::string::npos);
  EXPECT_NE(refusal_of(files.write("m.txt", "")).find(".map and .scen"), std::string::npos);
}

TEST(RosMap, AStartInAnObstacleIsRefused) {
  SourceFiles files;
  files.write("m.pgm", kPlain);
  ImportOptions options;
  options.start = core::Pose2{1.75, 0.75, 0.0};

  EXPECT_NE(refusal_of(files.write("m.yaml", head("m.pgm")), options), "");
}

}  // namespace
}  // namespace clew::world_import
