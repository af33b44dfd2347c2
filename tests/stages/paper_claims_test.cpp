// SPDX-License-Identifier: Apache-2.0
/// What Krishna & Kalra 2000 say of their figures, in the worlds that realise them. The table in
/// components/recover/README.md gives the numbers, and says why one claim does not come out.
#include <gtest/gtest.h>

#include "mission.hpp"

namespace clew::stages {
namespace {

using domain::Outcome;

const char* const kSomOnly = "classify.networks=[som]";
const char* const kArtOnly = "classify.networks=[art]";

Report reactive(const std::string& world) { return Mission("reactive", world).run(); }

Report whole(const std::string& world, const std::vector<std::string>& set = {}) {
  return Mission("krishna_kalra", world, {}, set).run();
}

/// Figures 10, 11, 12, 14 and 16.
const std::vector<std::string> kTraps = {"kk-fig10-bends-and-kinks",
                                         "kk-fig11a-oscillation",
                                         "kk-fig11c-double-wall",
                                         "kk-fig12-hooks",
                                         "kk-fig14-som-cannot-detect",
                                         "kk-fig16a-concave-obstacle",
                                         "kk-fig16c-concave-obstacle-mirrored"};

TEST(PureFuzzyControl, PassesTheClutterOfFigureSevenAndTheWorldOfFigureFifteen) {
  EXPECT_EQ(reactive("kk-fig07-clutter").outcome, Outcome::kReached);
  EXPECT_EQ(reactive("kk-fig15-not-trapped").outcome, Outcome::kReached);
}

TEST(PureFuzzyControl, IsTrappedInFiguresTenToFourteenAndSixteen) {
  for (const std::string& world : kTraps) {
    EXPECT_EQ(reactive(world).outcome, Outcome::kTimeout) << world;
  }
  EXPECT_EQ(reactive("kk-fig13-maze-four-loops").outcome, Outcome::kTimeout);
}

TEST(WholeSystem, NoticesAndLeavesTheTraps) {
  for (const std::string& world : kTraps) {
    const Report report = whole(world);
    EXPECT_EQ(report.outcome, Outcome::kReached) << world;
    EXPECT_GE(report.traps, 1) << world;
  }
}

TEST(WholeSystem, LeavesTheTrapsByThePapersRule) {
  for (const std::string& world : kTraps) {
    EXPECT_EQ(whole(world, {"recover.escape.leave=paper"}).outcome, Outcome::kReached) << world;
  }
}

TEST(FuzzyArt, LeadsOutOfTheMazeOfFigureThirteenByItself) {
  const Report report = whole("kk-fig13-maze-four-loops", {kArtOnly});

  EXPECT_EQ(report.outcome, Outcome::kReached);
  EXPECT_GE(report.traps, 1);
  EXPECT_EQ(report.reflexes, 0);
}

TEST(FuzzyArt, NoticesInFigureFourteenWhatTheMapDoesNot) {
  const Report som = whole("kk-fig14-som-cannot-detect", {kSomOnly});
  const Report art = whole("kk-fig14-som-cannot-detect", {kArtOnly});

  EXPECT_EQ(som.traps, 0);
  EXPECT_EQ(som.outcome, Outcome::kTimeout);
  EXPECT_GE(art.traps, 1);
  EXPECT_EQ(art.outcome, Outcome::kReached);
}

TEST(ImmediateMemory, ShortensThePathOfFigureEight) {
  const std::string world = "kk-fig08-right-angle-corner";
  const Report with = whole(world);
  const Report without = whole(world, {"recover.immediate_memory=false"});

  EXPECT_EQ(with.reflexes, 1);
  EXPECT_LT(with.path_length_m, without.path_length_m);
  EXPECT_LT(with.ticks, without.ticks);
}

TEST(Recovery, DoesNotFireWhereThereIsNoTrap) {
  for (const std::string& world : static_worlds()) {
    const bool no_trap = world.rfind("kk-fig01", 0) == 0 || world.rfind("kk-fig04", 0) == 0 ||
                         world.rfind("kk-fig05", 0) == 0 || world.rfind("kk-fig07", 0) == 0 ||
                         world.rfind("kk-fig08", 0) == 0 || world.rfind("kk-fig15", 0) == 0 ||
                         world == "kk-text-similar-scenes";
    if (!no_trap) continue;
    const Report report = whole(world);
    EXPECT_EQ(report.outcome, Outcome::kReached) << world;
    EXPECT_EQ(report.traps, 0) << world;
  }
}

}  // namespace
}  // namespace clew::stages
