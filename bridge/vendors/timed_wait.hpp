// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>

namespace clew::bridge {

/// When a wait until `until` ends, as a time of CLOCK_MONOTONIC. `until` is a time of the wall
/// clock or of CLOCK_MONOTONIC, of whichever it is nearer to what that shows now: a wait is for
/// less than the decades between the two.
timespec monotonic_deadline(const timespec& until, const timespec& wall_now,
                            const timespec& monotonic_now);

}  // namespace clew::bridge
