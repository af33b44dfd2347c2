// SPDX-License-Identifier: Apache-2.0
#include "tune/tune.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::tune {
namespace {

namespace fs = std::filesystem;

const runtime::ConfigPath& configs() {
  static const runtime::ConfigPath all({tests::source_path("configs")});
  return all;
}

class Tune : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write("suite.yaml",
          "format: clew-suite/1\ngraphs: [reactive]\nworlds: {open: [open-field, "
          "forest]}\ngenerated: {seed: 3, count: 4, families: [clutter]}\n"
          "max_ticks: 300\n");
    request_.graph = "reactive";
    request_.suite = (folder_ / "suite.yaml").string();
    request_.set = {"sense.range_m=0.6..1.5"};
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    return text.str();
  }

  TuneSpace space() const {
    auto made = make_space(request_, configs(), stages::all());
    if (!made.ok()) ADD_FAILURE() << made.error().text();
    return std::move(made).value();
  }
  std::string refusal() const {
    const auto made = make_space(request_, configs(), stages::all());
    return made.ok() ? "accepted" : made.error().text();
  }
  Tuned tuned(const std::string& out, std::size_t jobs) const {
    TuneOptions options;
    options.evaluations = 8;
    options.jobs = jobs;
    options.directory = (folder_ / out).string();
    auto end = tune(space(), {configs(), stages::all()}, options);
    if (!end.ok()) ADD_FAILURE() << end.error().text();
    return std::move(end).value();
  }

  const fs::path folder_ = fs::path(testing::TempDir()) / "clew-tune-test";
  TuneRequest request_;
};

TEST_F(Tune, KeepsHalfOfTheWorldsForValidation) {
  const TuneSpace all = space();

  EXPECT_EQ(all.tuning.worlds.size(), 3u);
  EXPECT_EQ(all.validation.worlds.size(), 3u);
  std::set<std::string> names;
  for (const auto* worlds : {&all.tuning, &all.validation}) {
    for (const TuneWorld& world : worlds->worlds) names.insert(world.name);
  }
  EXPECT_EQ(names.size(), 6u);
}

TEST_F(Tune, FindsSettingsNoWorseThanAnyThatItTried) {
  const Tuned end = tuned("out", 2);

  EXPECT_GE(end.evaluations, 8u);
  ASSERT_EQ(end.settings.size(), 1u);
  EXPECT_EQ(end.settings[0].rfind("sense.range_m=", 0), 0u);
  EXPECT_EQ(end.best_tuning.runs, 3u);
  EXPECT_EQ(end.best_validation.runs, 3u);
  EXPECT_EQ(end.default_validation.runs, 3u);
  EXPECT_LE(end.best_tuning.cost, kFailureCost);
  EXPECT_GE(end.best_tuning.cost, 1.0 - 0.05);  // the target's radius is no part of the way
}

TEST_F(Tune, IsTheSameWithAnyNumberOfJobsAndAfterAnInterruption) {
  const Tuned one = tuned("one", 1);
  const Tuned two = tuned("two", 2);
  // Only the first dozen of runs is left, and half a line.
  const std::string whole = read("one/runs.jsonl");
  std::size_t end = 0;
  for (int line = 0; line < 13; ++line) end = whole.find('\n', end) + 1;
  fs::create_directories(folder_ / "torn");
  write("torn/runs.jsonl", whole.substr(0, end + 20));

  const Tuned again = tuned("torn", 2);

  for (const Tuned* other : {&two, &again}) {
    EXPECT_EQ(other->settings, one.settings);
    EXPECT_EQ(other->best_tuning.cost, one.best_tuning.cost);
    EXPECT_EQ(other->best_validation.cost, one.best_validation.cost);
  }
  EXPECT_EQ(read("torn/runs.jsonl").size(), whole.size());
}

TEST_F(Tune, RefusesWhatCannotBeTuned) {
  request_.set = {"sense.range_m=1.0"};
  EXPECT_EQ(refusal(), "--set: names no range; expected at least one STAGE...PARAM=LOW..HIGH");
  request_.set = {"sense.rang_m=0.5..1"};
  EXPECT_NE(refusal().find("range_m"), std::string::npos);
  request_.set = {"sense.range_m=0.5..1"};
  request_.validate = request_.suite;
  EXPECT_NE(refusal().find("'open-field' is tuned in as well"), std::string::npos);
  request_.validate.reset();
  write("suite.yaml", "format: clew-suite/1\ngraphs: [reactive]\nworlds: {open: [open-field]}\n");
  EXPECT_NE(refusal().find("none is left to validate on"), std::string::npos);
}

TEST(CostOf, IsThePathRatioOfASuccess) {
  EXPECT_EQ(cost_of(true, 1.5), 1.5);
  EXPECT_EQ(cost_of(true, 30.0), kFailureCost);
  EXPECT_EQ(cost_of(true, std::nullopt), 1.0);
  EXPECT_EQ(cost_of(false, 1.2), kFailureCost);
}

}  // namespace
}  // namespace clew::tune
