// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace clew::bridge {

/// What an endpoint's USER_DATA says of it: `clew_idl=<hex>;clew_stage=<name>;clew_seal=<hex>;`.
/// The stage and its seal (RunKey) are left out by components that do not link clew.
struct UserData {
  std::string idl_fingerprint;
  std::string stage;
  std::string seal{};

  std::string to_text() const;
  /// Entries that are not known are passed over; missing ones stay empty.
  static UserData parse(std::string_view text);
};

}  // namespace clew::bridge
