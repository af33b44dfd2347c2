// SPDX-License-Identifier: Apache-2.0
#include "recover/detectors/landmark_revisit.hpp"

#include <gtest/gtest.h>

#include "tests/recover/scene.hpp"

namespace clew::recover {
namespace {

using domain::Network;

/// Neuron 7 wins at a place.
Scene win(double x_m, double y_m, double travel_m, std::uint64_t tick = 0) {
  return Scene()
      .at(x_m, y_m, 0)
      .travelled(travel_m)
      .tick(tick)
      .recognises(Network::kSom, 7, {7, 1, 0});
}

LandmarkRevisit detector() { return LandmarkRevisit({}); }

TEST(LandmarkRevisit, ReportsALoopOnTheSecondVisit) {
  LandmarkRevisit revisit = detector();

  const auto first = revisit.observe(win(2, 3, 5.0, 40).situation());
  const auto second = revisit.observe(win(2.1, 3.2, 17.0, 150).situation());

  EXPECT_FALSE(first.has_value());
  ASSERT_TRUE(second.has_value());
  ASSERT_TRUE(second->earlier);
  EXPECT_EQ(second->earlier->tick, 40u);
  EXPECT_EQ(second->earlier->position_odom, core::Vec2(2, 3));
  EXPECT_EQ(second->earlier->travel_m, 12.0);
  EXPECT_EQ(second->earlier->cell, 7u);
  EXPECT_EQ(second->text, "SOM [7 1 0] seen here before");
}

TEST(LandmarkRevisit, TellsALandmarkFromAnotherOfItsKind) {
  LandmarkRevisit revisit = detector();
  revisit.observe(win(2, 3, 5.0).situation());

  // 0.31 m from the first.
  EXPECT_FALSE(revisit.observe(win(2.31, 3, 17.0).situation()).has_value());
}

TEST(LandmarkRevisit, WidensItsRadiusWithWhatOdometrysCovarianceHasGrownBy) {
  LandmarkRevisitParameters parameters;
  parameters.drift_sigmas = 2.0;
  LandmarkRevisit revisit(parameters);
  LandmarkRevisit blind = detector();
  // x and y have grown by 0.005 m^2 each: two standard deviations are 0.2 m beside the 0.3 m.
  Scene first = win(2, 3, 5.0);
  first.uncertain(0.02, 0.0);
  Scene near = win(2.49, 3, 17.0);
  near.uncertain(0.025, 0.0);
  Scene far = win(2.51, 3, 17.0);
  far.uncertain(0.025, 0.0);
  revisit.observe(first.situation());
  blind.observe(first.situation());

  EXPECT_FALSE(revisit.observe(far.situation()).has_value());
  EXPECT_FALSE(blind.observe(near.situation()).has_value());
  LandmarkRevisit again(parameters);
  again.observe(first.situation());
  EXPECT_TRUE(again.observe(near.situation()).has_value());
}

TEST(LandmarkRevisit, TakesNoLoopThatIsTooShort) {
  LandmarkRevisit revisit = detector();
  revisit.observe(win(2, 3, 5.0).situation());

  EXPECT_FALSE(revisit.observe(win(2, 3, 5.9).situation()).has_value());
  EXPECT_TRUE(revisit.observe(win(2, 3, 6.0).situation()).has_value());
}

TEST(LandmarkRevisit, KeepsNeuronsAndCategoriesApart) {
  LandmarkRevisit revisit = detector();
  revisit.observe(win(2, 3, 5.0).situation());
  Scene category = win(2, 3, 17.0);
  category.recognises(Network::kFuzzyArt, 7, {7, 1, 0});

  EXPECT_FALSE(revisit.observe(category.situation()).has_value());
}

TEST(LandmarkRevisit, KnowsNoPastOfACategoryMadeAnew) {
  LandmarkRevisit revisit = detector();
  Scene scene = win(2, 3, 5.0);
  scene.recognises(Network::kFuzzyArt, 2, {7, 8, 1});
  revisit.observe(scene.situation());
  scene.travelled(17.0).recognises(Network::kFuzzyArt, 2, {3, 4, 8}, true);

  EXPECT_FALSE(revisit.observe(scene.situation()).has_value());
}

TEST(LandmarkRevisit, RemembersTheLastSixPositions) {
  LandmarkRevisit revisit = detector();
  revisit.observe(win(0, 0, 0.0).situation());
  for (int i = 1; i <= 5; ++i) revisit.observe(win(10.0 * i, 0, 10.0 * i).situation());
  LandmarkRevisit one_more = revisit;
  one_more.observe(win(60, 0, 60.0).situation());

  EXPECT_TRUE(revisit.observe(win(0, 0, 70.0).situation()).has_value());
  EXPECT_FALSE(one_more.observe(win(0, 0, 70.0).situation()).has_value());
}

TEST(LandmarkRevisit, MayAskForSeveralVisits) {
  LandmarkRevisitParameters parameters;
  parameters.earlier_visits = 2;
  LandmarkRevisit revisit(parameters);

  EXPECT_FALSE(revisit.observe(win(2, 3, 0.0).situation()).has_value());
  EXPECT_FALSE(revisit.observe(win(2, 3, 10.0).situation()).has_value());
  EXPECT_TRUE(revisit.observe(win(2, 3, 20.0).situation()).has_value());
}

TEST(LandmarkRevisit, MayAskForTheSameHeading) {
  LandmarkRevisitParameters parameters;
  parameters.heading_tolerance_rad = core::radians(30.0);
  LandmarkRevisit revisit(parameters);
  revisit.observe(win(2, 3, 0.0).at(2, 3, 170).situation());
  LandmarkRevisit other = revisit;

  // 170 and -165 degrees are 25 apart.
  EXPECT_TRUE(revisit.observe(win(2, 3, 10.0).at(2, 3, -165).situation()).has_value());
  EXPECT_FALSE(other.observe(win(2, 3, 10.0).at(2, 3, 90).situation()).has_value());
}

TEST(LandmarkRevisit, StartsAfreshWhenAnEscapeHasEnded) {
  LandmarkRevisit revisit = detector();
  revisit.observe(win(2, 3, 5.0).situation());
  revisit.start_afresh();

  EXPECT_FALSE(revisit.observe(win(2, 3, 17.0).situation()).has_value());
}

TEST(LandmarkRevisit, IsBoundedInMemory) {
  LandmarkRevisitParameters parameters;
  parameters.capacity = 1;
  LandmarkRevisit revisit(parameters);
  revisit.observe(win(2, 3, 5.0).situation());
  Scene other = win(2, 3, 5.0);
  other.recognises(Network::kSom, 8, {4, 1, 0});
  revisit.observe(other.situation());
  other.travelled(17.0);

  EXPECT_FALSE(revisit.observe(other.situation()).has_value());
  EXPECT_TRUE(revisit.observe(win(2, 3, 17.0).situation()).has_value());
}

TEST(LandmarkRevisit, SeesNothingWhenNobodyClassifies) {
  LandmarkRevisit revisit = detector();
  const Scene scene = win(2, 3, 5.0);
  const Situation blind{0, scene.odometry(), scene.scan(), nullptr, scene.target(), scene.target()};

  EXPECT_FALSE(revisit.observe(blind).has_value());
}

/// It stands at a place and sees no landmark, in ticks of 0.5 s.
Situation blind(const Scene& scene, std::uint64_t tick) {
  return {tick, scene.odometry(), scene.scan(), nullptr, scene.target(), scene.target()};
}

TEST(LandmarkRevisit, ARobotThatStandsStillIsTrappedIfAskedFor) {
  LandmarkRevisitParameters parameters;
  parameters.still_s = 15.0;
  LandmarkRevisit revisit(parameters, 0.5);
  LandmarkRevisit papers({}, 0.5);
  const Scene came = Scene().at(2, 3, 0).travelled(5.0);
  const Scene near = Scene().at(2.2, 3.1, 90).travelled(5.5);
  EXPECT_FALSE(revisit.observe(blind(came, 10)).has_value());
  EXPECT_FALSE(revisit.observe(blind(near, 39)).has_value());

  const auto evidence = revisit.observe(blind(near, 40));  // 30 ticks of 0.5 s later

  ASSERT_TRUE(evidence.has_value());
  EXPECT_TRUE(evidence->stands_still);
  EXPECT_EQ(evidence->text, "stands still");
  ASSERT_TRUE(evidence->earlier);
  EXPECT_EQ(evidence->earlier->tick, 10u);
  EXPECT_EQ(evidence->earlier->position_odom, core::Vec2(2, 3));
  EXPECT_EQ(evidence->earlier->travel_m, 0.5);
  // It counts from there again.
  EXPECT_FALSE(revisit.observe(blind(near, 69)).has_value());
  EXPECT_TRUE(revisit.observe(blind(near, 70)).has_value());
  papers.observe(blind(came, 10));
  EXPECT_FALSE(papers.observe(blind(near, 1000)).has_value());
}

TEST(LandmarkRevisit, ARobotThatGetsOnDoesNotStandStill) {
  LandmarkRevisitParameters parameters;
  parameters.still_s = 15.0;
  LandmarkRevisit revisit(parameters, 0.5);
  for (std::uint64_t tick = 0; tick < 200; ++tick) {
    // 0.31 m in each 14.5 s.
    const double x_m = 0.31 * static_cast<double>(tick / 29);
    EXPECT_FALSE(revisit.observe(blind(Scene().at(x_m, 0, 0).travelled(x_m), tick)).has_value());
  }
}

TEST(LandmarkRevisit, WhereItStandsTakesNoPlaceOfALandmark) {
  LandmarkRevisitParameters parameters;
  parameters.capacity = 1;
  parameters.still_s = 1000.0;
  LandmarkRevisit revisit(parameters);
  revisit.observe(win(2, 3, 5.0).situation());

  EXPECT_TRUE(revisit.observe(win(2, 3, 17.0).situation()).has_value());
}

TEST(LandmarkRevisit, GoesOnAsBeforeAfterSaveAndLoad) {
  LandmarkRevisit revisit = detector();
  revisit.observe(win(2, 3, 5.0, 40).situation());
  core::StateWriter writer;
  revisit.save(writer);

  LandmarkRevisit restored = detector();
  core::StateReader reader(writer.bytes());
  restored.load(reader);
  const auto evidence = restored.observe(win(2, 3, 17.0).situation());

  EXPECT_TRUE(reader.complete());
  ASSERT_TRUE(evidence.has_value());
  ASSERT_TRUE(evidence->earlier);
  EXPECT_EQ(evidence->earlier->tick, 40u);
}

TEST(LandmarkRevisit, StandsStillAsBeforeAfterSaveAndLoad) {
  LandmarkRevisitParameters parameters;
  parameters.still_s = 15.0;
  LandmarkRevisit revisit(parameters, 0.5);
  const Scene came = Scene().at(2, 3, 0).travelled(5.0);
  revisit.observe(blind(came, 10));
  core::StateWriter writer;
  revisit.save(writer);

  LandmarkRevisit restored(parameters, 0.5);
  core::StateReader reader(writer.bytes());
  restored.load(reader);

  EXPECT_TRUE(reader.complete());
  EXPECT_FALSE(restored.observe(blind(came, 39)).has_value());
  const auto evidence = restored.observe(blind(came, 40));
  ASSERT_TRUE(evidence.has_value());
  EXPECT_TRUE(evidence->stands_still);
  ASSERT_TRUE(evidence->earlier);
  EXPECT_EQ(evidence->earlier->tick, 10u);
  ASSERT_TRUE(revisit.observe(blind(came, 40)).has_value());
  core::StateWriter one;
  core::StateWriter other;
  revisit.save(one);
  restored.save(other);
  EXPECT_EQ(one.bytes(), other.bytes());
}

}  // namespace
}  // namespace clew::recover
