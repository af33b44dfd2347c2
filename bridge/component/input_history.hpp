// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "core/result.hpp"
#include "runtime/component.hpp"
#include "wire/codec.hpp"

namespace clew::bridge {

/// The inputs of a stage's last ticks, in a file without a name that outlives the stage's process:
/// what a behaviour that takes over is fed with. A process that comes back writes the same bytes
/// again.
class InputHistory {
 public:
  /// Ticks that it holds: twice what a successor is fed, so that it can be fed while the run goes
  /// on.
  static constexpr std::uint64_t kTicks = 1024;
  /// Room for the inputs of one tick; what is not used of it takes no memory.
  static constexpr std::uint64_t kBytesPerTick = std::uint64_t{1} << 17;

  static core::Result<InputHistory> create();
  /// Opens the file of another process, which holds it open.
  static core::Result<InputHistory> open(const std::string& path);
  /// Where another process of this user finds the file.
  std::string path() const;
  InputHistory(InputHistory&& other) noexcept;
  InputHistory& operator=(InputHistory&&) = delete;
  ~InputHistory();

  /// Writes the inputs of a tick over those of kTicks before.
  core::Result<void> put(std::uint64_t tick, const runtime::TopicSet& present,
                         const domain::Messages& messages);
  /// Reads the inputs of a tick; an error if they are not there any more.
  core::Result<runtime::TopicSet> get(std::uint64_t tick, domain::Messages& messages) const;

 private:
  explicit InputHistory(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
  Codecs codecs_;
  std::string bytes_;
  mutable Codecs reading_codecs_;
};

}  // namespace clew::bridge
