// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "line/user_data.hpp"

namespace clew::bridge {

/// A secret that the processes of a run share: the supervisor tells it over its line, and nobody
/// else knows it. With it they seal what their endpoints say of themselves, so that a stranger who
/// says the same is known for one. A seal holds for the endpoints of one participant only, and so
/// is of no use to who has read it.
class RunKey {
 public:
  /// The key of no run: it makes no seals, and asks for none.
  RunKey() = default;
  /// With the secret of another one.
  explicit RunKey(std::string secret) : secret_(std::move(secret)) {}
  /// A new one.
  static RunKey make();

  const std::string& secret() const { return secret_; }

  /// Adds the seal of `guid`, which is that of a participant.
  UserData sealed(UserData data, std::string_view guid) const;
  /// Whether an endpoint with this GUID has the seal that belongs to what it says.
  bool fits(const UserData& data, std::string_view guid) const;

 private:
  std::string secret_;  ///< empty: of no run
};

}  // namespace clew::bridge
