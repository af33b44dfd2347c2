// SPDX-License-Identifier: Apache-2.0
#include "classify/krishna_kalra.hpp"

#include <gtest/gtest.h>

#include "core/angle.hpp"
#include "tests/source_files.hpp"

namespace clew::classify {
namespace {

constexpr double kFar = 1.0;
constexpr double kNear = 0.5;
constexpr double kVeryNear = 0.1;

/// A scan of the given class; see Table I.
domain::Scan scan_of(int spatial_class) {
  const int row = spatial_class - 1;
  double left = (row & 1) != 0 ? kFar : kNear;
  double centre = (row & 2) != 0 ? kFar : kNear;
  double right = (row & 4) != 0 ? kFar : kNear;
  if (spatial_class == 0) left = centre = right = kVeryNear;
  domain::Scan scan;
  scan.bearing_first_rad = core::radians(45.0);
  scan.bearing_step_rad = core::radians(-15.0);
  scan.beam_width_rad = core::radians(15.0);
  scan.range_max_m = 1.0;
  scan.ranges_m = {left, left, left, centre, right, right, right};
  return scan;
}

/// A map that knows [3 1 0] as neuron 5, with the bounds of figure 3.
Som small_map() {
  Som::Lattice lattice;
  for (Som::Neuron& neuron : lattice) neuron.weights = {8, 8, 8};
  lattice[5].weights = {3, 1, 0};
  lattice[5].lower_bounds = RunLengths{4, 2, 2};
  return Som(lattice);
}

/// Feeds a classifier with one class after the other.
class Feed {
 public:
  explicit Feed(const KrishnaKalraParameters& parameters) : classifier(parameters, small_map()) {}

  domain::Landmark add(int spatial_class) {
    domain::Odometry odometry;
    odometry.stamp.tick = tick++;
    domain::Landmark landmark;
    classifier.step(odometry, scan_of(spatial_class), landmark);
    return landmark;
  }
  domain::Landmark add_all(const std::vector<int>& classes) {
    domain::Landmark last;
    for (const int spatial_class : classes) last = add(spatial_class);
    return last;
  }

