// SPDX-License-Identifier: Apache-2.0
/// Whatever the bytes: RunRecording refuses them, or gives samples of its topics.
#include <cstdint>

#include "core/check.hpp"
#include "fuzzed_file.hpp"
#include "recording/run_recording.hpp"

namespace clew::fuzz {
namespace {

using bridge::RunRecording;

void read(const std::string& path) {
  const auto recording = RunRecording::open(path);
  if (!recording.ok()) {
    CLEW_CHECK(!recording.error().message.empty(), "an error without a message");
    return;
  }
  CLEW_CHECK(recording->description().tick_s > 0.0, "ticks that take no time");
  auto stream = recording->samples();
  std::uint64_t count = 0;
  for (auto sample = stream.next(); sample.ok() && *sample; sample = stream.next()) {
    CLEW_CHECK(recording->description().schemas.count((*sample)->topic) == 1, "an unknown topic");
    ++count;
  }
  const auto survey = recording->survey();
  if (!survey.ok()) return;
  std::uint64_t surveyed = 0;
  for (const auto& [topic, found] : survey->topics) surveyed += found.samples;
  CLEW_CHECK(surveyed == count, "a survey of other samples");
  CLEW_CHECK(!recording->end() || recording->end()->hash == survey->hash, "another run's hash");
}

}  // namespace
}  // namespace clew::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const clew::fuzz::FuzzedFile file(bytes, size);
  clew::fuzz::read(file.path());
  return 0;
}
