// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "domain/field_check.hpp"
#include "domain/message_fields.hpp"

namespace clew::bridge {

/// Fills a message with the least or with the greatest values that are acceptable: empty or full
/// lists and texts, the ends of ranges, the first or the last enumerator.
class EdgeMessages {
 public:
  explicit EdgeMessages(bool greatest) : greatest_(greatest) {}

  template <typename Struct>
  void fill(Struct& value) const {
    domain::for_each_field<Struct>(
        [&](const auto& field) { fill_value(value.*field.member, field.rule); });
  }

 private:
  using Check = domain::FieldCheck;

  void fill_value(double& value, domain::ByType) const {
    value = greatest_ ? Check::kLargest : -Check::kLargest;
  }
  /// Agrees with whatever the others are, in a motion that uses no number too: minus zero.
  void fill_value(double& value, domain::WithOthers) const { value = greatest_ ? 0.0 : -0.0; }
  void fill_value(double& value, domain::NotNegative) const {
    value = greatest_ ? Check::kLargest : std::numeric_limits<double>::denorm_min();
  }
  void fill_value(double& value, domain::WrappedAngle) const {
    value = greatest_ ? core::kPi : -3.1415926535897927;
  }
  void fill_value(double& value, const domain::InRange& rule) const {
    value = greatest_ ? rule.high : rule.low;
  }
  void fill_value(std::string& value, const domain::TextUpTo& rule) const {
    value.assign(greatest_ ? rule.bytes : 0, '\xFF');
  }

  /// Whole numbers, truth values, enumerators, structs and lists.
  template <typename Value, typename Rule>
  void fill_value(Value& value, const Rule& rule) const {
    if constexpr (domain::kIsStruct<Value>) {
      fill(value);
    } else if constexpr (domain::kIsSequence<Value> || domain::kIsArray<Value>) {
      if constexpr (domain::kIsSequence<Value>) {
        value.resize(greatest_ ? domain::length_bound<Value>(rule) : 0);
      }
      for (auto& item : value) fill_value(item, domain::item_rule(rule));
    } else if constexpr (std::is_enum_v<Value>) {
      value = static_cast<Value>(greatest_ ? domain::kEnumeratorNames<Value>.size() - 1 : 0);
    } else if constexpr (std::is_same_v<Rule, domain::AtMost>) {
      value = static_cast<Value>(greatest_ ? rule.last : 0);
    } else {
      value = greatest_ ? std::numeric_limits<Value>::max() : Value{};
    }
  }

  bool greatest_;
};

}  // namespace clew::bridge
