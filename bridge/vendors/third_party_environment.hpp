// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

namespace clew::bridge {

/// What a component that does not link clew must find in its environment to meet a run on
/// 127.0.0.1: settings of vendors that are read from variables.
std::map<std::string, std::string> environment_for_third_party(int domain, double lease_s);

}  // namespace clew::bridge
