// SPDX-License-Identifier: Apache-2.0
#include "hunt/hunt.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "hunt/case_file.hpp"
#include "hunt/hunt_space.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::hunt {
namespace {

const runtime::ConfigPath& configs() {
  static const runtime::ConfigPath all({tests::source_path("configs")});
  return all;
}

const Workshop& workshop() {
  static const Workshop all{configs(), stages::all()};
  return all;
}

HuntRequest request() {
  HuntRequest request;
  request.graph = "reactive";
  request.worlds = {"u-trap", "open-field"};
  request.families = {"u", "clutter"};
  request.set = {"sense.range_m=1.0..2.0"};
  request.max_ticks = 400;
  return request;
}

Property property(const std::string& text) { return std::move(Property::parse(text, "p")).value(); }

HuntEnd hunted(const HuntSpace& space, const Property& sought, std::size_t jobs,
               std::uint64_t seed = 1, std::size_t runs = 32) {
  HuntOptions options;
  options.runs = runs;
  options.seed = seed;
  options.jobs = jobs;
  auto end = hunt(space, sought, workshop(), options);
  if (!end.ok()) ADD_FAILURE() << end.error().text();
  return std::move(end).value();
}

std::vector<std::string> lines_of(const HuntEnd& end) {
  std::vector<std::string> lines;
  for (const HuntRun& run : end.runs) lines.push_back(run.line);
  return lines;
}

TEST(Hunt, FindsTheTrapsOfAGraphWithoutRecovery) {
  const auto space = make_space(request(), configs(), stages::all());
  ASSERT_TRUE(space.ok()) << space.error().text();

  const HuntEnd end = hunted(*space, property("outcome == reached"), 2);

  EXPECT_EQ(end.runs.size(), 32u);
  EXPECT_GT(end.failures(), 0u);
  EXPECT_GT(end.held(), 0u);
  EXPECT_EQ(end.undecided() + end.refusals(), 0u);
}

TEST(Hunt, DoesNotDependOnTheNumberOfJobs) {
  const auto space = make_space(request(), configs(), stages::all());
  ASSERT_TRUE(space.ok());
  const Property sought = property("outcome == reached and path_ratio < 3");

  const auto one = lines_of(hunted(*space, sought, 1));

  EXPECT_EQ(lines_of(hunted(*space, sought, 3)), one);
  EXPECT_NE(lines_of(hunted(*space, sought, 3, 2)), one);
}

TEST(Hunt, GoesOnFromNearMisses) {
  const auto space = make_space(request(), configs(), stages::all());
  ASSERT_TRUE(space.ok());

  const HuntEnd end = hunted(*space, property("path_ratio < 30"), 2);

  std::size_t guided = 0;
  for (const HuntRun& run : end.runs) {
    if (!run.parent) continue;
    ++guided;
    EXPECT_LT(*run.parent / 16, run.index / 16) << "a parent is of an earlier generation";
    EXPECT_EQ(end.runs[*run.parent].verdict.holds, true);
  }
  EXPECT_GE(guided, 8u);
}

TEST(Hunt, WritesCasesThatFailAgain) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "clew-hunt-test";
  std::filesystem::remove_all(folder);
  const auto space = make_space(request(), configs(), stages::all());
  ASSERT_TRUE(space.ok());
  const Property sought = property("outcome == reached");
  const HuntEnd end = hunted(*space, sought, 2);

  const auto cases = write_hunt(end, *space, sought, workshop(), folder.string());

  ASSERT_TRUE(cases.ok()) << cases.error().text();
  ASSERT_EQ(cases->size(), end.failures());
  for (const std::string& path : *cases) {
    const auto file = parse_case(configs().find("cases", path)->text, path);
    ASSERT_TRUE(file.ok()) << file.error().text();
    const auto which = run_of(*file, path);
    ASSERT_TRUE(which.ok()) << which.error().text();
    const auto outcome = run_case(*which, sought, workshop());
    ASSERT_TRUE(outcome.ok()) << outcome.error().text();
    EXPECT_EQ(sought.judge((*outcome)->values).holds, false);
    EXPECT_EQ((*outcome)->hash, file->hash);
  }
  std::filesystem::remove_all(folder);
}

TEST(Candidate, KeepsAWorldAsSolvableAsItIs) {
  const auto space = make_space(request(), configs(), stages::all());
  ASSERT_TRUE(space.ok());

  for (std::uint64_t index = 0; index < 24; ++index) {
    const auto which = realise(draw_candidate(*space, 5, index), *space, configs());
    ASSERT_TRUE(which.ok()) << which.error().text();
    const auto world = world::World::parse(which->world_text, which->world_file);
    ASSERT_TRUE(world.ok()) << world.error().text();
    EXPECT_EQ(world->solvable(), true) << which->world_file;
    EXPECT_TRUE(world->shortest_path_m().has_value());
  }
}

TEST(HuntSpace, HasAllSolvableWorldsUnlessItIsToldWhich) {
  HuntRequest all;
  all.graph = "reactive";

  const auto space = make_space(all, configs(), stages::all());

  ASSERT_TRUE(space.ok()) << space.error().text();
  EXPECT_GT(space->worlds.size(), 40u);
  EXPECT_EQ(space->families.size(), 15u);  // 16 of traps, less the one without a way
  EXPECT_EQ(space->robot_radius_m, 0.15);
}

TEST(HuntSpace, RefusesWhatIsNotThere) {
  HuntRequest bad = request();
  bad.families = {"uu"};
  EXPECT_EQ(make_space(bad, configs(), stages::all()).error().file, "--family");
  bad = request();
  bad.worlds = {"no-such-*"};
  EXPECT_EQ(make_space(bad, configs(), stages::all()).error().file, "--world");
  bad = request();
  bad.set = {"sense.range_m=1..2000"};
  EXPECT_NE(make_space(bad, configs(), stages::all()).error().text().find("range_m"),
            std::string::npos);
}

}  // namespace
}  // namespace clew::hunt
