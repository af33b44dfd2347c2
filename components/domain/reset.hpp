// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "domain/message_fields.hpp"

namespace clew::domain {

/// Sets a message to *nothing*: default values, keeping the memory of its lists and texts.
template <typename Struct>
void reset(Struct& value) {
  static const Struct kNothing{};
  for_each_field<Struct>([&](const auto& field) {
    auto& member = value.*field.member;
    using Member = std::decay_t<decltype(member)>;
    if constexpr (kIsStruct<Member>) {
      reset(member);
    } else if constexpr (kIsSequence<Member> || std::is_same_v<Member, std::string>) {
      member.clear();
    } else {
      member = kNothing.*field.member;
    }
  });
}

}  // namespace clew::domain
