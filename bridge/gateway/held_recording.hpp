// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "gateway/live_stream.hpp"

namespace clew::bridge {

/// What a stream holds of a run up to `last_tick`, as a recording that has no name: it is gone with
/// this object. It begins with the run, or as a black box at the newest checkpoint.
class HeldRecording {
 public:
  /// The texts of a run, once these changes are in force.
  using Changed = std::function<core::Result<std::map<std::string, std::string>>(
      const RunDescription& description, const std::vector<domain::Intervention>& changes)>;

  /// Refused: a tick that the run has not reached, and one before which neither all ticks are held
  /// nor the states of a checkpoint. What components remember follows from all ticks before. What
  /// was changed before that checkpoint is in the recording's texts.
  static core::Result<HeldRecording> write(const LiveStream& stream, std::uint64_t last_tick,
                                           const Changed& changed);

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
