// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "component/line_program.hpp"
#include "runtime/run_plan.hpp"

namespace clew::bridge {

/// What a third-party program is told of its run in its environment, beside how to find it:
/// `CLEW_STAGE`, `CLEW_TICK_S`, `CLEW_SEED`, `CLEW_MAX_TICKS`, `CLEW_ROBOT_RADIUS_M`.
std::map<std::string, std::string> facts_for_program(const runtime::RunPlan& plan,
                                                     const runtime::GraphStage& stage);

/// A component that is a program behind a pair of pipes: for each tick one line of JSON with the
/// inputs goes in, `{"tick": 7, "time_s": 2.1, "odometry": {...}, ...}`, and one with the outputs
/// comes out, `{"command": {...}}`. An input that is not there is null.
///
/// A step cannot fail, and a program can: `fail` is told why and must not return. No state of the
/// program's is saved, so one that is loaded is a new one.
class JsonLines final : public runtime::Component {
 public:
  using Fail = std::function<void(const core::Error&)>;

  JsonLines(LineProgram program, const runtime::GraphStage& stage, const runtime::RunPlan& plan,
            Fail fail);

  void step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) override;
  void save(core::StateWriter& /*writer*/) const override {}
  void load(core::StateReader& /*reader*/) override {}

 private:
  std::string question(const runtime::TickInputs& inputs) const;
  core::Result<void> read_answer(const std::string& line, std::uint64_t tick,
                                 runtime::TickOutputs& outputs) const;

  LineProgram program_;
  const runtime::NodePorts ports_;
  const double tick_s_;
  const domain::ScanLayout scan_;
  const Fail fail_;
};

/// A stage of a plan whose program speaks JSON lines, as a node of ours.
core::Result<runtime::Node> make_json_lines_node(const runtime::RunPlan& plan,
                                                 const runtime::GraphStage& stage,
                                                 JsonLines::Fail fail);

}  // namespace clew::bridge
