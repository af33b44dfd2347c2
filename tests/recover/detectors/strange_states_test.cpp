// SPDX-License-Identifier: Apache-2.0
/// Counts that no run has come of a file that somebody made: they are refused, and the detector
/// goes on from nothing.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

#include "recover/detectors/no_safe_region.hpp"
#include "recover/detectors/oscillation.hpp"
#include "recover/detectors/position_revisit.hpp"

namespace clew::recover {
namespace {

/// The fault of a state, after a detector's own bytes for what comes behind it.
template <typename Detector>
std::string fault_of(Detector& detector, const typename Detector::State& state) {
  core::StateWriter fresh;
  detector.save(fresh);
  core::StateWriter empty;
  empty(typename Detector::State{});
  core::StateWriter strange;
  strange(state);
  const std::string bytes = strange.bytes() + fresh.bytes().substr(empty.bytes().size());
  core::StateReader reader(bytes);
  detector.load(reader);
  return reader.complete() ? "" : reader.fault();
}

template <typename Detector>
void refuses_strange_counts(Detector& detector, std::int64_t Detector::State::*count,
                            const std::string& why) {
  for (const std::int64_t strange : {std::int64_t{-1}, std::numeric_limits<std::int64_t>::max()}) {
    typename Detector::State state;
    EXPECT_EQ(fault_of(detector, state), "");
    state.*count = strange;
    EXPECT_NE(fault_of(detector, state).find(why), std::string::npos) << strange;
  }
}

TEST(StrangeStates, AreRefusedByPositionRevisit) {
  PositionRevisit detector({});
  const char* const why = "a number of recognitions is none";
  refuses_strange_counts(detector, &PositionRevisit::State::in_a_row, why);
  refuses_strange_counts(detector, &PositionRevisit::State::turned_in_a_row, why);
}

TEST(StrangeStates, AreRefusedByNoSafeRegion) {
  NoSafeRegion detector({}, 0.15);
  refuses_strange_counts(detector, &NoSafeRegion::State::in_a_row, "a number of ticks is none");
}

TEST(StrangeStates, AreRefusedByOscillation) {
  Oscillation detector({});
  refuses_strange_counts(detector, &Oscillation::State::in_a_row, "a number of repeats is none");
}

}  // namespace
}  // namespace clew::recover
