// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "recorder/recording_sink.hpp"

namespace clew::bridge {

/// The name by which a run's recorder reports, in the place of a stage.
inline constexpr char kRecorderName[] = "recorder";

/// What a recorder process is to do.
struct RecorderAssignment {
  RecordingOrder order;
  bool again = false;             ///< another one was there before
  std::uint64_t least_ticks = 0;  ///< that it said were durable
};

template <typename V>
void visit_fields(V& v, RecorderAssignment& a) {
  v(a.order, a.again, a.least_ticks);
}

/// Goes on with a file that is reserved, or was left by a recorder of the same run: see
/// RunRecorder::go_on.
core::Result<std::unique_ptr<RunSink>> open_sink(const RecordingOrder& order,
                                                 std::uint64_t least_ticks = 0);

/// Records the run that holds `domain`, until it is told that all is there. The file keeps its
/// temporary name: giving it its own is the supervisor's, which outlives recorders. Returns the
/// exit status.
int run_recorder_process(int domain, double connect_timeout_s);

}  // namespace clew::bridge
