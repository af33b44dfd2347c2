// SPDX-License-Identifier: Apache-2.0
#include "vendors/third_party_environment.hpp"

#include "cyclonedds/configuration.hpp"
#include "fastdds/profiles.hpp"

namespace clew::bridge {

// A file of profiles in the working directory would be read after ours, and a discovery server make
// clients of the participants.
ThirdPartyEnvironment::ThirdPartyEnvironment(int domain, double lease_s, const std::string& run_id,
                                             const ThirdPartyIdentity& identity,
                                             const std::optional<NetworkAddresses>& hosts)
    : domain_(domain),
      fastdds_profiles_(
          "clew-fastdds-profiles",
          fastdds_profiles({domain, {}, lease_s, {}, false, identity.fastdds, hosts})),
      variables_{
          {"CLEW_DOMAIN_ID", std::to_string(domain)},
          {"CLEW_RUN_ID", run_id},
          {"CYCLONEDDS_URI",
           cyclonedds_configuration({domain, {}, lease_s, {}, false, identity.cyclonedds, hosts})},
          {"FASTRTPS_DEFAULT_PROFILES_FILE", fastdds_profiles_.path()},
          {"SKIP_DEFAULT_XML_FILE", "1"},
          {"ROS_DISCOVERY_SERVER", ""}} {}

}  // namespace clew::bridge
