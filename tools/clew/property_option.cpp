// SPDX-License-Identifier: Apache-2.0
#include "clew/property_option.hpp"

#include <fmt/format.h>

namespace clew::tools {

void add_property(CLI::App& app, std::string& text) {
  app.add_option("--property", text,
                 "what should hold, as 'outcome == reached and path_ratio < 1.5'; clew hunt "
                 "--fields lists the names");
}

core::Result<hunt::Property> read_property(const std::string& text) {
  if (text.empty()) {
    return core::Error{
        "is missing; expected a statement, as 'outcome == reached and path_ratio < "
        "1.5'",
        "--property"};
  }
  return hunt::Property::parse(text, "--property");
}

void print_fields() {
  for (const hunt::FieldInfo& info : hunt::fields()) {
    std::string type = "a number";
    if (info.type == hunt::FieldType::kFlag) type = "holds or not";
    if (info.type == hunt::FieldType::kWord) {
      type.clear();
      for (const std::string& word : info.words) type += (type.empty() ? "" : ", ") + word;
    }
    fmt::print("{:<16} {}; {}", info.name, info.doc, type);
    if (info.type == hunt::FieldType::kNumber) fmt::print(", weighed by {:g}", info.scale);
    fmt::print("\n");
  }
}

}  // namespace clew::tools
