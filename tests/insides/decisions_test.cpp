// SPDX-License-Identifier: Apache-2.0
#include "insides/decisions.hpp"

#include <gtest/gtest.h>

namespace clew::insides {
namespace {

domain::Inside with_rules(double first, double second, double weight_of_second) {
  domain::Inside inside;
  domain::InsideGroup& one = inside.values.item("rules");
  one.number("strength", first);
  domain::InsideGroup& two = inside.values.item("rules");
  two.number("strength", second);
  two.number("weight", weight_of_second);
  return inside;
}

domain::Inside with_lattice(bool presented, std::size_t winner) {
  domain::Inside inside;
  inside.values.flag("vector_presented", presented);
  domain::InsideGroup& som = inside.values.group("som");
  som.grid("distances_classes", {2, {1.0, 2.0, 3.0, 4.0}, "column", "row", winner});
  return inside;
}

std::vector<std::uint64_t> decided(const Choice& choice) {
  std::vector<std::uint64_t> counts;
  for (const Case& one : choice.cases) counts.push_back(one.decided);
  return counts;
}

TEST(Decisions, TheRuleThatHoldsMostTimesItsWeightDecides) {
  Decisions decisions;
  decisions.add(with_rules(0.9, 0.3, 1.0));
  decisions.add(with_rules(0.9, 0.3, 4.0));
  decisions.add(with_rules(0.0, 0.3, 1.0));

  ASSERT_EQ(decisions.choices().size(), 1u);
  const Choice& rules = decisions.choices().front();
  EXPECT_EQ(rules.of, "rules");
  EXPECT_EQ(rules.ticks, 3u);
  EXPECT_TRUE(rules.is_closed);
  EXPECT_EQ(decided(rules), (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(rules.cases[0].held, 2u);
  EXPECT_EQ(rules.cases[1].held, 3u);
}

TEST(Decisions, ARuleThatHoldsNowhereIsThereAndHasNoSay) {
  Decisions decisions;
  decisions.add(with_rules(1.0, 0.0, 8.0));

  EXPECT_EQ(decisions.choices().front().cases[1].held, 0u);
  EXPECT_EQ(decisions.choices().front().cases[1].decided, 0u);
}

TEST(Decisions, WhereNoRuleHoldsNoneDecides) {
  Decisions decisions;
  decisions.add(with_rules(0.0, 0.0, 1.0));

  EXPECT_EQ(decided(decisions.choices().front()), (std::vector<std::uint64_t>{0, 0}));
}

TEST(Decisions, ANeuronWinsOnlyWhenAVectorIsPresented) {
  Decisions decisions;
  decisions.add(with_lattice(false, 3));
  decisions.add(with_lattice(true, 2));

  ASSERT_EQ(decisions.choices().size(), 1u);
  const Choice& som = decisions.choices().front();
  EXPECT_EQ(som.of, "som.distances_classes");
  EXPECT_EQ(som.ticks, 1u);
  EXPECT_EQ(decided(som), (std::vector<std::uint64_t>{0, 0, 1, 0}));
  EXPECT_EQ(som.cases[2].name, "row 2, column 1");
}

TEST(Decisions, ASurfaceIsNoChoice) {
  domain::Inside inside;
  inside.values.grid("turn_surface", {1, {1.0, 2.0}, "a", "b", 0});
  Decisions decisions;
  decisions.add(inside);

  EXPECT_TRUE(decisions.choices().empty());
}

TEST(Decisions, StrengthsByNameAreRulesAndTablesOfSeveralNetworksAreApart) {
  domain::Inside inside;
  domain::InsideGroup& strengths = inside.values.group("wall_rules").group("strengths");
  strengths.number("blocked", 0.2);
  strengths.number("free", 0.8);
  for (const char* name : {"left", "right"}) {
    domain::InsideGroup& net = inside.values.item("networks");
    net.text("network", name);
    net.grid("rule_strengths", {2, {0.0, 0.7}, "a", "b", 1});
  }
  Decisions decisions;
  decisions.add(inside);

  ASSERT_EQ(decisions.choices().size(), 3u);
  EXPECT_EQ(decisions.choices()[0].of, "wall_rules.strengths");
  EXPECT_EQ(decided(decisions.choices()[0]), (std::vector<std::uint64_t>{0, 1}));
  EXPECT_EQ(decisions.choices()[1].of, "networks[left].rule_strengths");
  EXPECT_EQ(decisions.choices()[2].of, "networks[right].rule_strengths");
}

TEST(Decisions, CountsCasesAsTheyComeUp) {
  Decisions decisions;
  for (const char* decider : {"controller", "recovery", "controller"}) {
    domain::Inside inside;
    inside.values.text("decided", decider);
    inside.values.text("asked_for", "anything");
    decisions.add(inside);
  }

  ASSERT_EQ(decisions.choices().size(), 1u);
  const Choice& choice = decisions.choices().front();
  EXPECT_FALSE(choice.is_closed);
  EXPECT_EQ(choice.cases[0].name, "controller");
  EXPECT_EQ(decided(choice), (std::vector<std::uint64_t>{2, 1}));
}

TEST(Decisions, AddUpOverRunsByName) {
  Choice one{"decided", 2, false, {{"controller", 2, 2}}};
  const Choice other{"decided", 3, false, {{"recovery", 1, 1}, {"controller", 2, 2}}};

  one.add(other);

  EXPECT_EQ(one.ticks, 5u);
  ASSERT_EQ(one.cases.size(), 2u);
  EXPECT_EQ(one.cases[0].decided, 4u);
  EXPECT_EQ(one.cases[1].decided, 1u);
}

}  // namespace
}  // namespace clew::insides
