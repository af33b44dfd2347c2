// SPDX-License-Identifier: Apache-2.0
#include "clew/parameter_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <variant>

namespace clew::tools {
namespace {

struct ValueText {
  std::string operator()(bool v) const { return v ? "true" : "false"; }
  std::string operator()(std::int64_t v) const { return std::to_string(v); }
  std::string operator()(double v) const { return fmt::format("{}", v); }
  std::string operator()(const std::string& v) const { return v.empty() ? "\"\"" : v; }
  std::string operator()(const std::vector<std::string>& v) const {
    return fmt::format("[{}]", fmt::join(v, ", "));
  }
};

// A bar would end the cell.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

}  // namespace

std::string default_text(const core::ParameterInfo& info) {
  return std::visit(ValueText{}, info.default_value);
}

std::string allowed_text(const core::ParameterInfo& info) {
  if (info.range) return fmt::format("{} to {}", info.range->min, info.range->max);
  if (!info.choices.empty()) return fmt::format("{}", fmt::join(info.choices, " | "));
  if (!info.folder.empty()) return "a file of configs/" + info.folder;
  return {};
}

std::string parameter_table(const std::vector<core::ParameterInfo>& infos) {
  std::string table = "| parameter | default | unit | allowed | meaning |\n|---|---|---|---|---|\n";
  for (const core::ParameterInfo& info : infos) {
    table +=
        fmt::format("| `{}` | `{}` | {} | {} | {} |\n", info.name, default_text(info),
                    info.unit == "1" ? "" : info.unit, cell(allowed_text(info)), cell(info.doc));
  }
  return table;
}

}  // namespace clew::tools
