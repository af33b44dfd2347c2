// SPDX-License-Identifier: Apache-2.0
/// What a message consists of, written once: the members of a struct by their names in idl/, in its
/// order, and the values that each may have. Bytes, checks, lists of fields and equality all follow
/// from it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/bounded_vector.hpp"

namespace clew::domain {

/// Rules of values. That of a list or of an array is the rule of its items.
///
/// What the type says: a number is finite, an enumerator has a name, the items of a list and the
/// fields of a struct keep their own rules; whole numbers and truth values are free.
struct ByType {};
/// Depends on other members: validate.cpp has the rule of the struct.
struct WithOthers {};
/// Finite and at least 0.
struct NotNegative {};
/// In (-pi, pi], so that a direction has one value.
struct WrappedAngle {};
/// In [low, high].
struct InRange {
  double low;
  double high;
};
/// Of whole numbers.
struct AtMost {
  std::uint64_t last;
};
/// A text of so many bytes at most, none of them zero, since that ends a string in CDR.
struct TextUpTo {
  std::size_t bytes;
};
/// A list of so many items at most whose memory does not bound it.
template <typename ItemRule = ByType>
struct ListUpTo {
  std::size_t length;
  ItemRule item{};
};
template <typename ItemRule>
ListUpTo(std::size_t, ItemRule) -> ListUpTo<ItemRule>;

/// A member of a struct: its name in idl/, and what it may be.
template <typename Struct, typename Member, typename Rule>
struct Field {
  const char* name;
  Member Struct::*member;
  Rule rule;
};

template <typename Struct, typename Member, typename Rule = ByType>
constexpr Field<Struct, Member, Rule> field(const char* name, Member Struct::*member,
                                            Rule rule = {}) {
  return {name, member, rule};
}

/// Every member of a struct, as a tuple of Field; specialised in domain/message_fields.hpp.
struct NoFields {};
template <typename Struct>
inline constexpr NoFields kFields{};

/// The names of an enumeration's values in idl/, from 0 without a gap; specialised there, too.
template <typename Enum>
inline constexpr std::array<const char*, 0> kEnumeratorNames{};

template <typename T>
inline constexpr bool kIsStruct = !std::is_same_v<std::decay_t<decltype(kFields<T>)>, NoFields>;

/// Calls visit(field) for each member of a struct, in the order of idl/.
template <typename Struct, typename Visitor>
constexpr void for_each_field(Visitor&& visit) {
  static_assert(kIsStruct<Struct>, "a struct without a list of its fields");
  std::apply([&](const auto&... fields) { (visit(fields), ...); }, kFields<Struct>);
}

/// Calls visit(name, member) for each member of `value`.
template <typename Visitor, typename Struct>
void visit_named_fields(Visitor&& visit, Struct& value) {
  for_each_field<std::remove_const_t<Struct>>(
      [&](const auto& field) { visit(field.name, value.*field.member); });
}

/// A list of any length up to a bound, which its bytes tell.
template <typename T>
inline constexpr bool kIsSequence = false;
template <typename T>
inline constexpr bool kIsSequence<std::vector<T>> = true;
template <typename T, std::size_t N>
inline constexpr bool kIsSequence<core::BoundedVector<T, N>> = true;

/// A list whose length the type fixes.
template <typename T>
inline constexpr bool kIsArray = false;
template <typename T, std::size_t N>
inline constexpr bool kIsArray<std::array<T, N>> = true;

/// The items' rule of a list or an array that has `rule`.
template <typename Rule>
constexpr Rule item_rule(const Rule& rule) {
  return rule;
}
template <typename ItemRule>
constexpr ItemRule item_rule(const ListUpTo<ItemRule>& rule) {
  return rule.item;
}

/// How many items a sequence that has `rule` may have.
template <typename Sequence, typename Rule>
constexpr std::size_t length_bound(const Rule& /*rule*/) {
  return Sequence::kCapacity;
}
template <typename Sequence, typename ItemRule>
constexpr std::size_t length_bound(const ListUpTo<ItemRule>& rule) {
  return rule.length;
}

}  // namespace clew::domain
