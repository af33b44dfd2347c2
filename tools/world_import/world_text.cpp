// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/quoted.hpp"
#include "world_import/world_draft.hpp"

namespace clew::world_import {
namespace {

std::string point(const Vec2& place) { return fmt::format("[{}, {}]", place.x(), place.y()); }

}  // namespace

std::string world_text(const WorldDraft& draft) {
  std::string text = fmt::format(
      "format: clew-world/1\nname: {}\nabout: {}\nbounds: [{}, {}, {}, {}]\n",
      core::yaml_quoted(draft.name), core::yaml_quoted(draft.about), draft.bounds_min.x(),
      draft.bounds_min.y(), draft.bounds_max.x(), draft.bounds_max.y());
  const auto list = [&](const char* key, const auto& items, const auto& item_text) {
    if (items.empty()) return;
    text += std::string(key) + ": [\n";
    for (const auto& item : items) text += "  " + item_text(item) + ",\n";
    text.erase(text.size() - 2, 1);
    text += "]\n";
  };
  list("polygons", draft.polygons, [](const std::vector<Vec2>& polygon) {
    std::string line = "[";
    for (const Vec2& corner : polygon) line += point(corner) + ", ";
    line.resize(line.size() - 2);
    return line + ']';
  });
  list("circles", draft.circles, [](const WorldDraft::Circle& circle) {
    return fmt::format("[{}, {}, {}]", circle.centre.x(), circle.centre.y(), circle.radius_m);
  });
  text += fmt::format("start: [{}, {}, {}]\n", draft.start->x_m, draft.start->y_m,
                      draft.start->heading_rad);
  text += "target: " + point(*draft.target) + '\n';
  text += fmt::format("target_radius: {}\n", draft.target_radius_m);
  return text;
}

}  // namespace clew::world_import
