// SPDX-License-Identifier: Apache-2.0
/// The two documents of DDS Security 1.1: what is protected (section 9.4.1.2) and who may do what
/// (section 9.4.1.3).
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "security/certificate.hpp"
#include "security/rights.hpp"

namespace clew::bridge {

/// Nobody without an identity takes part, data are encrypted on every topic, and so are discovery
/// and liveliness. *Deviation:* messages as a whole are not protected, since Fast DDS 2.9 and
/// Cyclone DDS 0.10 do not read each other's then.
std::string governance_text();
/// What is weaker than that: `data_protection_kind is NONE; allowed: ENCRYPT`. Empty if nothing is.
std::string governance_weakness(const std::string& text);

/// What one participant may do.
struct Grant {
  std::string subject;  ///< as subject_text() has it
  Validity validity;
  Rights rights;
};

/// Everything else is denied.
std::string permissions_text(const Grant& grant);
/// Refused: what is no such document, rules other than those that permissions_text() writes, and a
/// grant that allows what it does not name.
core::Result<std::vector<Grant>> read_permissions(const std::string& text);

}  // namespace clew::bridge
