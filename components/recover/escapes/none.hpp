// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "core/parameters.hpp"
#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/escapes/escape.hpp"

namespace clew::recover {

/// Ends as soon as it begins: traps are noticed and logged, and the robot goes on seeking.
class NoEscape final : public Escape {
 public:
  using Parameters = core::NoParameters;
  static core::Result<std::unique_ptr<NoEscape>> create(const Parameters&,
                                                        const domain::BehaviourSetup&) {
    return std::make_unique<NoEscape>();
  }

  void begin(const Situation&, const TrapEvidence&) override {}
  EscapeStatus step(const Situation&, domain::Guidance&) override { return EscapeStatus::kEnded; }
  void tell(const Situation& situation, domain::Inside& inside) const override;
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}
};

}  // namespace clew::recover
