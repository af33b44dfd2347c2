// SPDX-License-Identifier: Apache-2.0
/// A change of any parameter of any registered behaviour is found at the tick and field where it
/// first matters. What is expected comes from stepping the changed component beside the recorded
/// messages, without anything of replay. A parameter that changes nothing in any of the runs tried
/// stands in parameters_without_effect.txt, with the reason: a dead parameter stands nowhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "../recording/scratch_directory.hpp"
#include "../replay/every_behaviour.hpp"
#include "../replay/recorded_run.hpp"
#include "replay/component_replay.hpp"
#include "replay/recorded_plan.hpp"
#include "run/sample_account.hpp"
#include "stages/all.hpp"
#include "tests/source_path.hpp"

namespace clew::replay_test {
namespace {

using namespace bridge;
using core::ParameterInfo;
using domain::Topic;

/// Where a parameter is tried: first in a graph that is made for it, in its own world; then where
/// robots get trapped, and a detector says so.
struct Trial {
  std::string graph;  ///< Tried first; empty: any that the behaviour fits into.
  std::string world;  ///< Empty: the graph's own.
  std::uint64_t ticks = 0;
};
const Trial kTrials[] = {{"", "", 150},
                         {"", "u-trap", 400},
                         {"", "comb", 400},
                         {"krishna_kalra", "u-trap", 400},
                         {"krishna_kalra", "comb", 800}};

/// Messages of one topic, by tick.
template <typename Message>
using OneTopic = std::vector<Message>;
/// All messages of a recording, by topic and tick.
using AllMessages = domain::PerTopic<OneTopic>;

template <typename Visit>
void for_each_topic(Visit visit) {
  for (Topic topic : domain::kAllTopics) domain::visit_topic(topic, visit);
}

AllMessages read_all(const RunRecording& recording) {
  AllMessages all;
  for_each_topic([&](auto constant) {
    constexpr auto kIndex = index_of(decltype(constant)::value);
    std::get<kIndex>(all) = messages_of<domain::MessageOf<decltype(constant)::value>>(recording);
  });
  return all;
}

/// Where a component first does not do what is recorded.
struct Place {
  std::uint64_t tick = 0;
  std::string topic;
  std::string field;

  friend bool operator==(const Place& a, const Place& b) {
    return std::tie(a.tick, a.topic, a.field) == std::tie(b.tick, b.topic, b.field);
  }
  friend void PrintTo(const Place& place, std::ostream* out) {
    *out << "tick " << place.tick << ", " << place.topic << '.' << place.field;
  }
};

/// The first field that is not the same, or that the first message has beyond the second; of a list
/// that grew, its length.
std::string first_field(const std::vector<Field>& recorded, const std::vector<Field>& stepped) {
  for (std::size_t i = 0; i < recorded.size() && i < stepped.size(); ++i) {
    if (recorded[i].path != stepped[i].path) return "(path)";
    if (!same_bits(recorded[i].value, stepped[i].value)) return recorded[i].path;
  }
  return recorded.size() == stepped.size() ? "" : "(length)";
}

/// Steps a stage of `plan` on recorded messages until it says something else than they.
std::optional<Place> first_place(const runtime::RunPlan& plan, const std::string& stage,
                                 const AllMessages& recorded, std::uint64_t ticks) {
  auto node = runtime::make_node(plan, *plan.graph.find(stage));
  EXPECT_TRUE(node.ok()) << node.error().text();
  if (!node.ok()) return std::nullopt;
  const runtime::NodePorts& ports = node->ports();
  for (std::uint64_t tick = 0; tick < ticks; ++tick) {
    domain::Messages messages;
    runtime::TopicSet present = ports.inputs;
    if (tick > 0) present |= ports.delayed_inputs;
    for_each_topic([&](auto constant) {
      constexpr auto kIndex = index_of(decltype(constant)::value);
      if (!present[kIndex]) return;
      std::get<kIndex>(messages) =
          std::get<kIndex>(recorded)[ports.delayed_inputs[kIndex] ? tick - 1 : tick];
    });
    node->step(tick, present, messages);
    std::optional<Place> place;
    for_each_topic([&](auto constant) {
      constexpr auto kIndex = index_of(decltype(constant)::value);
      if (!ports.outputs[kIndex] || place) return;
      const std::string field = first_field(fields_of(std::get<kIndex>(recorded)[tick]),
                                            fields_of(std::get<kIndex>(messages)));
      if (field.empty()) return;
      place = Place{tick, std::string(domain::topic_name(decltype(constant)::value)), field};
    });
    if (place) return place;
  }
  return std::nullopt;
}

std::vector<std::string> sorted_lines(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  std::sort(lines.begin(), lines.end());
  return lines;
}

std::string text_of(double value) { return std::to_string(value); }
std::string text_of(std::int64_t value) { return std::to_string(value); }

/// Other values for a parameter: some more, some less, another word.
std::vector<std::string> other_values(const ParameterInfo& parameter) {
  std::vector<std::string> values;
  if (const auto* flag = std::get_if<bool>(&parameter.default_value)) {
    values = {*flag ? "false" : "true"};
  } else if (const auto* number = std::get_if<double>(&parameter.default_value)) {
    values = {text_of(*number * 0.8), text_of(*number * 1.25), text_of(parameter.range->max)};
  } else if (const auto* whole = std::get_if<std::int64_t>(&parameter.default_value)) {
    values = {text_of(*whole - 1), text_of(*whole + 1)};
  } else {
    for (const std::string& choice : parameter.choices) {
      const bool list = std::holds_alternative<std::vector<std::string>>(parameter.default_value);
      values.push_back(list ? '[' + choice + ']' : choice);
    }
  }
  return values;
}

/// A plan of the recording with another value; none if it is the same or not allowed.
std::optional<runtime::RunPlan> changed_to(const RunRecording& recording,
                                           const Behaviour& behaviour, const std::string& parameter,
                                           const std::string& value) {
  const std::string part = behaviour.stage + '.' + behaviour.part + '.';
  for (const std::string& name : {part + behaviour.name + '.', part, behaviour.stage + '.'}) {
    auto plan = bridge::changed_plan(recording, changes({}, {name + parameter + '=' + value}),
                                     shipped_configs(), stages::all());
    if (plan.ok()) return std::move(plan).value();
  }
  return std::nullopt;
}

/// Each parameter that has no effect in any trial, with the reason.
std::map<std::string, std::string> without_effect() {
  std::ifstream stream(tests::source_path("tests/parameters/parameters_without_effect.txt"));
  std::map<std::string, std::string> reasons;
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(": ");
    if (line.empty() || line.front() == '#') continue;
    EXPECT_NE(colon, std::string::npos) << line;
    reasons[line.substr(0, colon)] = line.substr(colon + 2);
  }
  return reasons;
}

class EveryParameter : public testing::TestWithParam<std::string> {
 protected:
  /// Changes each parameter of a behaviour; returns those that matter in no trial.
  std::vector<std::string> without_effect_in(const Behaviour& behaviour,
                                             std::vector<ParameterInfo> parameters) {
    for (const Trial& trial : kTrials) {
      if (parameters.empty()) break;
      parameters = try_all(behaviour, std::move(parameters), trial);
    }
    std::vector<std::string> names;
    for (const ParameterInfo& parameter : parameters) {
      names.push_back(behaviour.stage + '.' + behaviour.part + '.' + behaviour.name + '.' +
                      parameter.name);
    }
    return names;
  }

