// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "gateway/held_recording.hpp"

namespace clew::bridge {

/// Keeps the texts of one run between questions: to make them, the run is planned once more for
/// each change, which takes a while.
class KeptTexts {
 public:
  using Texts = core::Result<std::map<std::string, std::string>>;

  /// `make` may be empty if nobody asks.
  explicit KeptTexts(HeldRecording::Changed make) : make_(std::move(make)) {}

  /// What `make` says, or said when these changes were asked for before.
  Texts operator()(const RunDescription& description,
                   const std::vector<domain::Intervention>& changes);

 private:
  /// Who asks goes to and fro over a few changes.
  static constexpr std::size_t kMostKept = 4;

  HeldRecording::Changed make_;
  /// By the ticks of the changes: a run has one change at a tick.
  std::map<std::vector<std::uint64_t>, Texts> kept_;
};

}  // namespace clew::bridge
