// SPDX-License-Identifier: Apache-2.0
#include "vendors/third_party_environment.hpp"

#include "cyclonedds/configuration.hpp"

namespace clew::bridge {

std::map<std::string, std::string> environment_for_third_party(int domain, double lease_s) {
  return {{"CYCLONEDDS_URI", cyclonedds_configuration({domain, {}, lease_s})}};
}

}  // namespace clew::bridge
