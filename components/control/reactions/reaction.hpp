// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/archive.hpp"
#include "domain/inside.hpp"
#include "domain/messages.hpp"

namespace clew::control {

/// Takes the place of a motion that recovery, the final approach or the controller wants, where
/// what it sees asks for another one. The step guard has the last word.
class Reaction {
 public:
  virtual ~Reaction() = default;

  /// The motion in place of `wanted`; nothing where that may pass. Called once a tick.
  virtual std::optional<domain::Motion> react(const domain::Odometry& odometry,
                                              const domain::Scan& scan,
                                              const domain::Landmark& landmark,
                                              const domain::Motion& wanted) = 0;

  virtual void save(core::StateWriter& writer) const = 0;
  virtual void load(core::StateReader& reader) = 0;

  /// Tells what led to the answer of the last step, which had these arguments.
  virtual void tell(const domain::Odometry&, const domain::Scan&, const domain::Landmark&,
                    const domain::Motion&, domain::Inside&) const {}
};

}  // namespace clew::control
