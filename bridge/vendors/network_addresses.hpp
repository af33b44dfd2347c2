// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "dds/participant.hpp"

namespace clew::bridge {

/// Whether an interface of this host that is up has the IPv4 address.
bool is_own_address(const std::string& address);

/// Where a participant here speaks in a run over the hosts with these addresses: at the first that
/// is one of this host's. None without addresses: on 127.0.0.1. Refused: addresses of others only,
/// and what is no IPv4 address.
core::Result<std::optional<NetworkAddresses>> network_of(const std::vector<std::string>& addresses);

}  // namespace clew::bridge
