// SPDX-License-Identifier: Apache-2.0
#include "plot/plot.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../recording/scratch_directory.hpp"
#include "plot/svg_writer.hpp"
#include "small_run.hpp"

namespace clew::plot_test {
namespace {

using plot::plot_recordings;
using recording_test::read_bytes;
using recording_test::ScratchDirectory;

class Plot : public testing::Test {
 protected:
  Plot() { run_.write(recording_); }

  std::string svg_of(const std::vector<std::string>& recordings) {
    const std::string output = scratch_.file("out.svg");
    const auto plotted = plot_recordings(recordings, output);
    EXPECT_TRUE(plotted.ok()) << plotted.error().text();
    return read_bytes(output);
  }

  const ScratchDirectory scratch_;
  const std::string recording_ = scratch_.file("run.mcap");
  const SmallRun run_;
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(Plot, SaysHowTheRunWent) {
  const std::string svg = svg_of({recording_});

  EXPECT_TRUE(contains(svg, ">small: reached after 4.5 s (tick 9)</text>"));
  EXPECT_TRUE(contains(svg, ">path 4.5 m (shortest 4.3 m), 1 trap, 1 safety stop, seed 7</text>"));
}

TEST_F(Plot, ExplainsEveryMarkThatIsInIt) {
  const std::string svg = svg_of({recording_});

  for (const char* entry :
       {"path", "path under recovery", "robot at the start", "target",
        "moving obstacle at the start", "moving obstacle at the end", "landmark known to the SOM",
        "landmark known to ART", "trap detected", "earlier visit that proves it", "escape begun",
        "escape ended, way open", "virtual target", "safety stop", "hit by a moving obstacle",
        "end of the run"}) {
    EXPECT_TRUE(contains(svg, ">" + std::string(entry) + "</text>")) << entry;
  }
  EXPECT_FALSE(contains(svg, ">collision</text>"));
  EXPECT_FALSE(contains(svg, ">trap, by a shadow detector</text>"));
}

TEST_F(Plot, DrawsPathAndRecoveryWhereTheRobotWent) {
  // The map is 720 pixels wide for 10 m, its corner at (24, 80): (1, 2) is at 24 + 72, 80 + 6 * 72.
  const std::string svg = svg_of({recording_});

  EXPECT_TRUE(contains(svg,
                       "<path d=\"M96 512L132 512L168 512L204 512L240 512\" fill=\"none\" "
                       "stroke=\"#0072B2\""));
  EXPECT_TRUE(contains(svg,
                       "<path d=\"M240 512L276 512L312 512L348 512\" fill=\"none\" "
                       "stroke=\"#D55E00\""));
  EXPECT_TRUE(contains(svg,
                       "<path d=\"M348 512L384 512L420 512\" fill=\"none\" "
                       "stroke=\"#0072B2\""));
}

TEST_F(Plot, IsTheSameBytesEveryTime) { EXPECT_EQ(svg_of({recording_}), svg_of({recording_})); }

TEST_F(Plot, ShowsSeveralRunsInOnePicture) {
  const std::string other = scratch_.file("other.mcap");
  run_.write(other);

  const std::string svg = svg_of({recording_, other});

  EXPECT_TRUE(contains(svg, ">small: 2 runs</text>"));
  EXPECT_TRUE(contains(svg, ">run</text>"));
  EXPECT_TRUE(contains(svg, ">other</text>"));
}

TEST_F(Plot, NamesAllBehavioursOfARunBesideOthers) {
  const std::string other = scratch_.file("other.mcap");
  SmallRun run;
  run.description.bundle["graph.yaml"] =
      "format: clew-graph/1\nname: default\nrecover: {detector: known_detour, escape: "
      "[remembered_map, obstacle_following]}\n";
  run.write(other);

  const std::string svg = svg_of({recording_, other});

  EXPECT_TRUE(contains(svg, ">default, known_detour,</text>"));
  EXPECT_TRUE(contains(svg, ">remembered_map+</text>"));
  EXPECT_TRUE(contains(svg, ">obstacle_following</text>"));
}

TEST_F(Plot, SaysThatARecordingWasCutOff) {
  const std::string cut = scratch_.file("cut.mcap");
  run_.write(cut, false);

  EXPECT_TRUE(contains(svg_of({cut}), ">small: recording cut off after 3.5 s (tick 7)</text>"));
}

TEST_F(Plot, RendersPngs) {
  const std::string output = scratch_.file("out.png");

  const auto plotted = plot_recordings({recording_}, output);

  ASSERT_TRUE(plotted.ok()) << plotted.error().text();
  EXPECT_EQ(read_bytes(output).substr(0, 8), "\x89PNG\r\n\x1A\n");
}

/// A robot's world as a fleet has it: in a room, another robot jumps about.
std::string robot_world(const std::string& start, const std::string& target,
                        const std::string& other) {
  return "format: clew-world/1\nname: hall\nabout: \"A hall.\"\nbounds: [0, 0, 10, 8]\n"
         "walls: [[5, 3, 5, 8]]\nstart: [" +
         start + ", 0]\ntarget: [" + target + "]\ntarget_radius: 0.3\nmoving: [{circle: [" + other +
         ", 0.2], path: [[0, " + other + "], [1, " + other + "]], jumps: true}]\n";
}

TEST_F(Plot, DrawsTheRobotsOfAFleetInOneRoom) {
  const std::string west = scratch_.file("west.mcap");
  const std::string east = scratch_.file("east.mcap");
  SmallRun robot;
  robot.description.bundle["world.yaml"] = robot_world("1, 2", "9, 2", "8, 1");
  robot.write(west);
  robot.description.bundle["world.yaml"] = robot_world("8, 1", "2, 1", "1, 2");
  robot.write(east);

  const std::string svg = svg_of({west, east});

  EXPECT_TRUE(contains(svg, ">hall: 2 robots</text>"));
  EXPECT_FALSE(contains(svg, ">moving obstacle at the end</text>"));
  // The targets, (9, 2) and (2, 1), and the starts, (1, 2) and (8, 1).
  for (const char* centre : {"cx=\"672\" cy=\"512\"", "cx=\"168\" cy=\"584\"",
                             "cx=\"96\" cy=\"512\"", "cx=\"600\" cy=\"584\""}) {
    EXPECT_TRUE(contains(svg, centre)) << centre;
  }
  // Alone, the other is what moves about.
  EXPECT_TRUE(contains(svg_of({west}), ">moving obstacle at the end</text>"));
}

TEST_F(Plot, RefusesRobotsOfOtherRooms) {
  const std::string one = scratch_.file("one.mcap");
  const std::string other = scratch_.file("other.mcap");
  SmallRun robot;
  robot.description.bundle["world.yaml"] = robot_world("1, 2", "9, 2", "8, 1");
  robot.write(one);
  robot.description.bundle["world.yaml"] = robot_world("8, 1", "2, 1", "1, 2");
  robot.description.bundle["world.yaml"].replace(
      robot.description.bundle["world.yaml"].find("5, 3, 5, 8"), 10, "5, 4, 5, 8");
  robot.write(other);

  EXPECT_FALSE(plot_recordings({one, other}, scratch_.file("out.svg")).ok());
}

TEST_F(Plot, NumbersTheWayPointsOfAGraphBeforeThoseOfItsWorld) {
  const std::string file = scratch_.file("mission.mcap");
  SmallRun run;
  run.description.bundle["graph.yaml"] = "format: clew-graph/1\nmission: [[4, 4, 0.5], [6, 6]]\n";
  run.write(file);

  const std::string svg = svg_of({file});

  EXPECT_TRUE(contains(svg, "cx=\"312\" cy=\"368\" r=\"36\""));
  EXPECT_TRUE(contains(svg, ">1</text>"));
  EXPECT_TRUE(contains(svg, ">2</text>"));
}

TEST_F(Plot, RefusesRunsInDifferentWorlds) {
  const std::string other = scratch_.file("other.mcap");
  SmallRun elsewhere;
  elsewhere.description.bundle["world.yaml"] += "# another text\n";
  elsewhere.write(other);

  const auto plotted = plot_recordings({recording_, other}, scratch_.file("out.svg"));

  ASSERT_FALSE(plotted.ok());
  EXPECT_EQ(plotted.error().text(), other + ": was made in another world than " + recording_);
}

TEST_F(Plot, RefusesOutputsThatItCannotWrite) {
  const auto wrong_ending = plot_recordings({recording_}, "out.gif");
  const auto nowhere = plot_recordings({recording_}, scratch_.file("no/where.svg"));

  ASSERT_FALSE(wrong_ending.ok());
  EXPECT_EQ(wrong_ending.error().text(), "out.gif: found ending '.gif'; allowed: .svg, .png, .pdf");
  ASSERT_FALSE(nowhere.ok());
  EXPECT_EQ(nowhere.error().text(),
            scratch_.file("no/where.svg") + ": cannot be written: No such file or directory");
}

TEST_F(Plot, RefusesWhatIsNoRecording) {
  const std::string text = scratch_.file("text.mcap");
  recording_test::write_bytes(text, "this is not a recording");

  const auto plotted = plot_recordings({text}, scratch_.file("out.svg"));

  ASSERT_FALSE(plotted.ok());
  EXPECT_EQ(plotted.error().text(), text + ": is not an MCAP file");
}

TEST(SvgWriter, WritesNumbersWithAtMostTwoDecimals) {
  EXPECT_EQ(plot::short_number(0.0), "0");
  EXPECT_EQ(plot::short_number(-0.001), "0");
  EXPECT_EQ(plot::short_number(12.5), "12.5");
  EXPECT_EQ(plot::short_number(-0.254), "-0.25");
  EXPECT_EQ(plot::short_number(3.999), "4");
  EXPECT_EQ(plot::short_number(100000.05), "100000.05");
}

TEST(SvgWriter, EscapesWhatXmlDoesNotAllowInText) {
  plot::SvgWriter svg(10.0, 10.0);

  svg.text({1.0, 2.0}, "a<b & \"c\"\x01");

  EXPECT_TRUE(contains(std::move(svg).finish(), ">a&lt;b &amp; &quot;c&quot; </text>"));
}

TEST(SvgWriter, ReplacesWhatIsNoUtf8) {
  plot::SvgWriter svg(10.0, 10.0);

  // Latin 1, a sequence cut short, one too long for its character, half of a surrogate pair.
  svg.text({1.0, 2.0}, "\xe9|\xc3|\xc0\xaf|\xed\xa0\x80|\xc3\xa9\xf0\x9f\xa4\x96");

  const std::string no_character = "\xef\xbf\xbd";
  EXPECT_TRUE(contains(std::move(svg).finish(), '>' + no_character + '|' + no_character + '|' +
                                                    no_character + no_character + '|' +
                                                    no_character + no_character + no_character +
                                                    "|\xc3\xa9\xf0\x9f\xa4\x96</text>"));
}

}  // namespace
}  // namespace clew::plot_test
