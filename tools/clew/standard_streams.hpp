// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace clew::tools {

/// Takes the places of those standard streams that are closed. Otherwise the next file that is
/// opened gets their number: a recording, which then holds what was meant for a terminal. Reading
/// and writing them fail as before.
void hold_standard_streams();

}  // namespace clew::tools
