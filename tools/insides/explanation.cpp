// SPDX-License-Identifier: Apache-2.0
#include "insides/explanation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "replay/component_replay.hpp"

namespace clew::insides {
namespace {

using core::Error;
using core::Result;

std::string behaviour_of(const runtime::GraphStage& stage) {
  if (stage.deployment.ros2) return "ros2";
  if (!stage.deployment.exec.empty()) return stage.deployment.exec.front();
  std::string names;
  for (const auto& [part, choices] : stage.config.parts) {
    for (const auto& choice : choices) names += (names.empty() ? "" : ", ") + choice.name;
  }
  return names;
}

/// What has nothing to draw at this tick has no place in a legend either.
void drop_empty_layers(domain::Picture& picture) {
  auto& layers = picture.layers;
  const auto is_empty = [](const domain::PictureLayer& layer) {
    return layer.cells.empty() && layer.places_odom.empty();
  };
  layers.erase(std::remove_if(layers.begin(), layers.end(), is_empty), layers.end());
}

Explanation of_someone_else(const runtime::GraphStage& stage) {
  Explanation explanation{stage.info->name, behaviour_of(stage), {}};
  explanation.inside.say("It is someone else's component: its inside is its own.");
  return explanation;
}

}  // namespace

Result<std::vector<Explanation>> explain(const bridge::RunRecording& recording,
                                         const runtime::RunPlan& plan, std::uint64_t tick,
                                         const std::optional<std::string>& stage) {
  if (stage) {
    const auto found = bridge::find_stage(plan, *stage);
    if (!found.ok()) return found.error();
    if (!(*found)->deployment.is_ours()) {
      return Error{fmt::format("'{}' is someone else's component ({}): it has no inside to explain",
                               *stage, behaviour_of(**found)),
                   recording.path()};
    }
  }
  std::vector<Explanation> explanations;
  for (const runtime::GraphStage& each : plan.graph.stages) {
    if (stage && each.info->name != *stage) continue;
    if (!each.deployment.is_ours()) {
      explanations.push_back(of_someone_else(each));
      continue;
    }
    auto inside = bridge::inside_at(recording, plan, each.info->name, tick);
    if (!inside.ok()) return inside.error();
    drop_empty_layers(inside->picture);
    explanations.push_back({each.info->name, behaviour_of(each), std::move(inside).value()});
  }
  return explanations;
}

std::string wrapped(const std::string& paragraph, std::size_t columns) {
  std::string lines;
  std::size_t column = 0;
  for (std::size_t at = 0; at < paragraph.size();) {
    std::size_t end = paragraph.find(' ', at);
    if (end == std::string::npos) end = paragraph.size();
    const std::size_t length = end - at;
    if (column > 0 && column + 1 + length > columns) {
      lines += '\n';
      column = 0;
    } else if (column > 0) {
      lines += ' ';
      ++column;
    }
    lines += paragraph.substr(at, length);
    column += length;
    at = end + 1;
  }
  return lines;
}

}  // namespace clew::insides
