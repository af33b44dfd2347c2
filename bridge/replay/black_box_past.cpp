// SPDX-License-Identifier: Apache-2.0
#include "replay/black_box_past.hpp"

#include <fmt/format.h>

namespace clew::bridge {
namespace {

using core::Result;

using Behaviours = std::map<std::string, std::vector<std::string>>;

Behaviours behaviours_of(const runtime::GraphStage* stage) {
  Behaviours names;
  if (stage == nullptr) return names;
  for (const auto& [part, choices] : stage->config.parts) {
    for (const runtime::PartChoice& choice : choices) names[part].push_back(choice.name);
  }
  return names;
}

}  // namespace

std::uint64_t first_fed_tick(const RunRecording& recording) {
  const auto& box = recording.description().black_box;
  return box ? box->tick : 0;
}

Result<std::optional<BlackBoxStart>> black_box_for(const RunRecording& recording,
                                                   const runtime::RunPlan& plan) {
  std::optional<BlackBoxStart> box = recording.description().black_box;
  if (!box) return box;
  const auto file = runtime::BundleSource(recording.description().bundle).find("graphs", "graph");
  if (!file.ok()) return core::Error{file.error().text(), recording.path()};
  const auto graph = runtime::load_graph(*file, "graph", {}, *plan.known_stages);
  if (!graph.ok()) return core::Error{graph.error().text(), recording.path()};
  for (auto state = box->states.begin(); state != box->states.end();) {
    const std::string& stage = state->first;
    const bool same = behaviours_of(graph->find(stage)) == behaviours_of(plan.graph.find(stage));
    state = same ? std::next(state) : box->states.erase(state);
  }
  return box;
}

Result<void> begin_in_black_box(const RunRecording& recording, const runtime::RunPlan& plan,
                                FedNode& fed) {
  const auto box = black_box_for(recording, plan);
  if (!box.ok()) return box.error();
  if (!*box || (*box)->tick == 0) return {};
  std::optional<std::string> state;
  const auto found = (*box)->states.find(fed.node().name());
  if (found != (*box)->states.end()) state = found->second;
  const auto begun = fed.begin_at((*box)->tick, state);
  if (begun.ok()) return {};
  return core::Error{begun.error().text(), recording.path()};
}

Result<void> refuse_black_box(const RunRecording& recording, const std::string& what) {
  const std::uint64_t first = first_fed_tick(recording);
  if (first == 0) return {};
  return core::Error{
      fmt::format("is a black box, which begins at tick {} of its run: {}", first, what),
      recording.path()};
}

}  // namespace clew::bridge