  KrishnaKalra classifier;
  std::uint64_t tick = 0;
};

TEST(KrishnaKalra, TellsClassAndRun) {
  Feed feed({});

  const domain::Landmark landmark = feed.add_all({8, 7, 7});

  EXPECT_EQ(landmark.spatial_class, 7);
  EXPECT_EQ(landmark.run_length, 2u);
  EXPECT_FALSE(landmark.presented);
}

TEST(KrishnaKalra, PresentsALandmarkWhenItsThirdRunReachesTheLowerBound) {
  Feed feed({});

  const domain::Landmark early = feed.add_all({3, 3, 3, 3, 1, 1, 0});
  const domain::Landmark now = feed.add(0);
  const domain::Landmark after = feed.add(0);

  EXPECT_FALSE(early.presented);
  ASSERT_TRUE(now.presented);
  EXPECT_EQ(now.classes, (std::array<std::uint8_t, 3>{3, 1, 0}));
  EXPECT_EQ(now.run_lengths, (std::array<std::uint32_t, 3>{4, 2, 2}));
  ASSERT_EQ(now.recognitions.size(), 1u);
  EXPECT_EQ(now.recognitions[0].network, domain::Network::kSom);
  EXPECT_EQ(now.recognitions[0].neuron, 5u);
  EXPECT_FALSE(after.presented);
}

TEST(KrishnaKalra, GivesToArtWhatTheMapDoesNotKnow) {
  Feed feed({});

  const domain::Landmark landmark = feed.add_all({7, 7, 7, 8, 8, 5});

  ASSERT_EQ(landmark.recognitions.size(), 1u);
  EXPECT_EQ(landmark.recognitions[0].network, domain::Network::kFuzzyArt);
  EXPECT_TRUE(landmark.recognitions[0].created);
  EXPECT_EQ(landmark.recognitions[0].prototype_classes, (std::array<double, 3>{7, 8, 5}));
}

TEST(KrishnaKalra, GivesToArtALandmarkThatIsTooShortForTheMap) {
  Feed feed({});

  const domain::Landmark landmark = feed.add_all({3, 3, 3, 1, 1, 0});

  ASSERT_EQ(landmark.recognitions.size(), 1u);
  EXPECT_EQ(landmark.recognitions[0].network, domain::Network::kFuzzyArt);
}

TEST(KrishnaKalra, PassesOverFlicker) {
  Feed feed({});

  // The middle run is one tick, and ART asks for two.
  EXPECT_FALSE(feed.add_all({7, 7, 7, 3, 7, 7, 7}).presented);
}

TEST(KrishnaKalra, PresentsToNobodyWithoutNetworks) {
  KrishnaKalraParameters parameters;
  parameters.networks = {};
  KrishnaKalra classifier(parameters, std::nullopt);
  domain::Landmark landmark;

  for (const int spatial_class : {7, 7, 7, 8, 8, 5}) {
    landmark = {};
    classifier.step({}, scan_of(spatial_class), landmark);
  }

  EXPECT_TRUE(landmark.presented);
  EXPECT_TRUE(landmark.recognitions.empty());
}

TEST(KrishnaKalra, GoesOnAsBeforeAfterSaveAndLoad) {
  Feed feed({});
  feed.add_all({7, 7, 7, 8, 8, 5, 7, 7, 7, 8, 8});
  core::StateWriter writer;
  feed.classifier.save(writer);

  Feed restored({});
  core::StateReader reader(writer.bytes());
  restored.classifier.load(reader);
  restored.tick = feed.tick;
  const domain::Landmark expected = feed.add(5);
  const domain::Landmark landmark = restored.add(5);

  EXPECT_TRUE(reader.complete());
  ASSERT_EQ(expected.recognitions.size(), 1u);
  EXPECT_FALSE(expected.recognitions[0].created);
  ASSERT_EQ(landmark.recognitions.size(), 1u);
  EXPECT_EQ(landmark.recognitions[0].neuron, expected.recognitions[0].neuron);
  EXPECT_FALSE(landmark.recognitions[0].created);
}

TEST(KrishnaKalra, RefusesASensorThatLeavesASectorOut) {
  domain::BehaviourSetup setup;
  setup.scan.sensor = "four rays";
  setup.scan.beam_count = 4;
  setup.scan.bearing_first_rad = core::radians(90.0);
  setup.scan.bearing_step_rad = core::radians(-90.0);

  const auto made = KrishnaKalra::create({}, setup);

  ASSERT_FALSE(made.ok());
  EXPECT_NE(
      made.error().message.find("classify krishna_kalra needs a beam in each of seven sectors"),
      std::string::npos);
}

TEST(KrishnaKalra, RefusesSevenBeamsThatLookElsewhere) {
  // 30 degrees apart: of the seven sectors of 15 degrees, every other one has none.
  domain::BehaviourSetup setup;
  setup.scan = {"half a ring", 7, core::radians(90.0), core::radians(-30.0), 0.0, 1.5};

  EXPECT_FALSE(KrishnaKalra::create({}, setup).ok());
}

TEST(KrishnaKalra, ReadsOtherBeamsByWhereTheyLook) {
  // From right to left, and one more on either side, which no sector reaches.
  Feed feed({});
  domain::Scan scan = scan_of(7);  // left near, centre and right far
  scan.bearing_first_rad = core::radians(-60.0);
  scan.bearing_step_rad = core::radians(15.0);
  scan.ranges_m = {kVeryNear, kFar, kFar, kFar, kFar, kNear, kNear, kNear, kVeryNear};
  domain::Landmark landmark;

  feed.classifier.step({}, scan, landmark);

  EXPECT_EQ(landmark.spatial_class, 7);
}

}  // namespace
}  // namespace clew::classify
