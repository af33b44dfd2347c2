// SPDX-License-Identifier: Apache-2.0
#include "gateway/held_recording.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "files/scratch_folder.hpp"
#include "recording/run_recorder.hpp"
#include "run/sample_account.hpp"

namespace clew::bridge {
namespace {

using core::Error;
using core::Result;

Result<LiveStream::Start> find_start(const LiveStream& stream, std::uint64_t last_tick) {
  const auto newest = stream.newest();
  if (!newest) return Error{"the run has not begun"};
  if (newest->number < last_tick) {
    return Error{"the run is at tick " + std::to_string(newest->number)};
  }
  if (auto start = stream.start_before(last_tick)) return *std::move(start);
  return Error{"what came before tick " + std::to_string(last_tick) +
               " is not held here, and what components remember follows from it; ask for a later "
               "tick, or clew explain once the run is recorded"};
}

/// The description of the run from `start` on: what was changed before is in its texts.
Result<RunDescription> described_from(const LiveStream& stream, std::uint64_t start,
                                      const HeldRecording::Changed& changed) {
  RunDescription description = *stream.description();
  description.compression = mcap::Compression::kNone;  // it is read once
  const auto is_past = [&](const domain::Intervention& each) { return each.tick < start; };
  std::vector<domain::Intervention> past;
  for (const domain::Intervention& each : stream.interventions()) {
    if (is_past(each) && !each.changes.empty()) past.push_back(each);
  }
  auto& planned = description.planned;
  planned.erase(std::remove_if(planned.begin(), planned.end(), is_past), planned.end());
  if (past.empty()) return description;
  auto texts = changed(description, past);
  if (!texts.ok()) return texts.error();
  description.bundle = std::move(texts).value();
  return description;
}

Result<void> record(const LiveStream& stream, LiveStream::Start start, std::uint64_t last_tick,
                    RunDescription description, const std::string& path) {
  const std::uint64_t first = start.tick - std::min<std::uint64_t>(start.tick, 1);
  if (start.tick > 0) {
    description.black_box = {start.tick, "somebody looked on", std::move(start.states)};
  }
  auto recorder = RunRecorder::create(path, description, false);
  if (!recorder.ok()) return recorder.error();
  for (const domain::Intervention& each : stream.interventions()) {
    if (start.tick <= each.tick && each.tick <= last_tick) recorder->add_intervention(each);
  }
  Result<void> written;
  const auto add = [&](const SampleView& sample) {
    if (!written.ok()) return;
    written = recorder->add(sample.topic, sample.tick, sample.sequence, sample.cdr);
  };
  for (std::uint64_t tick = first; tick <= last_tick; ++tick) {
    for_each_spooled(*stream.tick_from(tick)->records, {add, [](const SpooledState&) {}});
  }
  CLEW_RETURN_IF_ERROR(written);
  return recorder->finish("it was under way");
}

}  // namespace

Result<HeldRecording> HeldRecording::write(const LiveStream& stream, std::uint64_t last_tick,
                                           const Changed& changed) {
  auto start = find_start(stream, last_tick);
  if (!start.ok()) return start.error();
  auto description = described_from(stream, start->tick, changed);
  if (!description.ok()) return description.error();
  const auto folder = files::ScratchFolder::make("clew-held");
  if (!folder.ok()) return folder.error();
  const std::string path = folder->path() + "/held.mcap";
  CLEW_RETURN_IF_ERROR(
      record(stream, std::move(start).value(), last_tick, std::move(description).value(), path));
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return Error{std::strerror(errno), path};
  return HeldRecording(descriptor);
}

HeldRecording::HeldRecording(HeldRecording&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

HeldRecording::~HeldRecording() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::string HeldRecording::path() const {
  return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(descriptor_);
}

}  // namespace clew::bridge
