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
  sensor_->measure(*world_, state.pose_world_robot, state.stamp.sim_time_s,
                   random_of(inputs.tick()), outputs.get<domain::Scan>());
}

core::Random SenseComponent::random_of(std::uint64_t tick) const {
  return core::Random({seed_, robot_index_, kRandomComponent, tick});
}

}  // namespace clew::sense
