// SPDX-License-Identifier: Apache-2.0
#include "recover/escapes/immediate_memory.hpp"

#include <gtest/gtest.h>

#include "tests/recover/scene.hpp"
#include "tests/source_files.hpp"

namespace clew::recover {
namespace {

using tests::rule_base;

using core::radians;
using domain::Network;

ImmediateMemory shipped() {
  return ImmediateMemory::parse(rule_base("krishna_kalra_actions")).value();
}

std::optional<double> turn_for(Network network, std::array<std::uint8_t, 3> classes) {
  return shipped().turn_rad(Scene().recognises(network, 0, classes).landmark());
}

std::string refusal_of(const std::string& actions) {
  const auto memory = ImmediateMemory::parse(
      {"actions.yaml", "format: clew-krishna-kalra-actions/1\nactions:\n" + actions});
  return memory.ok() ? "accepted" : memory.error().message;
}

TEST(ImmediateMemory, TurnsAwayFromACornerOnEitherSide) {
  EXPECT_EQ(turn_for(Network::kSom, {7, 1, 0}), radians(-90.0));
  EXPECT_EQ(turn_for(Network::kSom, {4, 1, 0}), radians(90.0));
}

TEST(ImmediateMemory, TurnsToTheSideThatOpened) {
  EXPECT_EQ(turn_for(Network::kSom, {3, 4, 8}), radians(30.0));
  EXPECT_EQ(turn_for(Network::kSom, {3, 7, 8}), radians(-30.0));
}

TEST(ImmediateMemory, HasNoActionForOtherLandmarks) {
  EXPECT_FALSE(turn_for(Network::kSom, {3, 1, 0}).has_value());
  EXPECT_FALSE(shipped().turn_rad({}).has_value());
}

TEST(ImmediateMemory, IsTheMapsAlone) {
  // ART learns a pattern, but does not know what it stands for.
  EXPECT_FALSE(turn_for(Network::kFuzzyArt, {7, 1, 0}).has_value());
}

TEST(ImmediateMemory, GoesByTheWinnersWeights) {
  domain::Landmark landmark = Scene().recognises(Network::kSom, 0, {7, 1, 0}).landmark();
  landmark.recognitions[0].prototype_classes = {6.9, 1.2, 0.1};
  const auto close = shipped().turn_rad(landmark);
  landmark.recognitions[0].prototype_classes = {6.5, 1.5, 0.0};
  const auto apart = shipped().turn_rad(landmark);

  EXPECT_EQ(close, radians(-90.0));
  EXPECT_FALSE(apart.has_value());  // 0.71 of a class away
}

TEST(ImmediateMemory, RefusesWhatIsNoActionTable) {
  EXPECT_EQ(refusal_of("  - {classes: [7, 1, 9], turn_deg: 60}"),
            "found 9, expected a number from 0 to 8");
  EXPECT_EQ(refusal_of("  - {classes: [7, 1.5, 0], turn_deg: 60}"), "a class is a whole number");
  EXPECT_EQ(refusal_of("  - {classes: [7, 1], turn_deg: 60}"),
            "found a list of 2, expected three classes");
  EXPECT_EQ(refusal_of("  - {classes: [7, 1, 0], turn_deg: 200}"),
            "found 200, expected a number from -180 to 180");
  EXPECT_EQ(refusal_of("  - {classes: [7, 1, 0], turn_deg: 60}\n"
                       "  - {classes: [7, 1, 0], turn_deg: 30}"),
            "this landmark has an action already");
}

}  // namespace
}  // namespace clew::recover
