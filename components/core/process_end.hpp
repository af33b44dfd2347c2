// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace clew::core {

/// Ends this process at once, without what its parent has to do at its own exit: the way out of a
/// child that was forked and runs no other program. In a coverage build, what it ran is written
/// first.
[[noreturn]] void end_at_once(int status);

/// Ends this process by SIGABRT. In a coverage build, what it ran is written first.
[[noreturn]] void abort_process();

}  // namespace clew::core
