// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"
#include "hosts/host_list.hpp"

namespace clew::bridge {

/// A listening socket that does not block. The error says why there is none.
core::Result<int> listen_on(const TcpAddress& where);
/// Where a listening or connected socket is on this host.
TcpAddress own_end(int socket);
/// Where the other end of a connected socket is.
TcpAddress other_end(int socket);
/// The next connection, ready for small messages; -1 if there is none.
int accept_next(int listening);
/// Begins to connect; the socket can be written to once it is connected, or has failed.
core::Result<int> begin_connecting(const TcpAddress& where);
/// The address of this host from which one reaches `where`.
core::Result<std::string> address_towards(const TcpAddress& where);

}  // namespace clew::bridge
