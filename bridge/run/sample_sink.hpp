// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.hpp"
#include "run/sample_account.hpp"

namespace clew::bridge {

/// Receives what the components of a run write, in order within each topic.
class SampleSink {
 public:
  virtual ~SampleSink() = default;
  /// Takes a sample. After an error it is given no more.
  virtual core::Result<void> add(const SampleView& sample) = 0;
  /// Whether it does anything with them.
  virtual bool wants_samples() const { return true; }

  /// Whether it wants the components' states, too: at every multiple of kTicksPerCheckpoint but 0.
  virtual bool wants_states() const { return false; }
  virtual void add_state(const SpooledState&) {}

  /// Takes what somebody changed in the run, before the samples of its tick.
  virtual void add_intervention(const domain::Intervention&) {}
  /// Takes what befell the run.
  virtual void add_incident(const domain::Incident&) {}
};

}  // namespace clew::bridge
