// SPDX-License-Identifier: Apache-2.0
#include "rules/rule_base.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "control/gaps/virtual_target_rules.hpp"
#include "core/angle.hpp"
#include "rules/rule_picture.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::rules {
namespace {

runtime::RunPlan plan_of(const std::string& graph) {
  const runtime::ConfigPath configs({tests::source_path("configs")});
  auto plan = runtime::prepare_run(graph, {}, configs, stages::all());
  EXPECT_TRUE(plan.ok()) << graph;
  return std::move(plan).value();
}

RuleBases bases_of(const std::string& graph) {
  auto bases = rule_bases_of(plan_of(graph));
  EXPECT_TRUE(bases.ok()) << graph;
  return std::move(bases).value();
}

const RuleBase& base_called(const RuleBases& bases, const std::string& name) {
  const auto found = std::find_if(bases.fuzzy.begin(), bases.fuzzy.end(),
                                  [&](const RuleBase& base) { return base.name == name; });
  EXPECT_NE(found, bases.fuzzy.end()) << name;
  return *found;
}

/// The value of a surface's cell that is nearest to these two.
double answer_at(const Surface& surface, double across, double up) {
  const std::size_t rows = surface.values.size() / surface.columns;
  const auto cell = [](const Axis& axis, double value, std::size_t count) {
    const double share = (value - axis.low) / (axis.high - axis.low);
    return static_cast<std::size_t>(std::lround(share * static_cast<double>(count - 1)));
  };
  return surface.values[cell(surface.up, up, rows) * surface.columns +
                        cell(surface.across, across, surface.columns)];
}

class OfAGraph : public testing::TestWithParam<const char*> {};

TEST_P(OfAGraph, EverySetIsADegreeAndAllOfAVariableAddUpToOne) {
  const RuleBases bases = bases_of(GetParam());

  ASSERT_FALSE(bases.fuzzy.empty());
  for (const RuleBase& base : bases.fuzzy) {
    ASSERT_FALSE(base.variables.empty()) << base.name;
    EXPECT_FALSE(base.rules.empty()) << base.name;
    for (const Variable& variable : base.variables) {
      for (std::size_t i = 0; i < variable.sets.front().degrees.size(); ++i) {
        double sum = 0.0;
        for (const FuzzySet& set : variable.sets) {
          EXPECT_GE(set.degrees[i], -1e-12) << set.name;
          EXPECT_LE(set.degrees[i], 1.0) << set.name;
          sum += set.degrees[i];
        }
        EXPECT_NEAR(sum, 1.0, 1e-9) << base.name << ", " << variable.axis.name;
      }
    }
  }
}

TEST_P(OfAGraph, EverySurfaceIsWholeAndFinite) {
  for (const RuleBase& base : bases_of(GetParam()).fuzzy) {
    ASSERT_FALSE(base.surfaces.empty()) << base.name;
    for (const Surface& surface : base.surfaces) {
      EXPECT_EQ(surface.values.size() % surface.columns, 0U);
      EXPECT_TRUE(std::all_of(surface.values.begin(), surface.values.end(),
                              [](double value) { return std::isfinite(value); }));
      const auto [least, most] = std::minmax_element(surface.values.begin(), surface.values.end());
      EXPECT_GT(*most, *least) << base.name << ": " << surface.name;
    }
  }
}

TEST_P(OfAGraph, TheJsonHasEveryValue) {
  for (const RuleBase& base : bases_of(GetParam()).fuzzy) {
    const auto json = nlohmann::json::parse(to_json(base));

    EXPECT_EQ(json["file"], base.name);
    EXPECT_EQ(json["rules"].get<std::vector<std::string>>(), base.rules);
    for (std::size_t i = 0; i < base.surfaces.size(); ++i) {
      EXPECT_EQ(json["surfaces"][i]["values"].get<std::vector<double>>(), base.surfaces[i].values);
    }
    for (std::size_t i = 0; i < base.variables.size(); ++i) {
      EXPECT_EQ(json["variables"][i]["sets"][0]["degrees"].get<std::vector<double>>(),
                base.variables[i].sets[0].degrees);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rules, OfAGraph,
                         testing::Values("krishna_kalra", "nakhaeinia", "pin_bender",
                                         "wang_yang_meng"));

TEST(RuleBases, AreThoseThatTheGraphNames) {
  const RuleBases bases = bases_of("krishna_kalra");

  ASSERT_EQ(bases.fuzzy.size(), 2U);
  EXPECT_EQ(base_called(bases, "krishna_kalra_control").stage, "control");
  EXPECT_EQ(base_called(bases, "obstacle_following").stage, "recover");
  EXPECT_EQ(bases.others, (std::vector<std::string>{"krishna_kalra_som", "krishna_kalra_actions"}));
}

TEST(RuleBases, OfKrishnaAndKalraTurnFromWhatIsNear) {
  const RuleBases bases = bases_of("krishna_kalra");
  const RuleBase& base = base_called(bases, "krishna_kalra_control");
  const Variable& reading = base.variables.front();
  const Surface& turn = base.surfaces.front();

  // Eq. 4 with 0.3 and 0.7: full at 0.3, half at 0.5, gone at 0.7.
  EXPECT_DOUBLE_EQ(reading.sets[0].degrees[30], 1.0);
  EXPECT_NEAR(reading.sets[0].degrees[50], 0.5, 1e-12);
  EXPECT_NEAR(reading.sets[0].degrees[70], 0.0, 1e-12);
  // Eq. 6, of seven sensors: near on the left and ahead, 40 + 55 + 70 + 45 deg to the right; near
  // on the right and ahead, 70 + 55 + 40 - 45 deg to the left. With nothing near, straight on.
  EXPECT_NEAR(answer_at(turn, 0.1, 1.0), -210.0 / 7.0, 1e-9);
  EXPECT_NEAR(answer_at(turn, 1.0, 0.1), 120.0 / 7.0, 1e-9);
  EXPECT_EQ(answer_at(turn, 1.0, 1.0), 0.0);
}

TEST(RuleBases, OfTheVirtualTargetAnswerAsItsTableDoes) {
  const RuleBases bases = bases_of("nakhaeinia");
  const RuleBase& base = base_called(bases, "nakhaeinia_nvt");

  EXPECT_EQ(base.rules.size(), 15U);
  EXPECT_NE(std::find(base.rules.begin(), base.rules.end(),
                      "if the obstacle is dangerous and very near, turn to the target at 1.6 "
                      "rad/s, drive at 0.15 m/s"),
            base.rules.end());
  // Beyond both outermost peaks: safe and very far, so smooth and fast.
  EXPECT_NEAR(base.surfaces[0].values.back(), 0.6, 1e-12);
  EXPECT_NEAR(base.surfaces[1].values.back(), 0.5, 1e-12);
}

TEST(RuleBases, OfTheBehaviouristAreSaidWithTheNamesOfTheirSets) {
  const RuleBases bases = bases_of("pin_bender");
  const RuleBase& base = base_called(bases, "pin_bender_fba");

  EXPECT_NE(std::find(base.rules.begin(), base.rules.end(),
                      "if distance ahead is near and left less right is left, turn at 0.8 rad/s "
                      "(weight 8)"),
            base.rules.end());
  // A target far to the left, and nothing ahead: the robot turns left.
  EXPECT_GT(answer_at(base.surfaces.front(), 120.0, 0.9), 0.3);
}

TEST(RulePicture, ShowsEverySetAndSurfaceByName) {
  const RuleBases bases = bases_of("krishna_kalra");

  const std::string svg = draw("krishna_kalra", bases.fuzzy);

  for (const char* name : {"near", "far", "blocked", "free", "close", "good", "turn to the left",
                           "turn to the wall", "step", "control: krishna_kalra_control"}) {
    EXPECT_NE(svg.find('>' + std::string(name) + '<'), std::string::npos) << name;
  }
  EXPECT_EQ(svg, draw("krishna_kalra", bases.fuzzy));
}

TEST(RuleText, TellsWhereASetIsFullAndWhereItEnds) {
  const RuleBases bases = bases_of("krishna_kalra");

  const std::string text = describe(base_called(bases, "krishna_kalra_control"));

  EXPECT_NE(text.find("near         full: 0 to 0.3           above 0: 0 to 0.69"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace clew::rules
