// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/component.hpp"
#include "runtime/stage.hpp"
#include "sense/range_sensor.hpp"

namespace clew::sense {

/// Which random numbers are this component's, of those that a seed gives.
inline constexpr std::uint32_t kRandomComponent = 1;

/// Measures where the robot truly is: one scan for every state.
class SenseComponent final : public runtime::Component {
 public:
  static std::vector<runtime::PortInfo> ports();

  SenseComponent(std::unique_ptr<RangeSensor> sensor, const runtime::RunSetup& setup);

  void step(const runtime::TickInputs& inputs, runtime::TickOutputs& outputs) override;
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}
  void tell(const runtime::TickInputs& samples, domain::Inside& inside) const override;

 private:
  core::Random random_of(std::uint64_t tick) const;

  std::unique_ptr<RangeSensor> sensor_;
  std::shared_ptr<const world::World> world_;
  std::uint64_t seed_;
  std::uint32_t robot_index_;
};

}  // namespace clew::sense
