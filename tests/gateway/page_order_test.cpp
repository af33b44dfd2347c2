// SPDX-License-Identifier: Apache-2.0
#include "view/page_order.hpp"

#include <gtest/gtest.h>

#include "stages/all.hpp"

namespace clew::view {
namespace {

using Texts = std::vector<std::string>;

PageOrder order_of(const char* json) {
  const auto order = read_order(json, stages::all());
  EXPECT_TRUE(order.ok()) << json;
  return order.ok() ? *order : PageOrder{};
}

TEST(PageOrder, SaysWhatACommandLineSays) {
  EXPECT_EQ(order_of(R"({"order": "pause"})").order, "pause");
  EXPECT_EQ(order_of(R"({"order": "step", "ticks": 3})").words, Texts{"3"});
  EXPECT_EQ(order_of(R"({"order": "pace", "factor": 2.5})").words, Texts{"2.5x"});
  EXPECT_EQ(order_of(R"({"order": "pace", "factor": 0})").words, Texts{"lockstep"});
  const PageOrder goal = order_of(R"({"order": "goal", "x": 3.25, "y": -1})");
  EXPECT_EQ(goal.changes, Texts{"goal=3.25,-1"});
  EXPECT_EQ(goal.words, (Texts{"3.25", "-1"}));
}

TEST(PageOrder, NamesBehavioursAndValuesAsSwapDoes) {
  const PageOrder swap = order_of(
      R"({"order": "swap", "with": {"recover.detector": ["none"]}, "set": [{"stage": "control",
          "part": "behaviour", "behaviour": "fuzzy_behaviourist", "name": "rules",
          "value": "pin_bender_fba"}]})");

  EXPECT_EQ(swap.changes, (Texts{"recover.detector=none", "control.rules=pin_bender_fba"}));
  EXPECT_EQ(swap.words, (Texts{"recover.detector=none", "--set=control.rules=pin_bender_fba"}));
}

TEST(PageOrder, HoldsRuleBasesThatWereWrittenOnThePage) {
  const PageOrder swap = order_of(
      R"({"order": "swap", "rules": [{"stage": "control", "part": "behaviour",
          "behaviour": "fuzzy_behaviourist", "name": "rules", "text": "format: x"}]})");

  EXPECT_TRUE(swap.changes.empty());
  ASSERT_EQ(swap.rules.size(), 1U);
  EXPECT_EQ(swap.rules[0].place, "control.rules");
  EXPECT_EQ(swap.rules[0].text, "format: x");
}

TEST(PageOrder, IsRefusedWhereAPageMayNotAsk) {
  for (const char* json :
       {"", "[]", "{}", R"({"order": "kill"})", R"({"order": "step", "ticks": 0})",
        R"({"order": "step", "ticks": -1})", R"({"order": "pace"})",
        R"({"order": "pace", "factor": 1e-9})", R"({"order": "pace", "factor": "fast"})",
        R"({"order": "goal", "x": 1})", R"({"order": "goal", "x": 1e99, "y": 0})",
        R"({"order": "swap"})", R"({"order": "swap", "with": {"control": ["polar"]}})",
        R"({"order": "swap", "with": {"recover.detector": ["/bin/sh"]}})",
        R"({"order": "swap", "with": {"recover.detector": ["none,exec=sh"]}})",
        R"({"order": "swap", "rules": [{"stage": "control", "part": "behaviour",
            "behaviour": "fuzzy_behaviourist", "name": "rules", "text": ""}]})",
        R"({"order": "swap", "rules": [{"stage": "recover", "name": "trace_m", "text": "x"}]})",
        R"({"order": "swap", "set": [{"stage": "control", "part": "behaviour",
            "behaviour": "fuzzy_behaviourist", "name": "rules", "value": "../../etc/passwd"}]})"}) {
    EXPECT_FALSE(read_order(json, stages::all()).ok()) << json;
  }
}

}  // namespace
}  // namespace clew::view
