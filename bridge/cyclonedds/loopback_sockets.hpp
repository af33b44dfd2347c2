// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace clew::bridge {

/// Lets the sockets of this process on which Cyclone DDS receives for `domain` hear the loopback
/// interface only. It sends from 127.0.0.1, but binds what it receives on to all addresses, and has
/// no setting for that. Where the kernel refuses (before Linux 5.7, without privilege) they stay
/// open.
void confine_to_loopback(int domain);

}  // namespace clew::bridge
