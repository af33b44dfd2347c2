// SPDX-License-Identifier: Apache-2.0
#include "fleet/robot_run.hpp"

#include "recording/run_hash.hpp"

namespace clew::fleet {

core::Result<std::unique_ptr<RobotRun>> RobotRun::create(const runtime::RunPlan& plan,
                                                         bridge::SampleSink* recording) {
  auto nodes = runtime::make_nodes(plan);
  if (!nodes.ok()) return nodes.error();
  return std::unique_ptr<RobotRun>(new RobotRun(std::move(nodes).value(), recording));
}

void RobotRun::step() {
  if (!has_ended()) executor_.step();
}

bool RobotRun::has_ended() const {
  const auto& truth = statistics().truth;
  return !failure_.empty() || (truth && truth->outcome != domain::Outcome::kRunning);
}

core::Hash128 RobotRun::hash() const { return bridge::run_hash(account_.chains()); }

void RobotRun::on_output(runtime::Topic topic, const domain::Messages& messages) {
  domain::visit_topic(topic, [&](auto constant) {
    const auto& message = std::get<constant.kIndex>(messages);
    const std::string_view cdr = std::get<constant.kIndex>(codecs_).encode(message);
    account_.add(message, cdr);
    if (recording_ == nullptr || !failure_.empty()) return;
    const auto added = recording_->add({topic, message.stamp.tick, message.stamp.sequence, cdr});
    if (!added.ok()) failure_ = "the recording failed: " + added.error().text();
  });
}

}  // namespace clew::fleet
