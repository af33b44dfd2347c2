// SPDX-License-Identifier: Apache-2.0
#include "hunt/case_file.hpp"

#include <gtest/gtest.h>

namespace clew::hunt {
namespace {

CaseFile sample() {
  CaseFile file;
  file.about = "a \"quoted\" back\\slash";
  file.property = "outcome == reached";
  file.graph = {"reactive", {"recover=a,b"}, {"sense.range_m=1.5", "x.y=[1, 2]"}, "disc-025", 3000};
  file.world = "world.yaml";
  file.seed = 17;
  file.outcome = "timeout";
  file.hash = "0123";
  return file;
}

TEST(CaseFile, ReadsWhatItWrote) {
  const std::string text = case_text(sample());

  const auto read = parse_case(text, "c.yaml");

  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_EQ(case_text(*read), text);
  EXPECT_EQ(read->graph.set, sample().graph.set);
  EXPECT_EQ(read->about, sample().about);
  EXPECT_EQ(read->hash, "0123");
  EXPECT_TRUE(is_case(text, "c.yaml"));
}

TEST(CaseFile, IsNoWorld) {
  EXPECT_FALSE(is_case("format: clew-world/1\n", "w.yaml"));
  EXPECT_FALSE(is_case("[", "w.yaml"));
}

TEST(CaseFile, IsRefusedWithItsPlace) {
  const std::string good = case_text(sample());
  EXPECT_EQ(parse_case(good + "sed: 3\n", "c.yaml").error().line, 13);
  EXPECT_NE(parse_case("format: clew-case/1\nproperty: x\n", "c.yaml").error().text().find("graph"),
            std::string::npos);
  EXPECT_FALSE(parse_case("format: clew-case/2\n", "c.yaml").ok());
}

TEST(CaseFile, GivesACommandThatAShellUnderstands) {
  EXPECT_EQ(command_line(sample().graph, "my world.yaml", 17),
            "clew run reactive --world 'my world.yaml' --robot disc-025 --with recover=a,b --set "
            "sense.range_m=1.5 --set 'x.y=[1, 2]' --seed 17 --max-ticks 3000 --layout composed");
}

}  // namespace
}  // namespace clew::hunt
