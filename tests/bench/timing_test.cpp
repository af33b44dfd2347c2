// SPDX-License-Identifier: Apache-2.0
#include "bench/timing.hpp"

#include <gtest/gtest.h>

#include "../recording/scratch_directory.hpp"

namespace clew::bench {
namespace {

using recording_test::ScratchDirectory;
using recording_test::write_bytes;

constexpr char kLine[] =
    R"({"outcome":"reached","graph":"g","world":"w","ticks":7,"start_s":null,"wall_s":0.5,)"
    R"("ticks_per_s":14.0,"seed":1,"variant":""})";
constexpr char kResult[] =
    R"({"outcome":"reached","graph":"g","world":"w","ticks":7,"seed":1,"variant":""})";
constexpr char kTiming[] =
    R"({"graph":"g","variant":"","world":"w","seed":1,"start_s":null,"wall_s":0.5,)"
    R"("ticks_per_s":14.0})";

std::vector<std::string> visited(const std::string& results, const std::string& timing) {
  const ScratchDirectory directory;
  write_bytes(directory.file("results"), "{}\n" + results);
  write_bytes(directory.file("timing"), timing);
  std::vector<std::string> lines;
  EXPECT_TRUE(visit_timed(directory.file("results"), directory.file("timing"),
                          [&](const std::string& line) { lines.push_back(line); })
                  .ok());
  return lines;
}

TEST(Timing, IsTakenOutOfALine) {
  const auto line = take_timing(kLine);

  ASSERT_TRUE(line.ok());
  EXPECT_EQ(line->result, kResult);
  EXPECT_EQ(line->timing, kTiming);
  EXPECT_FALSE(take_timing("[1]").ok());
  EXPECT_FALSE(take_timing("{").ok());
}

TEST(Timing, IsPutBack) {
  EXPECT_EQ(visited(std::string(kResult) + '\n', std::string(kTiming) + '\n'),
            (std::vector<std::string>{
                R"({"outcome":"reached","graph":"g","world":"w","ticks":7,"seed":1,"variant":"",)"
                R"("start_s":null,"wall_s":0.5,"ticks_per_s":14.0})"}));
}

TEST(Timing, IsNullForARunThatHasNone) {
  const std::string other = R"({"graph":"g","variant":"","world":"v","seed":1})";

  const auto lines = visited(other + '\n' + kResult + '\n', std::string(kTiming) + '\n');

  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NE(lines[0].find(R"("wall_s":null)"), std::string::npos);
  EXPECT_NE(lines[1].find(R"("wall_s":0.5)"), std::string::npos);
}

}  // namespace
}  // namespace clew::bench
