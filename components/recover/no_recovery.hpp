// SPDX-License-Identifier: Apache-2.0
/// The variants that do nothing, for comparison.
#pragma once

#include <memory>

#include "core/result.hpp"
#include "domain/setup.hpp"
#include "recover/escape.hpp"
#include "recover/trap_detector.hpp"

namespace clew::recover {

struct NoParameters {};

template <typename Visitor>
void visit_parameters(Visitor&, NoParameters&) {}

/// Never says trap.
class NoDetector final : public TrapDetector {
 public:
  using Parameters = NoParameters;
  static core::Result<std::unique_ptr<NoDetector>> create(const Parameters&,
                                                          const domain::BehaviourSetup&) {
    return std::make_unique<NoDetector>();
  }

  std::optional<TrapEvidence> observe(const Situation&) override { return std::nullopt; }
  void start_afresh() override {}
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}
};

/// Ends as soon as it begins: traps are noticed and logged, and the robot goes on seeking.
class NoEscape final : public Escape {
 public:
  using Parameters = NoParameters;
  static core::Result<std::unique_ptr<NoEscape>> create(const Parameters&,
                                                        const domain::BehaviourSetup&) {
    return std::make_unique<NoEscape>();
  }

  void begin(const Situation&, const TrapEvidence&) override {}
  EscapeStatus step(const Situation&, domain::Guidance&) override { return EscapeStatus::kEnded; }
  void save(core::StateWriter&) const override {}
  void load(core::StateReader&) override {}
};

}  // namespace clew::recover
