// SPDX-License-Identifier: Apache-2.0
#include "clew/sample_output.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "clew/difference_output.hpp"
#include "clew/json_line.hpp"
#include "clew/recorded_fields.hpp"

namespace clew::tools {

using bridge::Field;
using nlohmann::ordered_json;

std::string without_indices(const std::string& path) {
  std::string name;
  bool inside = false;
  for (const char c : path) {
    inside = inside || c == '[';
    if (!inside) name += c;
    if (c == ']') inside = false;
  }
  return name;
}

std::vector<Field> chosen_fields(const std::vector<Field>& fields,
                                 const std::vector<std::string>& wanted) {
  if (wanted.empty()) return fields;
  std::vector<Field> kept;
  for (const std::string& name : wanted) {
    for (const Field& field : fields) {
      if (lies_in(field.path, name)) kept.push_back(field);
    }
  }
  return kept;
}

std::string sample_json(const bridge::SampleView& sample, const std::vector<Field>& fields,
                        const std::vector<std::string>& wanted) {
  ordered_json json = {{"tick", sample.tick}, {"sequence", sample.sequence}};
  if (wanted.empty()) {
    json.update(fields_json(fields));
  } else {
    for (const std::string& name : wanted) json[name] = field_json(fields, name);
  }
  return json_line(json);
}

void print_sample(const bridge::SampleView& sample, const std::vector<Field>& fields) {
  fmt::print("tick {}, sequence {}\n", sample.tick, sample.sequence);
  print_fields("  ", fields);
}

}  // namespace clew::tools
