// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "domain/message_fields.hpp"

namespace clew::domain {

/// Messages are equal if all their fields are, bit for bit but for the sign of zero.
template <typename Struct>
auto operator==(const Struct& a, const Struct& b) -> std::enable_if_t<kIsStruct<Struct>, bool> {
  bool equal = true;
  for_each_field<Struct>(
      [&](const auto& field) { equal = equal && a.*field.member == b.*field.member; });
  return equal;
}

}  // namespace clew::domain
