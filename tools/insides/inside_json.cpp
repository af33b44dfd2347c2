// SPDX-License-Identifier: Apache-2.0
#include "insides/inside_json.hpp"

#include <cmath>

namespace clew::insides {
namespace {

using nlohmann::ordered_json;

struct ValueToJson {
  ordered_json operator()(double value) const { return value; }
  ordered_json operator()(bool value) const { return value; }
  ordered_json operator()(const std::string& value) const { return value; }
  ordered_json operator()(const std::vector<double>& values) const { return values; }
  ordered_json operator()(const domain::InsideGroup& group) const { return to_json(group); }
  ordered_json operator()(const domain::InsideValue::Items& items) const {
    ordered_json json = ordered_json::array();
    for (const domain::InsideGroup& item : items) json.push_back(to_json(item));
    return json;
  }
  ordered_json operator()(const domain::InsideGrid& grid) const {
    const std::size_t rows = grid.values.size() / grid.columns;
    ordered_json json = {{"columns", grid.columns},         {"rows", rows},
                         {"columns_are", grid.columns_are}, {"rows_are", grid.rows_are},
                         {"values", ordered_json::array()}, {"marked", nullptr}};
    for (auto row = grid.values.begin(); row != grid.values.end();) {
      const auto end = row + static_cast<std::ptrdiff_t>(grid.columns);
      json["values"].push_back(std::vector<double>(row, end));
      row = end;
    }
    if (grid.marked) json["marked"] = {*grid.marked / grid.columns, *grid.marked % grid.columns};
    return json;
  }
};

ordered_json place_json(const core::Vec2& place) {
  constexpr double kPerMetre = 1e4;
  return {std::round(place.x() * kPerMetre) / kPerMetre,
          std::round(place.y() * kPerMetre) / kPerMetre};
}

const char* kind_name(domain::PictureLayer::Kind kind) {
  switch (kind) {
    case domain::PictureLayer::Kind::kValues:
      return "values";
    case domain::PictureLayer::Kind::kBlocked:
      return "blocked";
    case domain::PictureLayer::Kind::kPoints:
      return "points";
    case domain::PictureLayer::Kind::kWay:
      return "way";
    case domain::PictureLayer::Kind::kGoal:
      return "goal";
  }
  return "points";
}

}  // namespace

ordered_json to_json(const domain::InsideGroup& group) {
  ordered_json json = ordered_json::object();
  for (const domain::InsideValue& value : group.values()) {
    const std::string key = value.unit.empty() ? value.name : value.name + '_' + value.unit;
    json[key] = std::visit(ValueToJson{}, value.value);
  }
  return json;
}

ordered_json to_json(const domain::Picture& picture) {
  ordered_json json = ordered_json::array();
  for (const domain::PictureLayer& layer : picture.layers) {
    ordered_json told = {{"name", layer.name}, {"kind", kind_name(layer.kind)}};
    told["places"] = ordered_json::array();
    for (const core::Vec2& place : layer.places_odom) told["places"].push_back(place_json(place));
    told["cells"] = ordered_json::array();
    for (const domain::PictureCell& cell : layer.cells) {
      ordered_json corners = ordered_json::array();
      for (const core::Vec2& corner : cell.corners_odom) corners.push_back(place_json(corner));
      told["cells"].push_back(
          {{"corners", corners}, {"value", std::round(cell.value * 1e4) / 1e4}});
    }
    json.push_back(std::move(told));
  }
  return json;
}

}  // namespace clew::insides
