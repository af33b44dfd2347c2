// SPDX-License-Identifier: Apache-2.0
#include "hunt/setting_tree.hpp"

#include <gtest/gtest.h>

namespace clew::hunt {
namespace {

SettingTree tree(const std::string& yaml) {
  auto parsed = SettingTree::parse(yaml, "g");
  if (!parsed.ok()) ADD_FAILURE() << parsed.error().text();
  return std::move(parsed).value();
}

constexpr char kA[] = R"(seed: 1
control: {behaviour: fuzzy, guard_m: 0.05, names: [x, y]}
recover:
  detector: {revisit: {radius_m: 0.3, loop_m: 1}}
  escape:
    - follow: {leave: nearer}
    - turn: {}
  shadow: []
)";

std::vector<std::string> names_of(const std::vector<SettingDifference>& found) {
  std::vector<std::string> names;
  for (const SettingDifference& difference : found) names.push_back(difference.name());
  return names;
}

using Names = std::vector<std::string>;

TEST(Differences, AreOfTheSmallestPartsThatCanBeChangedAlone) {
  const auto found = differences(tree(kA), tree(R"(seed: 2
control: {behaviour: fuzzy, guard_m: 0.1, names: [x, z]}
recover:
  detector: {revisit: {radius_m: 0.5, loop_m: 1}}
  escape:
    - follow: {leave: paper}
    - turn: {}
  shadow: []
)"));

  EXPECT_EQ(names_of(found),
            (Names{"seed", "control.guard_m", "control.names", "recover.detector.revisit.radius_m",
                   "recover.escape.follow.leave"}));
}

TEST(Differences, OfAnotherBehaviourAreOne) {
  const auto found = differences(tree(kA), tree(R"(seed: 1
control: {behaviour: dwa, horizon_s: 2}
recover:
  detector: {oscillation: {window_s: 5}}
  escape:
    - turn: {}
  shadow: []
plan: {behaviour: map}
)"));

  EXPECT_EQ(names_of(found), (Names{"control", "recover.detector", "recover.escape", "plan"}));
}

TEST(Differences, AllTogetherMakeAOfB) {
  const SettingTree b = tree(R"(seed: 2
control: {behaviour: fuzzy, guard_m: 0.1}
recover:
  detector: {revisit: {radius_m: 0.5, loop_m: 1}}
  escape:
    - follow: {leave: paper}
    - turn: {}
  shadow: [other]
plan: {behaviour: map}
)");
  SettingTree changed = tree(kA);

  for (const SettingDifference& difference : differences(tree(kA), b)) {
    changed = with(changed, difference);
  }

  EXPECT_EQ(changed.line(), b.line());
  EXPECT_TRUE(differences(changed, b).empty());
}

TEST(SettingTree, IsOneLineThatReadsBack) {
  const SettingTree all = tree(kA + std::string("text: \"a: b, #c\"\nnothing: \n"));

  EXPECT_EQ(tree(all.line()).line(), all.line());
  EXPECT_EQ(all.find("control")->find("guard_m")->text, "0.05");
}

}  // namespace
}  // namespace clew::hunt
