// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/archive.hpp"
#include "core/geometry.hpp"
#include "domain/inside.hpp"
#include "domain/messages.hpp"

namespace clew::control {

/// Chooses the robot's next motion from what it senses. A controller knows nothing of traps, and
/// need not fear contact more than its paper does: the component applies virtual obstacles to the
/// scan before, and the step guard to the motion after.
class Controller {
 public:
  virtual ~Controller() = default;

  /// The motion toward `target_odom`, the active target. Called once a tick, but not while
  /// recovery overrides the motion.
  virtual domain::Motion step(const domain::Odometry& odometry, const domain::Scan& scan,
                              const core::Vec2& target_odom) = 0;

  /// Adds the virtual targets in force that it has set by itself, in the order in which it set
  /// them.
  using VirtualTargets = core::BoundedVector<domain::VirtualTarget, domain::kMaxVirtualTargets>;
  virtual void tell_virtual_targets(VirtualTargets&) const {}

  virtual void save(core::StateWriter& writer) const = 0;
  virtual void load(core::StateReader& reader) = 0;

  /// Tells what led to the motion of the last step, which had these arguments.
  virtual void tell(const domain::Odometry&, const domain::Scan&, const core::Vec2&,
                    domain::Inside&) const {}
};

}  // namespace clew::control
