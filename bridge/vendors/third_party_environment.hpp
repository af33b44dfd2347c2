// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

#include "dds/participant.hpp"
#include "dds/security_files.hpp"
#include "vendors/memory_file.hpp"

namespace clew::bridge {

/// Who a program is in a secured run: which vendor it uses only it knows.
struct ThirdPartyIdentity {
  std::optional<SecurityFiles> cyclonedds{};
  std::optional<SecurityFiles> fastdds{};
};

/// What a program that does not link clew must find in its environment to meet a run on 127.0.0.1,
/// or at the addresses of its hosts: the run's domain and name, and the settings of each vendor.
/// Some vendors read a file, which is there as long as this object.
class ThirdPartyEnvironment {
 public:
  ThirdPartyEnvironment(int domain, double lease_s, const std::string& run_id,
                        const ThirdPartyIdentity& identity = {},
                        const std::optional<NetworkAddresses>& hosts = {});

  int domain() const { return domain_; }
  const std::map<std::string, std::string>& variables() const { return variables_; }
  /// Why a vendor's file could not be made; empty if all are there.
  const std::string& failure() const { return fastdds_profiles_.failure(); }

 private:
  int domain_;
  MemoryFile fastdds_profiles_;
  std::map<std::string, std::string> variables_;
};

}  // namespace clew::bridge
