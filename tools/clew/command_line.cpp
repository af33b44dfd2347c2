// SPDX-License-Identifier: Apache-2.0
#include "clew/command_line.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <system_error>

namespace clew::tools {
namespace {

/// All of `text` as a number of this type; none if it is anything else.
template <typename Number>
std::optional<Number> number_of(const std::string& text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace

CLI::Validator whole_number() {
  return {[](std::string& text) {
            const auto count = number_of<std::int64_t>(text);
            if (count && *count >= 0) return std::string();
            return fmt::format("found '{}'; allowed: a whole number from 0 to {}", text,
                               std::numeric_limits<std::int64_t>::max());
          },
          ""};
}

CLI::Validator number_between(double low, double high) {
  return {[low, high](std::string& text) {
            const auto value = number_of<double>(text);
            if (value && *value >= low && *value <= high) return std::string();
            return fmt::format("found '{}'; allowed: {} to {}", text, low, high);
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
