// SPDX-License-Identifier: Apache-2.0
#include "hunt/property.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace clew::hunt {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Property property(const std::string& text) {
  auto parsed = Property::parse(text, "p");
  if (!parsed.ok()) ADD_FAILURE() << parsed.error().text();
  return std::move(parsed).value();
}

std::string refusal(const std::string& text) {
  const auto parsed = Property::parse(text, "p");
  return parsed.ok() ? "accepted" : parsed.error().text();
}

/// A run that arrived after 12 m where 10 m are the shortest, a tenth of its time left.
FieldValues arrived() {
  FieldValues values;
  values.set_word(Field::kOutcome, "reached");
  values.set(Field::kPathLength_m, 12.0);
  values.set(Field::kShortestPath_m, 10.0);
  values.set(Field::kPathRatio, 1.2);
  values.set(Field::kSafetyStops, 3.0);
  values.set(Field::kClearance_m, 0.05);
  values.set(Field::kHeldAtEnd, 0.0);
  values.set(Field::kTimeLeft, 0.1);
  return values;
}

std::optional<bool> holds(const std::string& text, const FieldValues& values) {
  return property(text).judge(values).holds;
}

TEST(Property, ComparesFieldsWithNumbersAndWords) {
  const FieldValues run = arrived();

  EXPECT_EQ(holds("outcome == reached and path_ratio < 1.5 and safety_stops <= 5", run), true);
  EXPECT_EQ(holds("outcome != reached", run), false);
  EXPECT_EQ(holds("path_ratio < 1.2", run), false);
  EXPECT_EQ(holds("path_ratio <= 1.2", run), true);
  EXPECT_EQ(holds("safety_stops > 3", run), false);
  EXPECT_EQ(holds("safety_stops >= 3", run), true);
  EXPECT_EQ(holds("3 == safety_stops", run), true);
  EXPECT_EQ(holds("not held_at_end", run), true);
}

TEST(Property, BindsAsMathematicsDoes) {
  const FieldValues run = arrived();

  // Products before sums before comparisons before not before and before or.
  EXPECT_EQ(holds("path_length_m < 2 + 1.01 * shortest_path_m", run), true);
  EXPECT_EQ(holds("path_length_m - shortest_path_m - 1 == 1", run), true);
  EXPECT_EQ(holds("-path_length_m / 2 * 2 == 0 - 12", run), true);
  EXPECT_EQ(holds("not safety_stops == 3 or outcome == reached", run), true);
  EXPECT_EQ(holds("outcome == reached or held_at_end and held_at_end", run), true);
  EXPECT_EQ(holds("(outcome == reached or held_at_end) and held_at_end", run), false);
  EXPECT_EQ(holds("not not (path_length_m == (10 + 2))", run), true);
}

TEST(Property, IsUndecidedOnlyWhereAMissingValueMatters) {
  const FieldValues run = arrived();  // without time_to_alarm_s and captures

  EXPECT_EQ(holds("time_to_alarm_s < 20", run), std::nullopt);
  EXPECT_EQ(holds("not time_to_alarm_s < 20", run), std::nullopt);
  EXPECT_EQ(holds("outcome == reached or time_to_alarm_s < 20", run), true);
  EXPECT_EQ(holds("time_to_alarm_s < 20 and outcome == collided", run), false);
  EXPECT_EQ(holds("outcome == reached and time_to_alarm_s < 20", run), std::nullopt);
  EXPECT_EQ(holds("1 / (safety_stops - 3) > 0", run), std::nullopt);
  EXPECT_FALSE(property("time_to_alarm_s < 20").judge(run).robustness.has_value());
}

TEST(Property, AnAlarmThatNeverCameIsTooLate) {
  FieldValues run = arrived();
  run.set(Field::kTimeToAlarm_s, kInfinity);

  const Verdict verdict = property("time_to_alarm_s < 20").judge(run);

  EXPECT_EQ(verdict.holds, false);
  EXPECT_EQ(verdict.robustness, -kMostRobustness);
  EXPECT_EQ(holds("time_to_alarm_s - time_to_alarm_s == 0", run), std::nullopt);
}

TEST(Property, RobustnessIsTheDistanceInScales) {
  const FieldValues run = arrived();
  const auto robustness = [&](const std::string& text) {
    return *property(text).judge(run).robustness;
  };

  // (1.5 - 1.2) / 1; (5 - 3) / 5; (0.05 - 0.02) / 0.1.
  EXPECT_NEAR(robustness("path_ratio < 1.5"), 0.3, 1e-12);
  EXPECT_NEAR(robustness("safety_stops <= 5"), 0.4, 1e-12);
  EXPECT_NEAR(robustness("clearance_m > 0.02"), 0.3, 1e-12);
  EXPECT_NEAR(robustness("path_ratio < 1"), -0.2, 1e-12);
  EXPECT_NEAR(robustness("path_ratio < 1.5 and safety_stops <= 5"), 0.3, 1e-12);
  EXPECT_NEAR(robustness("path_ratio < 1.5 or safety_stops <= 5"), 0.4, 1e-12);
  EXPECT_NEAR(robustness("not path_ratio < 1.5"), -0.3, 1e-12);
  EXPECT_EQ(robustness("safety_stops == 3"), 1.0);
  EXPECT_NEAR(robustness("safety_stops == 5"), -0.4, 1e-12);
}

