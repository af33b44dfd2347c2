// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "domain/field_check.hpp"
#include "domain/message_fields.hpp"
#include "domain/topics.hpp"

namespace clew::domain {
namespace {

/// What rounding may leave of a covariance whose variances say less.
double covariance_bound(double variance_a, double variance_b) {
  constexpr double kRounding_ratio = 1.0 + 1e-6;
  constexpr double kRounding = 1e-9;
  return kRounding_ratio * std::sqrt(variance_a) * std::sqrt(variance_b) + kRounding;
}

template <typename Path>
using Check = BasicFieldCheck<Path>;

// --- What members of a struct must keep together: its own overload, if there is such a rule. ---

template <typename Path, typename Struct>
void check_together(Check<Path>& /*check*/, const Path* /*outer*/, const Struct& /*value*/) {}

/// Numbers that a motion's kind does not use are 0.
template <typename Path>
void check_together(Check<Path>& check, const Path* outer, const Motion& m) {
  const auto number = [&](const char* member, double value, CommandKind user, double bound) {
    if (m.kind == user) {
      check.in_range({outer, member}, value, -bound, bound);
    } else {
      check.unused({outer, member}, value);
    }
  };
  number("turn_rad", m.turn_rad, CommandKind::kTurnAndStep, core::kPi);
  number("step_m", m.step_m, CommandKind::kTurnAndStep, FieldCheck::kLargest);
  number("speed_mps", m.speed_mps, CommandKind::kVelocities, FieldCheck::kLargest);
  number("turn_rate_radps", m.turn_rate_radps, CommandKind::kVelocities, FieldCheck::kLargest);
  number("left_mps", m.left_mps, CommandKind::kWheelSpeeds, FieldCheck::kLargest);
  number("right_mps", m.right_mps, CommandKind::kWheelSpeeds, FieldCheck::kLargest);
}

template <typename Path>
void check_together(Check<Path>& check, const Path* outer, const VirtualObstacle& box) {
  check.in_range({outer, "x_min_m"}, box.x_min_m, -FieldCheck::kLargest, box.x_max_m);
  check.in_range({outer, "y_min_m"}, box.y_min_m, -FieldCheck::kLargest, box.y_max_m);
}

/// A covariance is at most the root of the product of the two variances, but for rounding.
template <typename Path>
void check_together(Check<Path>& check, const Path* outer, const PoseCovariance& c) {
  const auto covariance = [&](const char* member, double value, double a, double b) {
    const double bound = std::min(covariance_bound(a, b), FieldCheck::kLargest);
    check.in_range({outer, member}, value, -bound, bound);
  };
  covariance("xy_m2", c.xy_m2, c.x_m2, c.y_m2);
  covariance("x_heading_m_rad", c.x_heading_m_rad, c.x_m2, c.heading_rad2);
  covariance("y_heading_m_rad", c.y_heading_m_rad, c.y_m2, c.heading_rad2);
}

template <typename Path>
void check_together(Check<Path>& check, const Path* outer, const Target& m) {
  check.at_most({outer, "waypoint"}, m.waypoint, m.waypoints);
}

template <typename Path>
void check_together(Check<Path>& check, const Path* outer, const Scan& m) {
  check.in_range({outer, "range_min_m"}, m.range_min_m, 0.0, m.range_max_m);
  const Path ranges(outer, "ranges_m");
  for (std::size_t i = 0; i < m.ranges_m.size(); ++i) {
    check.in_range({ranges, i}, m.ranges_m[i], 0.0, m.range_max_m);
  }
}

// --- What one value must keep: by its rule, or else by its type. ---

template <typename Path>
void check_value(Check<Path>& check, const Path& path, double value, ByType) {
  check.finite(path, value);
}
template <typename Path>
void check_value(Check<Path>& check, const Path& path, double value, NotNegative) {
  check.not_negative(path, value);
}
template <typename Path>
void check_value(Check<Path>& check, const Path& path, double value, WrappedAngle) {
  check.wrapped_angle(path, value);
}
template <typename Path>
void check_value(Check<Path>& check, const Path& path, double value, const InRange& rule) {
  check.in_range(path, value, rule.low, rule.high);
}
template <typename Path>
void check_value(Check<Path>&, const Path&, double, WithOthers) {}
template <typename Path>
void check_value(Check<Path>& check, const Path& path, const std::string& value,
                 const TextUpTo& rule) {
  check.text(path, value, rule.bytes);
}

template <typename Path, typename Struct>
void check_struct(Check<Path>& check, const Path* outer, const Struct& value);

/// Whole numbers, truth values, enumerators, structs and lists.
template <typename Path, typename Value, typename Rule>
void check_value(Check<Path>& check, const Path& path, const Value& value, const Rule& rule) {
  if constexpr (kIsStruct<Value>) {
    check_struct(check, &path, value);
  } else if constexpr (kIsSequence<Value> || kIsArray<Value>) {
    if constexpr (kIsSequence<Value>) check.size(path, value.size(), length_bound<Value>(rule));
    for (std::size_t i = 0; i < value.size(); ++i) {
      check_value(check, Path(path, i), value[i], item_rule(rule));
    }
  } else if constexpr (std::is_enum_v<Value>) {
    check.at_most(path, static_cast<std::size_t>(value), kEnumeratorNames<Value>.size() - 1);
  } else if constexpr (std::is_same_v<Rule, AtMost>) {
    check.at_most(path, value, rule.last);
  } else {
    static_assert(std::is_integral_v<Value> && std::is_same_v<Rule, ByType>,
                  "a rule that is none of such values");
  }
}

template <typename Path, typename Struct>
void check_struct(Check<Path>& check, const Path* outer, const Struct& value) {
  for_each_field<Struct>([&](const auto& field) {
    check_value(check, Path(outer, field.name), value.*field.member, field.rule);
  });
  check_together(check, outer, value);
}

}  // namespace

core::Result<void> validate(ConstMessagePointer message) {
  return std::visit(
      [](const auto* m) {
        constexpr Topic kTopic = topic_of<std::decay_t<decltype(*m)>>();
        Check<NoPath> quick(kTopic);
        check_struct<NoPath>(quick, nullptr, *m);
        if (quick.ok()) return core::Result<void>();
        Check<FieldPath> slow(kTopic);
        check_struct<FieldPath>(slow, nullptr, *m);
        return slow.result();
      },
      message);
}

}  // namespace clew::domain
