// SPDX-License-Identifier: Apache-2.0
#include "classify/som.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/source_files.hpp"

namespace clew::classify {
namespace {

using tests::file_of;
using tests::with;

core::Resource shipped() { return file_of("configs/rulebases/krishna_kalra_som.yaml"); }

std::string refusal_of(const std::string& text) {
  const auto map = Som::parse({"som.yaml", text});
  return map.ok() ? "accepted" : map.error().message;
}

TEST(Som, RecallsTheNearestNeuron) {
  Som::Lattice lattice;
  for (Som::Neuron& neuron : lattice) neuron.weights = {8, 8, 8};
  lattice[10].weights = {7, 1, 0};
  lattice[20].weights = {3, 1, 0};
  const Som map(lattice);

  const Som::Recall recall = map.recall({3, 2, 1});

  // (0, 1, 1) away from neuron 20.
  EXPECT_EQ(recall.neuron, 20u);
  EXPECT_NEAR(recall.distance, std::sqrt(2.0), 1e-12);
}

TEST(Som, PrefersTheFirstOfEquals) {
  Som::Lattice lattice;
  for (Som::Neuron& neuron : lattice) neuron.weights = {8, 8, 8};
  lattice[30].weights = lattice[31].weights = {3, 1, 0};

  EXPECT_EQ(Som(lattice).recall({3, 1, 0}).neuron, 30u);
}

TEST(ShippedSom, KnowsTheLandmarksOfThePaper) {
  const auto map = Som::parse(shipped());
  ASSERT_TRUE(map.ok()) << map.error().text();

  // Figures 1, 8 and 13, and their mirror images.
  for (const Triple& landmark :
       {Triple{3, 1, 0}, Triple{7, 1, 0}, Triple{4, 1, 0}, Triple{3, 4, 8}, Triple{3, 7, 8}}) {
    const Som::Recall recall = map->recall(landmark);
    EXPECT_LT(recall.distance, 0.5);
    EXPECT_TRUE(map->neuron(recall.neuron).lower_bounds.has_value());
  }
}

TEST(ShippedSom, RecallsTheStringsOfThePaper) {
  const auto map = Som::parse(shipped());
  ASSERT_TRUE(map.ok()) << map.error().text();

  // Figure 1a, 3 twelve times, 1 twice and 0; figure 1b, 3 six times; and the paper's lower bounds.
  const auto& bounds = map->neuron(map->recall({3, 1, 0}).neuron).lower_bounds;
  ASSERT_TRUE(bounds.has_value());
  for (const std::uint32_t threes : {12u, 6u, 4u}) {
    EXPECT_TRUE(reaches({threes, 2, 1}, *bounds)) << threes;
  }
}

TEST(ShippedSom, DoesNotKnowTheTrapOfFigureFourteen) {
  const auto map = Som::parse(shipped());
  ASSERT_TRUE(map.ok()) << map.error().text();

  // The cycle of that world: a wall of boulders, free space, and a short look at all sides.
  for (const Triple& vector : {Triple{7, 8, 1}, Triple{8, 1, 0}, Triple{8, 1, 5}}) {
    const Som::Recall recall = map->recall(vector);
    EXPECT_TRUE(recall.distance > 0.5 || !map->neuron(recall.neuron).lower_bounds);
  }
}

TEST(Som, RefusesWhatIsNoTrainedMap) {
  const std::string text = shipped().text;

  EXPECT_EQ(refusal_of(with(text, "clew-krishna-kalra-som/1", "clew-som")),
            "found 'clew-som', expected clew-krishna-kalra-som/1");
  EXPECT_EQ(refusal_of(text + "  - {weights: [1, 2, 3]}\n"), "found 50 neurons, expected 49");
  EXPECT_EQ(refusal_of(with(text, "{weights: [", "{weights: [9, ")),
            "found a list of 4, expected three classes");
  const std::size_t first = text.find("{weights: [") + 11;
  EXPECT_EQ(refusal_of(text.substr(0, first) + '-' + text.substr(first)).find("found -"), 0u);
  const std::size_t bounds = text.find("lower_bounds: [") + 15;
  EXPECT_EQ(refusal_of(text.substr(0, bounds) + "0.5, " + text.substr(text.find(',', bounds) + 2)),
            "found 0.5, expected whole numbers of at least 1");
}

}  // namespace
}  // namespace clew::classify
