// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <random>

#include "domain/message_fields.hpp"

namespace clew::bridge {

/// Fills a message with acceptable values that differ from the default and from each other; lists
/// and texts have any length up to their bound.
class RandomMessages {
 public:
  explicit RandomMessages(unsigned seed) : engine_(seed) {}

  template <typename Struct>
  void fill(Struct& value) {
    domain::for_each_field<Struct>(
        [&](const auto& field) { fill_value(value.*field.member, field.rule); });
    agree(value);
  }

 private:
  double number(double low, double high);
  std::uint32_t count(std::size_t last);
  bool coin() { return count(1) == 1; }
  std::string text(std::size_t bound);

  void fill_value(double& value, domain::ByType) { value = number(-50.0, 50.0); }
  void fill_value(double& value, domain::WithOthers) { value = number(0.0, 1.0); }
  void fill_value(double& value, domain::NotNegative) { value = number(1.0, 500.0); }
  void fill_value(double& value, domain::WrappedAngle) { value = number(-3.1, 3.1); }
  void fill_value(double& value, const domain::InRange& rule) {
    value = number(rule.low, rule.high);
  }
  void fill_value(std::string& value, const domain::TextUpTo& rule) { value = text(rule.bytes); }
  void fill_value(bool& value, domain::ByType) { value = coin(); }

  /// Whole numbers, enumerators, structs and lists.
  template <typename Value, typename Rule>
  void fill_value(Value& value, const Rule& rule) {
    if constexpr (domain::kIsStruct<Value>) {
      fill(value);
    } else if constexpr (domain::kIsSequence<Value> || domain::kIsArray<Value>) {
      if constexpr (domain::kIsSequence<Value>) {
        value.resize(count(domain::length_bound<Value>(rule)));
      }
      for (auto& item : value) fill_value(item, domain::item_rule(rule));
    } else if constexpr (std::is_enum_v<Value>) {
      value = static_cast<Value>(count(domain::kEnumeratorNames<Value>.size() - 1));
    } else if constexpr (std::is_same_v<Rule, domain::AtMost>) {
      value = static_cast<Value>(count(rule.last));
    } else if constexpr (sizeof(Value) == sizeof(std::uint64_t)) {
      value = (Value{count(9)} << 40) + count(1000);  // more than 32 bits
    } else {
      value = static_cast<Value>(count(1000));
    }
  }

  /// Makes the fields of a struct agree as domain::validate asks for.
  template <typename Struct>
  void agree(Struct&) {}
  void agree(domain::Motion& motion);
  void agree(domain::VirtualObstacle& box);
  void agree(domain::PoseCovariance& covariance);
  void agree(domain::Target& target);
  void agree(domain::Scan& scan);

  std::mt19937 engine_;
};

}  // namespace clew::bridge
