// SPDX-License-Identifier: Apache-2.0
#include "component/json_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "component/topic_input.hpp"
#include "core/nearest_name.hpp"
#include "run/limits.hpp"
#include "wire/message_json.hpp"

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;
using domain::Topic;
using nlohmann::ordered_json;

constexpr char kTick[] = "tick";

}  // namespace

std::map<std::string, std::string> facts_for_program(const runtime::RunPlan& plan,
                                                     const runtime::GraphStage& stage) {
  return {{"CLEW_STAGE", stage.info->name},
          {"CLEW_TICK_S", fmt::format("{}", plan.graph.tick_s)},
          {"CLEW_SEED", fmt::format("{}", plan.graph.seed)},
          {"CLEW_MAX_TICKS", fmt::format("{}", plan.graph.max_ticks)},
          {"CLEW_ROBOT_RADIUS_M", fmt::format("{}", plan.setup.behaviour.robot.radius_m)}};
}

JsonLines::JsonLines(LineProgram program, const runtime::GraphStage& stage,
                     const runtime::RunPlan& plan, Fail fail)
    : program_(std::move(program)),
      ports_(stage.ports),
      tick_s_(plan.graph.tick_s),
      scan_(plan.setup.behaviour.scan),
      fail_(std::move(fail)) {}

void JsonLines::step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) {
  const auto answer = program_.ask(question(inputs), kLongestAnswer);
  const auto read =
      answer.ok() ? read_answer(*answer, inputs.tick(), outputs) : Result<void>(answer.error());
  if (!read.ok()) {
    fail_({fmt::format("at tick {}: {}", inputs.tick(), read.error().text()), {}, 0, 0});
  }
}

std::string JsonLines::question(const runtime::TickInputs& inputs) const {
  ordered_json json;
  json[kTick] = inputs.tick();
  json["time_s"] = static_cast<double>(inputs.tick()) * tick_s_;
  for (const Topic topic : domain::kAllTopics) {
    if (!ports_.all_inputs()[index_of(topic)]) continue;
    domain::visit_topic(topic, [&](auto constant) {
      using Message = typename decltype(constant)::Message;
      const auto* message = inputs.find<Message>();
      json[std::string(domain::topic_name(topic))] =
          message != nullptr ? json_of(message) : ordered_json(nullptr);
    });
  }
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

// The stamps are ours: they follow from the tick.
Result<void> JsonLines::read_answer(const std::string& line, std::uint64_t tick,
                                    runtime::TickOutputs& outputs) const {
  const ordered_json json = ordered_json::parse(line, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object()) {
    return Error{fmt::format("its line '{}{}' is no object of JSON", line.substr(0, 60),
                             line.size() > 60 ? "..." : "")};
  }
  std::vector<std::string> known = {kTick};
  for (const Topic topic : ports_.output_order) known.emplace_back(domain::topic_name(topic));
  for (const auto& entry : json.items()) {
    if (std::find(known.begin(), known.end(), entry.key()) != known.end()) continue;
    return Error{core::unknown_name("key of its line", entry.key(), known)};
  }
  if (json.contains(kTick) && json[kTick] != tick) {
    return Error{fmt::format("its line is of tick {}", json[kTick].dump())};
  }
  Result<void> read;
  for (const Topic topic : ports_.output_order) {
    const std::string name(domain::topic_name(topic));
    if (!json.contains(name)) return Error{"its line lacks '" + name + "'"};
    domain::visit_topic(topic, [&](auto constant) {
      using Message = typename decltype(constant)::Message;
      Message& message = outputs.get<Message>();
      const auto stamp = message.stamp;
      read = read_json(json[name], name, &message);
      if (read.ok()) read = check_in_run(message, scan_);
      message.stamp = stamp;
    });
    if (!read.ok()) return read;
  }
  return {};
}

Result<runtime::Node> make_json_lines_node(const runtime::RunPlan& plan,
                                           const runtime::GraphStage& stage, JsonLines::Fail fail) {
  auto program = LineProgram::start(stage.deployment.exec, facts_for_program(plan, stage));
  if (!program.ok()) return program.error();
  return runtime::Node(
      stage.info->name, stage.ports,
      std::make_unique<JsonLines>(std::move(program).value(), stage, plan, std::move(fail)),
      plan.graph.tick_s);
}

}  // namespace clew::bridge