TEST(Property, ALateArrivalIsANearMiss) {
  FieldValues run = arrived();

  // A tenth of the time was left, and the way was 1.2 times the shortest.
  EXPECT_NEAR(*property("outcome == reached").judge(run).robustness, 0.1, 1e-12);
  EXPECT_NEAR(*property("outcome != collided").judge(run).robustness, 0.5, 1e-12);
  run.set(Field::kTimeLeft, 0.95);
  EXPECT_NEAR(*property("outcome == reached").judge(run).robustness, 1.0 / 1.2, 1e-12);
  run.set_word(Field::kOutcome, "timeout");
  EXPECT_EQ(property("outcome == reached").judge(run).robustness, -1.0);
}

TEST(Property, PointsAtWhatItDoesNotKnow) {
  EXPECT_EQ(refusal("outcome == reachd"),
            "p:1:12: unknown outcome 'reachd' (did you mean 'reached'?); allowed: reached, "
            "collided, unreachable, timeout, aborted");
  EXPECT_EQ(refusal("path_rato < 1").substr(0, 61),
            "p:1:1: unknown field 'path_rato' (did you mean 'path_ratio'?)");
  EXPECT_EQ(refusal("ticks < 5 and path < 1").substr(0, 28), "p:1:15: unknown field 'path'");
}

TEST(Property, PointsAtWhatIsNoFormula) {
  EXPECT_EQ(refusal(""), "p:1:1: found the end; expected a field, a number or '('");
  EXPECT_EQ(refusal("ticks <"), "p:1:8: found the end; expected a field, a number or '('");
  EXPECT_EQ(refusal("ticks < and"), "p:1:9: found 'and'; expected a field, a number or '('");
  EXPECT_EQ(refusal("(ticks < 3"), "p:1:11: found the end; expected ')'");
  EXPECT_EQ(refusal("ticks < 3 ticks"), "p:1:11: found 'ticks'; expected and, or, or the end");
  EXPECT_EQ(refusal("ticks = 3"), "p:1:7: found '='; equality is '=='");
  EXPECT_EQ(refusal("ticks < 3 && ticks > 1"), "p:1:11: found '&'; allowed: and, or, not, !=");
  EXPECT_EQ(refusal("1 < ticks < 3"),
            "p:1:11: comparisons do not chain; join two of them by 'and'");
  EXPECT_EQ(refusal("ticks < 1e999"), "p:1:9: expected a finite number");
  EXPECT_EQ(refusal("ticks < 1.2.3"),
            "p:1:12: a number ends here; expected an operator, found '.'");
  EXPECT_EQ(refusal("ticks < \x01").substr(0, 32), "p:1:9: found a control character");
}

TEST(Property, PointsAtWhatCannotBeCompared) {
  EXPECT_EQ(refusal("ticks"), "p:1:1: this is a number; expected a comparison or a flag");
  EXPECT_EQ(refusal("ticks and held_at_end"),
            "p:1:1: this is a number; expected a comparison or a flag");
  EXPECT_EQ(refusal("ticks < held_at_end"), "p:1:9: this holds or not; expected a number");
  EXPECT_EQ(refusal("(ticks < 3) + 1 > 2"), "p:1:2: this holds or not; expected a number");
  EXPECT_EQ(refusal("outcome < reached"), "p:1:9: words have no order; allowed: ==, !=");
  EXPECT_EQ(refusal("outcome == 3").substr(0, 28), "p:1:12: found '3'; expected ");
  EXPECT_EQ(refusal("not outcome").substr(0, 29), "p:1:5: a field of words is co");
  EXPECT_EQ(refusal("-held_at_end < 1"), "p:1:2: this holds or not; expected a number");
}

TEST(Property, RefusesWhatIsTooLargeToBeMeant) {
  const std::string deep(Property::kDeepest, '(');
  EXPECT_EQ(refusal(deep + "ticks < 1"), "p:1:65: nested too deep; at most 64 levels are allowed");
  std::string longest = "ticks < 1";
  while (longest.size() + 14 <= Property::kMostLength) longest += " and ticks < 1";
  EXPECT_EQ(refusal(longest), "accepted");
  EXPECT_EQ(refusal(longest + " and ticks < 1").substr(0, 5), "p: is");
}

TEST(Property, KnowsWhichFieldsItUses) {
  const Property about = property("outcome == reached and 2 * captures < ticks");

  EXPECT_TRUE(about.uses(Field::kCaptures));
  EXPECT_TRUE(about.uses(Field::kOutcome));
  EXPECT_FALSE(about.uses(Field::kTimeToAlarm_s));
}

TEST(RunFields, HaveNamesThatPropertiesCanSay) {
  for (const FieldInfo& info : fields()) {
    const std::string statement = info.type == FieldType::kNumber ? info.name + " < 1"
                                  : info.type == FieldType::kFlag
                                      ? info.name
                                      : info.name + " == " + info.words[0];
    EXPECT_EQ(refusal(statement), "accepted");
    EXPECT_GT(info.scale, 0.0) << info.name;
  }
}

}  // namespace
}  // namespace clew::hunt