  /// Returns the parameters that do not matter in the trial.
  static std::vector<ParameterInfo> try_all(const Behaviour& behaviour,
                                            std::vector<ParameterInfo> parameters,
                                            const Trial& trial) {
    const auto plan = plan_with(behaviour, trial.ticks, trial.world, trial.graph);
    if (!plan) return parameters;
    const recording_test::ScratchDirectory scratch;
    record_run(*plan, scratch.file("run.mcap"));
    const RunRecording recording = open_recording(scratch.file("run.mcap"));
    const AllMessages recorded = read_all(recording);
    std::vector<ParameterInfo> others;
    for (const ParameterInfo& parameter : parameters) {
      if (try_values(recording, recorded, behaviour, parameter) == 0) others.push_back(parameter);
    }
    return others;
  }

  /// Tries other values until one matters; all of them in tools/soak.
  static int try_values(const RunRecording& recording, const AllMessages& recorded,
                        const Behaviour& behaviour, const ParameterInfo& parameter) {
    const bool tries_all = std::getenv("CLEW_SOAK") != nullptr;
    int matter = 0;
    for (const std::string& value : other_values(parameter)) {
      if (matter > 0 && !tries_all) break;
      SCOPED_TRACE(behaviour.name + ' ' + parameter.name + '=' + value);
      const auto changed = changed_to(recording, behaviour, parameter.name, value);
      if (changed) matter += compare(recording, *changed, behaviour.stage, recorded);
    }
    return matter;
  }

  static int compare(const RunRecording& recording, const runtime::RunPlan& changed,
                     const std::string& stage, const AllMessages& recorded) {
    const auto expected = first_place(changed, stage, recorded, recording.end()->ticks);
    const auto report = replay_component(recording, changed, stage);
    EXPECT_TRUE(report.ok()) << report.error().text();
    if (!report.ok()) return 0;
    std::optional<Place> found;
    if (report->first) {
      found = Place{report->first->tick, std::string(domain::topic_name(report->first->topic)),
                    report->first->fields.front().path};
    }
    EXPECT_EQ(found.has_value(), expected.has_value());
    if (!found || !expected) return 0;
    // A list of another length is told as its length, which is no field of a message.
    const bool told_by_length = found->field.find(".length") != std::string::npos;
    EXPECT_EQ(found->tick, expected->tick);
    EXPECT_EQ(found->topic, expected->topic);
    if (!told_by_length) {
      EXPECT_EQ(*found, *expected);
    }
    return 1;
  }
};

TEST_P(EveryParameter, IsFoundWhereSteppingOnTheSameMessagesShowsIt) {
  std::string told, listed;
  for (const runtime::StageInfo& stage : stages::all()) {
    if (stage.name != GetParam()) continue;
    for (const runtime::PartInfo& part : stage.parts) {
      for (const runtime::VariantInfo& variant : part.variants) {
        for (const std::string& name :
             without_effect_in({stage.name, part.name, variant.name}, variant.parameters)) {
          told += name + '\n';
        }
      }
    }
  }
  for (const auto& [name, reason] : without_effect()) {
    if (name.rfind(GetParam() + '.', 0) == 0) listed += name + '\n';
  }

  EXPECT_EQ(sorted_lines(told), sorted_lines(listed)) << told;
}

std::vector<std::string> stage_names() {
  std::vector<std::string> names;
  for (const runtime::StageInfo& stage : stages::all()) names.push_back(stage.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Stages, EveryParameter, testing::ValuesIn(stage_names()),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace clew::replay_test
