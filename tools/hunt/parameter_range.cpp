// SPDX-License-Identifier: Apache-2.0
#include "hunt/parameter_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace clew::hunt {
namespace {

using core::Error;
using core::Result;

constexpr double kMostWhole = 1e15;  // a double tells all whole numbers up to there apart

Result<double> read_end(const std::string& text, const std::string& whole) {
  double number = 0.0;
  const char* last = text.data() + text.size();
  const auto read = std::from_chars(text.data(), last, number);
  if (read.ec == std::errc() && read.ptr == last && std::isfinite(number) &&
      std::fabs(number) <= kMostWhole) {
    return number;
  }
  return Error{fmt::format("found '{}' as an end of a range; expected PATH=LOW..HIGH with finite "
                           "numbers, as control.range_m=0.5..1.5",
                           text),
               "--set " + whole.substr(0, whole.find('='))};
}

bool is_whole(const std::string& text) {
  return text.find_first_not_of("-0123456789") == std::string::npos;
}

Result<ParameterRange> read_range(const std::string& text, std::size_t equals, std::size_t dots) {
  const std::string low_text = text.substr(equals + 1, dots - equals - 1);
  const std::string high_text = text.substr(dots + 2);
  const auto low = read_end(low_text, text);
  if (!low.ok()) return low.error();
  const auto high = read_end(high_text, text);
  if (!high.ok()) return high.error();
  if (!(*low < *high)) {
    return Error{fmt::format("the range {}..{} is empty; its first end must be below its second",
                             low_text, high_text),
                 "--set " + text.substr(0, equals)};
  }
  return ParameterRange{text.substr(0, equals), *low, *high,
                        is_whole(low_text) && is_whole(high_text)};
}

}  // namespace

std::string ParameterRange::setting(double share) const {
  const double at = std::min(std::max(share, 0.0), 1.0);
  if (whole) {
    // Every whole number has an equal part of the range.
    const double number = std::min(std::floor(low + at * (high - low + 1.0)), high);
    return fmt::format("{}={:.0f}", path, number);
  }
  return fmt::format("{}={:.6g}", path, low + at * (high - low));
}

Result<Settings> read_settings(const std::vector<std::string>& texts) {
  Settings settings;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    const std::size_t dots = equals == std::string::npos ? equals : text.find("..", equals);
    if (dots == std::string::npos) {
      settings.fixed.push_back(text);
      continue;
    }
    auto range = read_range(text, equals, dots);
    if (!range.ok()) return range.error();
    settings.ranges.push_back(std::move(range).value());
  }
  return settings;
}

}  // namespace clew::hunt
