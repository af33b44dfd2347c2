// SPDX-License-Identifier: Apache-2.0
#include "dds/rtps_ports.hpp"

#include <string>

namespace clew::bridge {

core::Result<void> check_domain(int domain) {
  if (domain >= 0 && domain <= kMaxDomain) return {};
  return core::Error{
      "domain " + std::to_string(domain) + "; allowed: 0 to " + std::to_string(kMaxDomain), {}};
}

}  // namespace clew::bridge
