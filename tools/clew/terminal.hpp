// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace clew::tools {

/// Whether a file is a terminal that knows how to clear a line: no pipe, and not TERM=dumb.
bool is_terminal(int file);

}  // namespace clew::tools
