// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace clew::bridge {

/// Serves `page` and the run that is told of on `socket`, at `port` (0: any free one). First it
/// says where on the socket. When the run has ended it serves on, until a signal. Returns the exit
/// status.
int run_gateway_process(int socket, int port, std::string_view page);

}  // namespace clew::bridge
