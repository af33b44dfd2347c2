// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "core/math.hpp"
#include "core/result.hpp"
#include "domain/topics.hpp"

namespace clew::domain {

/// Where a value stands in a message; put into words only when the value is refused, so it may
/// point at paths that live as long as the check.
struct FieldPath {
  FieldPath(const char* field) : member(field) {}  // NOLINT(google-explicit-constructor)
  FieldPath(const FieldPath* outer_field, const char* field) : outer(outer_field), member(field) {}
  FieldPath(const FieldPath& list, std::size_t i) : outer(&list), index(i) {}

  /// `stamp.sim_time_s`, `ranges_m[3]`, `entries[2].x_m`.
  std::string text() const;

  const FieldPath* outer = nullptr;
  const char* member = nullptr;
  std::optional<std::size_t> index;
};

/// Stands for a path where it is not asked which field a complaint is about: costs nothing.
struct NoPath {
  template <typename... Parts>
  constexpr NoPath(const Parts&... /*parts*/) {}  // NOLINT(google-explicit-constructor)
};

/// Looks at a message field by field and keeps the first complaint: what was found, what is
/// allowed. With NoPath the complaint has no text.
template <typename Path>
class BasicFieldCheck {
 public:
  static constexpr double kLargest = std::numeric_limits<double>::max();

  explicit BasicFieldCheck(Topic topic) : topic_(topic) {}

  /// In [low, high]; NaN is in no range.
  void in_range(const Path& path, double value, double low, double high) {
    if (value >= low && value <= high) return;
    refuse_number(path, value, describe_range(low, high));
  }
  void finite(const Path& path, double value) { in_range(path, value, -kLargest, kLargest); }
  void not_negative(const Path& path, double value) { in_range(path, value, 0.0, kLargest); }
  /// In (-pi, pi], so that a direction has one value.
  void wrapped_angle(const Path& path, double value_rad) {
    if (value_rad > -core::kPi && value_rad <= core::kPi) return;
    refuse_number(path, value_rad, "above -pi and at most pi");
  }
  /// A number that this message's kind does not use.
  void unused(const Path& path, double value) {
    if (value == 0.0) return;
    refuse_number(path, value, "0, since the kind does not use it");
  }
  void at_most(const Path& path, std::size_t value, std::size_t high) {
    if (value <= high) return;
    refuse(path, std::to_string(value), "at most " + std::to_string(high));
  }
  void size(const Path& path, std::size_t size, std::size_t bound) {
    if (size <= bound) return;
    refuse(path, std::to_string(size) + " values long", "at most " + std::to_string(bound));
  }
  void size_is(const Path& path, std::size_t size, std::size_t wanted) {
    if (size == wanted) return;
    refuse(path, std::to_string(size) + " values long", std::to_string(wanted));
  }
  /// At most `bound` bytes, none of them zero, since that ends a string in CDR.
  void text(const Path& path, const std::string& value, std::size_t bound);

  bool ok() const { return !error_.has_value(); }
  /// The first complaint, or success.
  core::Result<void> result() const {
    if (error_) return *error_;
    return {};
  }

 private:
  static std::string describe_range(double low, double high);
  void refuse_number(const Path& path, double found, const std::string& allowed);
  void refuse(const Path& path, const std::string& found, const std::string& allowed);

  Topic topic_;
  std::optional<core::Error> error_;
};

extern template class BasicFieldCheck<FieldPath>;
extern template class BasicFieldCheck<NoPath>;
using FieldCheck = BasicFieldCheck<FieldPath>;

}  // namespace clew::domain
