// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace clew::bridge {

/// Where samples of a bridge come from, so that they do not come back: entries of each endpoint's
/// USER_DATA, `clew_origin=4711-3;clew_hops=2;clew_via=5f2a-20;`. Both vendors hand USER_DATA on,
/// and whoever does not know the entries passes over them.
struct Origin {
  static constexpr int kMostHops = 4;

  std::string id;                  ///< of a run, `4711-3`, or of a domain
  int hops = 1;                    ///< bridges that samples have gone through
  std::vector<std::string> via{};  ///< domains between the first one and this one

  std::string to_text() const;
  /// Empty id if there is none.
  static Origin parse(std::string_view user_data);
  /// Whether samples of a writer with this USER_DATA may be taken by an endpoint of this origin:
  /// not its own, and none that has come through kMostHops bridges.
  bool may_take(std::string_view user_data) const;
  /// Whether samples of this origin have been there.
  bool has_been_on(std::string_view place) const;
};

/// The entries of a USER_DATA list `key=value;` without those of an origin, and without those that
/// `keys` names.
std::string without_origin(std::string_view user_data, const std::vector<std::string>& keys);

}  // namespace clew::bridge
