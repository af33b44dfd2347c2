// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "core/parameters.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/detectors/trap_detector.hpp"

namespace clew::recover {

/// Never says trap.
class NoDetector final : public TrapDetector {
 public:
  using Parameters = core::NoParameters;
  static core::Result<std::unique_ptr<NoDetector>> create(const Parameters&,
                                                          const domain::BehaviourSetup&) {
    return std::make_unique<NoDetector>();
  }

  std::optional<TrapEvidence> observe(const Situation&) override { return std::nullopt; }
  void start_afresh() override {}
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}
};

}  // namespace clew::recover
