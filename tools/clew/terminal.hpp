// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace clew::tools {

/// Whether a file is a terminal that knows how to clear a line: no pipe, and not TERM=dumb.
bool is_terminal(int file);

/// Whether standard error is such a terminal, and `-q` does not forbid to show on it how far the
/// command is.
bool shows_progress();

}  // namespace clew::tools
