// SPDX-License-Identifier: Apache-2.0
#include "sense/stage.hpp"

#include <utility>

#include "sense/registry.hpp"
#include "sense/sense_component.hpp"

namespace clew::sense {
namespace {

domain::ScanLayout scan_layout(const runtime::StageConfig& config) {
  // The layout depends on the sensor alone, not on the robot that carries it.
  return sensors().make(config.part("behaviour"), {}).value()->layout();
}

core::Result<std::unique_ptr<runtime::Component>> make(const runtime::StageConfig& config,
                                                       const runtime::RunSetup& setup) {
  auto sensor = sensors().make(config.part("behaviour"), setup.behaviour);
  if (!sensor.ok()) return sensor.error();
  return std::unique_ptr<runtime::Component>(
      std::make_unique<SenseComponent>(std::move(sensor).value(), setup));
}

}  // namespace

const runtime::StageInfo& stage() {
  static const runtime::StageInfo info = {"sense",
                                          "measures ranges from the place where the robot stands",
                                          SenseComponent::ports(),
                                          {},
                                          {{"behaviour", false, sensors().variants()}},
                                          [](const runtime::StageConfig&) { return 0.0; },
                                          scan_layout,
                                          make,
                                          nullptr,
                                          /*knows_world=*/true};
  return info;
}

}  // namespace clew::sense
