// SPDX-License-Identifier: Apache-2.0
#include "clew/command_line.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>

namespace clew::tools {
namespace {

/// CLI11 reads 010 as 8; who pads numbers, as seq -w does, means 10.
bool has_leading_zero(std::string_view text) {
  if (!text.empty() && text.front() == '-') text.remove_prefix(1);
  return text.size() > 1 && text[0] == '0' && text.find_first_not_of("0123456789") == text.npos;
}

/// What is wrong with a number that is none of those allowed.
std::string wrong_number(const std::string& text, const std::string& allowed) {
  return fmt::format("found '{}'; allowed: {}{}", text, allowed,
                     has_leading_zero(text) ? " without leading zeros" : "");
}

/// All of `text` as a number of this type; none if it is anything else.
template <typename Number>
std::optional<Number> number_of(const std::string& text) {
  if (has_leading_zero(text)) return std::nullopt;
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace

CLI::Validator decimal_number() {
  return {[](std::string& text) {
            return has_leading_zero(text) ? wrong_number(text, "a number") : std::string();
          },
          ""};
}

CLI::Validator whole_number() {
  return {[](std::string& text) {
            const auto count = number_of<std::int64_t>(text);
            if (count && *count >= 0) return std::string();
            return wrong_number(text, fmt::format("a whole number from 0 to {}",
                                                  std::numeric_limits<std::int64_t>::max()));
          },
          ""};
}

CLI::Validator number_between(double low, double high) {
  return {[low, high](std::string& text) {
            const auto value = number_of<double>(text);
            if (value && *value >= low && *value <= high) return std::string();
            return wrong_number(text, fmt::format("{} to {}", low, high));
          },
          ""};
}

CLI::Validator size_in_bytes(std::uint64_t least) {
  return {[least](std::string& text) {
            const std::size_t digits = text.find_first_not_of("0123456789.");
            const std::string unit = digits == std::string::npos ? "" : text.substr(digits);
            const std::map<std::string, double> units = {
                {"", 1.0}, {"B", 1.0}, {"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}};
            const auto factor = units.find(unit);
            const auto number = number_of<double>(text.substr(0, digits));
            constexpr double kMost = 1e15;
            const double bytes =
                number && factor != units.end() ? std::floor(*number * factor->second) : -1.0;
            if (!(bytes >= static_cast<double>(least) && bytes <= kMost)) {
              return fmt::format("found '{}'; allowed: from {} on, in bytes, or with kB, MB or GB",
                                 text, least);
            }
            text = std::to_string(static_cast<std::uint64_t>(bytes));
            return std::string();
          },
          ""};
}

CLI::Validator given_name() {
  return {[](std::string& name) { return std::string(name.empty() ? "the name is empty" : ""); },
          ""};
}

void add_overrides(CLI::App& app, runtime::GraphOverrides& overrides) {
  app.add_option("--world", overrides.world, "another world: a name or a path");
  app.add_option("--robot", overrides.robot, "another robot: a name or a path");
  app.add_option("--with", overrides.with, "STAGE[.PART]=NAME[,NAME...]: another behaviour")
      ->allow_extra_args(false);
  app.add_option("--set", overrides.set, "STAGE[.PART][.NAME].PARAM=VALUE: another value")
      ->allow_extra_args(false);
  app.add_option("--seed", overrides.seed, "seed of all random numbers (1)")->check(whole_number());
  app.add_option("--max-ticks", overrides.max_ticks, "time out after this many ticks (20000)")
      ->check(whole_number());
}

}  // namespace clew::tools
