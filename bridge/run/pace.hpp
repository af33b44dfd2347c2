// SPDX-License-Identifier: Apache-2.0
/// How a run goes, whatever its layout: its pace, what it records, and when it can be gone back to.
#pragma once

#include <cstdint>

namespace clew::bridge {

enum class Pace : std::uint8_t { kLockstep, kScaled, kRealtime };

/// What a component sends for the recording.
enum class Spooling : std::uint8_t {
  kNothing,
  kSamples,          ///< that it writes
  kSamplesAndStates  ///< and its state at checkpoints
};

/// Checkpoints fall on multiples of this, in all components.
inline constexpr std::uint64_t kTicksPerCheckpoint = 64;

/// What becomes of a run whose recording fails, or lacks samples.
enum class OnRecordError : std::uint8_t {
  kStop,     ///< it is aborted
  kContinue  ///< it goes on, and ends as if it had not been recorded
};

}  // namespace clew::bridge
