// SPDX-License-Identifier: Apache-2.0
#include "replay/playback.hpp"

#include <algorithm>

#include "run/limits.hpp"

namespace clew::bridge {
Playback::Playback(double tick_s, double rate, bool paused)
    : tick_s_(tick_s), rate_(rate), paused_(paused) {}

void Playback::set_rate(double rate, Time now) {
  rate_ = rate <= 0.0 ? 0.0 : std::clamp(rate, kLowestRate, kHighestRate);
  due_ = now;
}

void Playback::apply(const PlaybackRequest& request, Time now) {
  using Kind = PlaybackRequest::Kind;
  switch (request.kind) {
    case Kind::kStep:
      paused_ = true;
      steps_ += request.ticks;
      break;
    case Kind::kPause:
      paused_ = true;
      steps_ = 0;
      break;
    case Kind::kResume:
    case Kind::kToggle:
      paused_ = request.kind == Kind::kToggle && !paused_;
      steps_ = 0;
      due_ = now;
      break;
    case Kind::kRate:
      set_rate(request.rate, now);
      break;
    case Kind::kFaster:
      // Beyond the highest rate is no rate at all.
      if (rate_ > 0.0) set_rate(rate_ < kHighestRate ? rate_ * 2.0 : 0.0, now);
      break;
    case Kind::kSlower:
      // From as fast as it goes, the next slower one is real time.
      set_rate(rate_ > 0.0 ? rate_ / 2.0 : 1.0, now);
      break;
    case Kind::kSeek:
    case Kind::kSkipBack:
    case Kind::kSkipOn:
    case Kind::kEnd:
      break;
  }
}

bool Playback::may_begin(Time now) const {
  if (paused_) return steps_ > 0;
  return rate_ <= 0.0 || now >= due_;
}

std::optional<Playback::Time> Playback::due() const {
  if (halted()) return std::nullopt;
  return paused_ || rate_ <= 0.0 ? Time{} : due_;
}

void Playback::begin(Time now) {
  if (paused_) {
    --steps_;
    return;
  }
  if (rate_ <= 0.0) return;
  if (now - due_ > kPlaybackSlack) due_ = now;
  due_ += std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(tick_s_ / rate_));
}

}  // namespace clew::bridge
