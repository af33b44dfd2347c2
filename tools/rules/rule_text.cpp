// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "rules/rule_picture.hpp"
#include "rules/sampling.hpp"

namespace clew::rules {
namespace {

using nlohmann::ordered_json;

constexpr double kFull = 0.995;
constexpr double kNone = 0.005;
/// Values of a surface along each side, as far as a terminal is wide.
constexpr std::size_t kShown = 6;

/// `0.3 to 0.7`, where the degrees are at least that; `nowhere`.
std::string span_of(const FuzzySet& set, const Axis& axis, double least) {
  const auto enough = [&](double degree) { return degree >= least; };
  const auto first = std::find_if(set.degrees.begin(), set.degrees.end(), enough);
  if (first == set.degrees.end()) return "nowhere";
  const auto last = std::find_if(set.degrees.rbegin(), set.degrees.rend(), enough);
  const auto from = static_cast<std::size_t>(first - set.degrees.begin());
  const auto to = static_cast<std::size_t>(set.degrees.rend() - last) - 1;
  const double low = value_at(axis, from, set.degrees.size());
  const double high = value_at(axis, to, set.degrees.size());
  return from == to ? fmt::format("{:.3g}", low) : fmt::format("{:.3g} to {:.3g}", low, high);
}

std::string unit_text(const std::string& unit) { return unit.empty() ? "" : ", " + unit; }

std::string describe(const Surface& surface) {
  std::string text = fmt::format("  {}{}{}{}\n", surface.name, unit_text(surface.unit),
                                 surface.given.empty() ? "" : ", where ", surface.given);
  const std::size_t rows = surface.values.size() / surface.columns;
  const auto step_of = [](std::size_t count, std::size_t i) {
    return i * (count - 1) / (kShown - 1);
  };
  for (std::size_t i = kShown; i-- > 0;) {
    const std::size_t row = step_of(rows, i);
    text += fmt::format("    {:>8.3g} |", value_at(surface.up, row, rows));
    for (std::size_t j = 0; j < kShown; ++j) {
      const std::size_t column = step_of(surface.columns, j);
      text += fmt::format(" {:>8.3g}", surface.values[row * surface.columns + column] + 0.0);
    }
    text += '\n';
  }
  text += fmt::format("    {:>8} |", "");
  for (std::size_t j = 0; j < kShown; ++j) {
    text += fmt::format(" {:>8.3g}",
                        value_at(surface.across, step_of(surface.columns, j), surface.columns));
  }
  return text + fmt::format("\n    up: {}{}; across: {}{}\n", surface.up.name,
                            unit_text(surface.up.unit), surface.across.name,
                            unit_text(surface.across.unit));
}

ordered_json axis_json(const Axis& axis) {
  return {{"name", axis.name}, {"unit", axis.unit}, {"low", axis.low}, {"high", axis.high}};
}

}  // namespace

std::string describe(const RuleBase& base) {
  std::string text = fmt::format("{}: rulebases/{}\n", base.stage, base.name);
  for (const Variable& variable : base.variables) {
    text += fmt::format("  {}{}\n", variable.axis.name, unit_text(variable.axis.unit));
    for (const FuzzySet& set : variable.sets) {
      text += fmt::format("    {:<12} full: {:<18} above 0: {}\n", set.name,
                          span_of(set, variable.axis, kFull), span_of(set, variable.axis, kNone));
    }
  }
  for (const std::string& rule : base.rules) text += "  " + rule + '\n';
  for (const Surface& surface : base.surfaces) text += describe(surface);
  return text;
}

std::string to_json(const RuleBase& base) {
  ordered_json json = {{"stage", base.stage}, {"parameter", base.parameter},
                       {"file", base.name},   {"variables", ordered_json::array()},
                       {"rules", base.rules}, {"surfaces", ordered_json::array()}};
  for (const Variable& variable : base.variables) {
    ordered_json one = axis_json(variable.axis);
    one["sets"] = ordered_json::array();
    for (const FuzzySet& set : variable.sets) {
      one["sets"].push_back({{"name", set.name}, {"degrees", set.degrees}});
    }
    json["variables"].push_back(std::move(one));
  }
  for (const Surface& surface : base.surfaces) {
    json["surfaces"].push_back({{"name", surface.name},
                                {"unit", surface.unit},
                                {"given", surface.given},
                                {"across", axis_json(surface.across)},
                                {"up", axis_json(surface.up)},
                                {"columns", surface.columns},
                                {"values", surface.values}});
  }
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace clew::rules
