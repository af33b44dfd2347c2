// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/world_import/source_files.hpp"
#include "world_import/npy_path.hpp"

namespace clew::world_import {
namespace {

constexpr char kMap[] = "type octile\nheight 3\nwidth 5\nmap\n.....\n.@TS.\n..G..\n";

TEST(MovingAi, RowsGoFromTheTopAndLettersAreFreeOrBlocked) {
  SourceFiles files;
  const auto world = world_from(files.write("m.map", kMap));

  EXPECT_EQ(world.bounds_max(), core::Vec2(2.5, 1.5));
  EXPECT_TRUE(is_blocked(world, 0.75, 0.75));   // @
  EXPECT_TRUE(is_blocked(world, 1.25, 0.75));   // T
  EXPECT_FALSE(is_blocked(world, 1.75, 0.75));  // S
  EXPECT_FALSE(is_blocked(world, 1.25, 0.25));  // G
}

TEST(MovingAi, ANumberOfMetresACellIsTheUsers) {
  SourceFiles files;
  ImportOptions options;
  options.cell_m = 2.0;
  const auto world = world_from(files.write("m.map", kMap), options);

  EXPECT_EQ(world.bounds_max(), core::Vec2(10.0, 6.0));
}

TEST(MovingAi, AScenarioGivesStartAndTarget) {
  SourceFiles files;
  files.write("m.map", kMap);
  const std::string scenarios = files.write(
      "m.map.scen",
      "version 1\n0\tmaps/m.map\t5\t3\t0\t0\t4\t0\t4\n1\tmaps/m.map\t5\t3\t0\t2\t4\t0\t5.2\n");
  ImportOptions first;
  first.scenario = 1;
  const auto last_one = world_from(scenarios);
  const auto first_one = world_from(scenarios, first);

  EXPECT_EQ(first_one.start().position(), core::Vec2(0.25, 1.25));
  EXPECT_EQ(first_one.target(), core::Vec2(2.25, 1.25));
  EXPECT_EQ(last_one.start().position(), core::Vec2(0.25, 0.25));
  first.scenario = 3;
  EXPECT_NE(refusal_of(scenarios, first).find("has 2 scenarios"), std::string::npos);
}

TEST(MovingAi, IsRefusedWithItsPlace) {
  SourceFiles files;
  const auto refused = [&](const std::string& text) {
    return refusal_of(files.write("bad.map", text));
  };

  EXPECT_NE(refused("octile\n").find("bad.map:1: found 'octile'"), std::string::npos);
  EXPECT_NE(refused("type octile\nheight 0\n").find("bad.map:2"), std::string::npos);
  EXPECT_NE(refused("type octile\nheight 1\nwidth 2\nmap\n.x\n").find("bad.map:5:2: found 'x'"),
            std::string::npos);
  EXPECT_NE(refused("type octile\nheight 1\nwidth 2\nmap\n...\n").find("has 3 cells; allowed: 2"),
            std::string::npos);
  EXPECT_NE(refused("type octile\nheight 2\nwidth 2\nmap\n..\n").find("ends after row 1 of 2"),
            std::string::npos);
}

TEST(MovingAi, ADosFileIsTheSame) {
  SourceFiles files;
  std::string dos;
  for (const char* c = kMap; *c != '\0'; ++c) {
    if (*c == '\n') dos += '\r';
    dos += *c;
  }
  const auto world = world_from(files.write("m.map", dos));

  EXPECT_TRUE(is_blocked(world, 0.75, 0.75));
}

std::string model(const std::string& name, const std::string& pose, const std::string& shape) {
  return "<model name='" + name + "'><pose>" + pose +
         "</pose><link name='l'><pose>1 0 0 0 0 0</pose><collision name='c'><geometry>" + shape +
         "</geometry></collision></link></model>\n";
}
std::string sdf(const std::string& models) {
  return "<sdf version='1.6'><world name='w'>" + models +
         "<state><model name='a'><pose>99 0 0 0 0 0</pose></model></state></world></sdf>";
}
constexpr char kCylinder[] = "<cylinder><radius>0.5</radius><length>1</length></cylinder>";

TEST(Gazebo, PosesOfModelLinkAndCollisionAddUp) {
  SourceFiles files;
  ImportOptions options;
  options.start = core::Pose2{0.5, 0.5, 0.0};
  options.target = core::Vec2(3.0, 0.2);
  // The cylinder's link lies 1 m ahead of its model, which looks along +y.
  const auto world = world_from(
      files.write("a.world", sdf(model("ground", "0 0 0 0 0 0", "<plane><size>9 9</size></plane>") +
                                 model("a", "0 2 0 0 0 1.5707963", kCylinder) +
                                 model("b", "3 1 0 0 0 0", "<box><size>2 1 1</size></box>"))),
      options);

  ASSERT_EQ(world.circles().size(), 1U);
  EXPECT_NEAR(world.circles()[0].centre.x(), 0.0, 1e-6);
  EXPECT_NEAR(world.circles()[0].centre.y(), 3.0, 1e-6);
  EXPECT_TRUE(is_blocked(world, 4.9, 1.4));
  EXPECT_FALSE(is_blocked(world, 2.9, 1.0));
  EXPECT_NEAR(world.bounds_max().x(), 5.0, 1e-9);
}

TEST(Gazebo, IsRefusedByTheModelsName) {
  SourceFiles files;
  ImportOptions options;
  options.start = core::Pose2{};
  options.target = core::Vec2(1.0, 1.0);
  const auto refused = [&](const std::string& models) {
    return refusal_of(files.write("bad.world", sdf(models)), options);
  };

  EXPECT_NE(refused(model("m", "0 0 0 0 0 0", "<mesh/>")).find("model m: <mesh>"),
            std::string::npos);
  EXPECT_NE(refused(model("m", "0 0 0 0.5 0 0", kCylinder)).find("model m: is tilted"),
            std::string::npos);
  EXPECT_NE(refused(model("m", "0 0 0", kCylinder)).find("expected 6 numbers"), std::string::npos);
  EXPECT_NE(refused("").find("has no obstacle"), std::string::npos);
  EXPECT_NE(refusal_of(files.write("x.world", "<sdf>"), options), "");
  EXPECT_NE(refusal_of(files.write("a.world", sdf(model("a", "0 0 0 0 0 0", kCylinder))))
                .find("give --start and --target"),
            std::string::npos);
}

/// An array as NumPy 1.x writes it.
std::string npy(const std::vector<std::int64_t>& numbers, const std::string& shape) {
  std::string header = "{'descr': '<i8', 'fortran_order': False, 'shape': " + shape + ", }";
  header.resize(118, ' ');
  header.back() = '\n';
  std::string bytes("\x93NUMPY\x01\x00\x76\x00", 10);
  bytes += header;
  for (const std::int64_t number : numbers) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  return bytes;
}

TEST(BarnWorld, HasTheBenchmarksMissionAndItsPathsLength) {
  SourceFiles files;
  files.write("path_7.npy", npy({15, 0, 15, 10, 15, 30}, "(3, 2)"));
  const auto world =
      world_from(files.write("world_7.world", sdf(model("a", "-5.425 0.075 0 0 0 0", kCylinder) +
                                                  model("b", "-1.075 9.525 0 0 0 0", kCylinder))));

  EXPECT_EQ(world.start().position(), core::Vec2(-2.25, 3.0));
  EXPECT_EQ(world.target(), core::Vec2(-2.25, 13.0));
  EXPECT_EQ(world.target_radius_m(), 1.0);
  // 30 cells of 0.15 m.
  EXPECT_NE(world.about().find("4.500 m"), std::string::npos) << world.about();
}

TEST(NpyPoints, AreReadAndRefused) {
  SourceFiles files;
  const auto points = read_npy_points(files.write("p.npy", npy({1, -2, 3, 4}, "(2, 2)")));

  ASSERT_TRUE(points.ok()) << points.error().text();
  EXPECT_EQ((*points)[0], core::Vec2(1.0, -2.0));
  EXPECT_EQ((*points)[1], core::Vec2(3.0, 4.0));
  EXPECT_FALSE(read_npy_points(files.write("p.npy", npy({1, 2, 3}, "(2, 2)"))).ok());
  EXPECT_FALSE(read_npy_points(files.write("p.npy", npy({1, 2}, "(1, 3)"))).ok());
  EXPECT_FALSE(read_npy_points(files.write("p.npy", "\x93NUMPY")).ok());
}

}  // namespace
}  // namespace clew::world_import
