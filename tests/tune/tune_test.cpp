// SPDX-License-Identifier: Apache-2.0
#include "tune/tune.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "stages/all.hpp"
#include "tests/recording/scratch_directory.hpp"
#include "tests/source_path.hpp"

namespace clew::tune {
namespace {

const runtime::ConfigPath& configs() {
  static const runtime::ConfigPath all({tests::source_path("configs")});
  return all;
}

class Tune : public testing::Test {
 protected:
  Tune() {
    write("suite.yaml",
          "format: clew-suite/1\ngraphs: [reactive]\nworlds: {open: [open-field, "
          "forest]}\ngenerated: {seed: 3, count: 4, families: [clutter]}\n"
          "max_ticks: 300\n");
    request_.graph = "reactive";
    request_.suite = folder_.file("suite.yaml");
    request_.set = {"sense.range_m=0.6..1.5"};
  }
  void write(const std::string& name, const std::string& text) const {
    recording_test::write_bytes(folder_.file(name), text);
  }
  std::string read(const std::string& name) const {
    return recording_test::read_bytes(folder_.file(name));
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
    options.directory = folder_.file(out);
    auto end = tune(space(), {configs(), stages::all()}, options);
    if (!end.ok()) ADD_FAILURE() << end.error().text();
    return std::move(end).value();
  }

  /// Of all settings that were tried: the least mean over the worlds to tune in.
  double least_cost_of_tuning(const std::string& file) const {
    const TuneSpace all = space();
    const auto& worlds = all.tuning.worlds;
    std::map<std::string, std::pair<double, int>> sums;
    std::istringstream lines(read(file));
    std::string line;
    std::getline(lines, line);  // the header
    while (std::getline(lines, line)) {
      const auto run = nlohmann::json::parse(line);
      const bool is_tuning = std::any_of(worlds.begin(), worlds.end(), [&](const TuneWorld& world) {
        return world.name == run["world"];
      });
      if (!is_tuning || run["settings"] == "") continue;
      auto& [sum, count] = sums[run["settings"]];
      sum += run["cost"].get<double>();
      ++count;
    }
    double least = kFailureCost;
    for (const auto& [settings, of] : sums) least = std::min(least, of.first / of.second);
    return least;
  }

  const recording_test::ScratchDirectory folder_;
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
  EXPECT_EQ(end.default_tuning.runs, 3u);
  EXPECT_DOUBLE_EQ(end.best_tuning.cost, least_cost_of_tuning("out/runs.jsonl"));
}

TEST_F(Tune, RefusesRunsOfAnotherGraph) {
  const std::string text = configs().find("graphs", "reactive")->text;
  request_.graph = folder_.file("mine.yaml");
  write("mine.yaml", text);
  tuned("out", 1);
  const std::size_t at = text.find("range_m: 1.5");
  ASSERT_NE(at, std::string::npos);
  write("mine.yaml", std::string(text).replace(at, 12, "range_m: 1.4"));

  TuneOptions options;
  options.directory = folder_.file("out");
  const auto end = tune(space(), {configs(), stages::all()}, options);

  ASSERT_FALSE(end.ok());
  EXPECT_EQ(end.error().message.rfind("it was made with 'graph ", 0), 0u) << end.error().message;
}

TEST_F(Tune, RefusesAFileOfSomebodyElse) {
  std::filesystem::create_directory(folder_.file("out"));
  write("out/runs.jsonl", "{\"format\": 3}\n");

  TuneOptions options;
  options.directory = folder_.file("out");
  const auto end = tune(space(), {configs(), stages::all()}, options);

  ASSERT_FALSE(end.ok());
  EXPECT_EQ(end.error().message, "is no file of results; expected format clew-tune/1");
}

TEST_F(Tune, IsTheSameWithAnyNumberOfJobsAndAfterAnInterruption) {
  const Tuned one = tuned("one", 1);
  const Tuned two = tuned("two", 2);
  // Only the first dozen of runs is left, and half a line.
  const std::string whole = read("one/runs.jsonl");
  std::size_t end = 0;
  for (int line = 0; line < 13; ++line) end = whole.find('\n', end) + 1;
  std::filesystem::create_directory(folder_.file("torn"));
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
