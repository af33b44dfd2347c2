// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "core/result.hpp"
#include "gateway/live_stream.hpp"

namespace clew::bridge {

/// What a stream holds of a run up to `last_tick`, as a recording that has no name: it is gone with
/// this object. It begins with the run, or as a black box at the newest checkpoint.
class HeldRecording {
 public:
  /// Refused: a tick that the run has not reached, and one before which neither all ticks are held
  /// nor the states of a checkpoint. What components remember follows from all ticks before.
  static core::Result<HeldRecording> write(const LiveStream& stream, std::uint64_t last_tick);

  HeldRecording(HeldRecording&& other) noexcept;
  HeldRecording& operator=(HeldRecording&&) = delete;
  ~HeldRecording();

  /// Under this path other processes of the user may read it.
  std::string path() const;

 private:
  explicit HeldRecording(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

}  // namespace clew::bridge
