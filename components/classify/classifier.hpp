// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/archive.hpp"
#include "domain/inside.hpp"
#include "domain/messages.hpp"

namespace clew::classify {

/// Tells the place from what the robot senses there and has just sensed.
class Classifier {
 public:
  virtual ~Classifier() = default;

  /// Fills all of `landmark` but its stamp. Called once a tick.
  virtual void step(const domain::Odometry& odometry, const domain::Scan& scan,
                    domain::Landmark& landmark) = 0;

  /// Tells what it made of the scan of the last step.
  virtual void tell(const domain::Odometry&, const domain::Scan&, domain::Inside&) const {}

  virtual void save(core::StateWriter& writer) const = 0;
  virtual void load(core::StateReader& reader) = 0;
};

}  // namespace clew::classify
