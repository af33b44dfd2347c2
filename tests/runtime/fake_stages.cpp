// SPDX-License-Identifier: Apache-2.0
#include "fake_stages.hpp"

#include <gtest/gtest.h>

#include "runtime/raw_graph.hpp"

namespace clew::runtime {
namespace {

using core::ParameterInfo;

bool knows_world(const std::string& stage) { return stage == "sense" || stage == "drive"; }

/// Counts its steps; refuses to be made in a run of the seed 13, as classify with a data file of
/// the one word "wrong", and with or without a world where its stage says otherwise.
class Counter : public Component {
 public:
  void step(const TickInputs&, TickOutputs&) override { ++steps_; }
  void save(core::StateWriter& writer) const override { writer(steps_); }
  void load(core::StateReader& reader) override { reader(steps_); }

 private:
  std::uint64_t steps_ = 0;
};

core::Result<std::unique_ptr<Component>> make_counter(const StageConfig& config,
                                                      const RunSetup& setup) {
  if (setup.seed == 13) return core::Error{config.stage + " does not like 13"};
  if ((setup.world != nullptr) != knows_world(config.stage)) {
    return core::Error{config.stage + " is told too much of the world, or too little"};
  }
  for (const auto& [name, file] : setup.behaviour.resources.all()) {
    if (config.stage == "classify" && file.text == "wrong")
      return core::Error{"wrong is no map", file.file, 1, 1};
  }
  return std::unique_ptr<Component>(std::make_unique<Counter>());
}

double no_tick(const StageConfig&) { return 0.0; }

ParameterInfo number(const std::string& name, double value, core::Range range) {
  return {name, "m", "a number", value, range, {}, {}};
}
ParameterInfo integer(const std::string& name, std::int64_t value) {
  return {name, "1", "an integer", value, core::Range{1, 100}, {}, {}};
}
ParameterInfo flag(const std::string& name, bool value) {
  return {name, "", "a flag", value, {}, {}, {}};
}
ParameterInfo word(const std::string& name, const std::string& value,
                   std::vector<std::string> choices) {
  return {name, "", "a word", value, {}, std::move(choices), {}};
}
ParameterInfo words(const std::string& name, std::vector<std::string> value,
                    std::vector<std::string> choices) {
  return {name, "", "words", std::move(value), {}, std::move(choices), {}};
}
ParameterInfo file(const std::string& name, const std::string& value) {
  return {name, "", "a data file", value, {}, {}, "rulebases"};
}

StageInfo drive() {
  return {
      "drive",
      "moves",
      {delayed_input(Topic::kCommand, "what to do"), output(Topic::kState, "truth"),
       output(Topic::kOdometry, "wheels"), output(Topic::kTarget, "mission")},
      {},
      {{"behaviour", false, {{"slow", "0.3 s", {}, {}}, {"quick", "0.1 s", {}, {}}}}},
      [](const StageConfig& config) { return config.part("behaviour").name == "slow" ? 0.3 : 0.1; },
      nullptr,
      make_counter,
      nullptr,
      knows_world("drive")};
}

StageInfo sense() {
  const VariantInfo cones{"cones",
                          "seven cones",
                          {number("range_m", 1.5, {0.1, 20.0}), integer("count", 7),
                           flag("noisy", false), word("side", "left", {"left", "right"})},
                          {}};
  const VariantInfo ray{"ray", "one ray", {number("range_m", 3.0, {0.1, 20.0})}, {}};
  return {"sense",
          "looks",
          {required_input(Topic::kState, "truth"), output(Topic::kScan, "ranges")},
          {},
          {{"behaviour", false, {cones, ray}}},
          no_tick,
          [](const StageConfig& config) {
            domain::ScanLayout layout;
            layout.sensor = config.part("behaviour").name;
            return layout;
          },
          make_counter,
          nullptr,
          knows_world("sense")};
}

StageInfo classify() {
  const VariantInfo table{
      "table", "a table", {words("networks", {"som"}, {"som", "art"}), file("map", "")}, {}};
  return {"classify",
          "knows",
          {required_input(Topic::kScan, "ranges"), output(Topic::kLandmark, "place")},
          {},
          {{"behaviour", false, {table}}},
          no_tick,
          nullptr,
          make_counter,
          nullptr,
          false,
          {{"subgoals", "table"}}};
}

StageInfo recover() {
  const TopicSet landmark = TopicSet().set(index_of(Topic::kLandmark));
  const std::vector<VariantInfo> detectors = {
      {"by_place", "needs places", {number("radius_m", 0.5, {0.0, 5.0})}, landmark},
      {"by_time", "needs none", {integer("ticks", 50)}, {}}};
  const std::vector<VariantInfo> escapes = {
      {"follow", "along", {number("gap_m", 0.3, {0.0, 1.0}), integer("patience", 9)}, {}},
      {"wait", "stays", {integer("patience", 3)}, {}}};
  return {"recover",
          "leads out",
          {required_input(Topic::kOdometry, "wheels"), optional_input(Topic::kLandmark, "place"),
           output(Topic::kGuidance, "target in force"), output(Topic::kEvent, "for people")},
          {},
          {{"detector", false, detectors}, {"escape", true, escapes}, {"shadow", true, detectors}},
          no_tick,
          nullptr,
          make_counter};
}

StageInfo control() {
  const VariantInfo straight{"straight", "ahead", {number("gain_m", 1.0, {0.0, 10.0})}, {}};
  const VariantInfo curved{"curved", "round", {integer("order", 2)}, {}};
  return {"control",
          "moves toward",
          {required_input(Topic::kOdometry, "wheels"),
           optional_input(Topic::kGuidance, "target in force"),
           fallback_input(Topic::kTarget, Topic::kGuidance, "mission"),
           output(Topic::kCommand, "what to do")},
          {flag("guard", true)},
          {{"behaviour", false, {straight, curved}}},
          no_tick,
          nullptr,
          make_counter};
}

}  // namespace

const std::vector<StageInfo>& fake_stages() {
  static const std::vector<StageInfo> stages = {sense(), classify(), recover(), control(), drive()};
  return stages;
}

const char kFullGraph[] = R"(world: open-field
robot: disc-015
sense: {behaviour: cones}
classify: {behaviour: table}
recover: {detector: by_place, escape: [follow, wait], shadow: []}
control: {behaviour: straight}
drive: {behaviour: slow}
)";

const char kSmallGraph[] = R"(world: open-field
robot: disc-015
sense: {behaviour: cones}
control: {behaviour: straight}
drive: {behaviour: slow}
)";

core::Result<Graph> load_fake(const std::string& text, const GraphOverrides& overrides) {
  return load_graph({"graph.yaml", text}, "graph", overrides, fake_stages());
}

Graph load_good(const std::string& text, const GraphOverrides& overrides) {
  auto graph = load_fake(text, overrides);
  EXPECT_TRUE(graph.ok()) << graph.error().text();
  return std::move(graph).value();
}

std::string refusal(const std::string& text, const GraphOverrides& overrides) {
  const auto graph = load_fake(text, overrides);
  return graph.ok() ? "accepted" : graph.error().text();
}

std::string text_of(const core::ParameterValues& values, const std::string& name) {
  const auto found = values.find(name);
  if (found == values.end()) return "absent";
  struct Text {
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return std::to_string(v); }
    std::string operator()(double v) const { return ::testing::PrintToString(v); }
    std::string operator()(const std::string& v) const { return v; }
    std::string operator()(const std::vector<std::string>& v) const {
      return ::testing::PrintToString(v);
    }
  };
  return std::visit(Text{}, found->second);
}

}  // namespace clew::runtime
