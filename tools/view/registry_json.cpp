// SPDX-License-Identifier: Apache-2.0
#include "view/registry_json.hpp"

namespace clew::view {
namespace {

using nlohmann::ordered_json;

ordered_json to_json(const core::ParameterInfo& info) {
  ordered_json json = {{"name", info.name}, {"unit", info.unit}, {"doc", info.doc}};
  std::visit([&](const auto& value) { json["default"] = value; }, info.default_value);
  if (info.range) json["range"] = {info.range->min, info.range->max};
  if (!info.choices.empty()) json["choices"] = info.choices;
  if (!info.folder.empty()) json["folder"] = info.folder;
  return json;
}

ordered_json to_json(const std::vector<core::ParameterInfo>& infos) {
  ordered_json json = ordered_json::array();
  for (const core::ParameterInfo& info : infos) json.push_back(to_json(info));
  return json;
}

}  // namespace

ordered_json registry_json(const std::vector<runtime::StageInfo>& stages) {
  ordered_json json = ordered_json::array();
  for (const runtime::StageInfo& stage : stages) {
    ordered_json parts = ordered_json::array();
    for (const runtime::PartInfo& part : stage.parts) {
      ordered_json variants = ordered_json::array();
      for (const runtime::VariantInfo& variant : part.variants) {
        variants.push_back({{"name", variant.name},
                            {"summary", variant.summary},
                            {"parameters", to_json(variant.parameters)}});
      }
      parts.push_back({{"name", part.name}, {"is_list", part.is_list}, {"variants", variants}});
    }
    json.push_back({{"name", stage.name},
                    {"summary", stage.summary},
                    {"parameters", to_json(stage.parameters)},
                    {"parts", parts}});
  }
  return json;
}

}  // namespace clew::view
