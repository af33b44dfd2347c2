// SPDX-License-Identifier: Apache-2.0
#include "sense/sense_component.hpp"

#include <utility>

namespace clew::sense {

std::vector<runtime::PortInfo> SenseComponent::ports() {
  return {runtime::required_input(domain::Topic::kState, "where the robot truly is"),
          runtime::output(domain::Topic::kScan, "what the range sensors read there")};
}

SenseComponent::SenseComponent(std::unique_ptr<RangeSensor> sensor, const runtime::RunSetup& setup)
    : sensor_(std::move(sensor)),
      world_(setup.world),
      seed_(setup.seed),
      robot_index_(setup.robot_index) {}

void SenseComponent::step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) {
  const auto& state = inputs.get<domain::State>();
  const core::Random random({seed_, robot_index_, kRandomComponent, inputs.tick()});
  sensor_->measure(*world_, state.pose_world_robot, state.stamp.sim_time_s, random,
                   outputs.get<domain::Scan>());
}

}  // namespace clew::sense
