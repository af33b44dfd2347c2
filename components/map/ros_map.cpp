// SPDX-License-Identifier: Apache-2.0
#include "map/ros_map.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/yaml_reader.hpp"
#include "map/pgm.hpp"

namespace clew::map {
namespace {

using core::Error;
using core::Result;
using core::YamlNode;

Result<double> number_in(const YamlNode& root, const char* key, double least, double greatest) {
  const auto node = root.at(key);
  if (!node.ok()) return node.error();
  const auto number = node->number();
  if (!number.ok()) return number.error();
  if (*number >= least && *number <= greatest) return *number;
  return node->error(
      fmt::format("{} is {}; allowed: {} to {}", key, node->found(), least, greatest));
}

/// What the map's own file says.
struct MapHead {
  double resolution_m = 0.0;
  Vec2 origin = Vec2::Zero();
  bool negate = false;
  double occupied_ratio = 0.0;
  double free_ratio = 0.0;
};

Result<void> check_mode(const YamlNode& root) {
  const auto mode = root.find("mode");
  if (!mode.has_value()) return {};
  const auto name = mode->string();
  if (name.ok() && *name == "trinary") return {};
  return mode->error("mode is " + mode->found() + "; allowed: trinary");
}

Result<Vec2> read_origin(const YamlNode& root) {
  const auto node = root.at("origin");
  if (!node.ok()) return node.error();
  const auto numbers = node->numbers(3, "[x, y, yaw]");
  if (!numbers.ok()) return numbers.error();
  if ((*numbers)[2] != 0.0) {
    return node->error(fmt::format("origin is turned by {} rad; allowed: 0", (*numbers)[2]));
  }
  return Vec2((*numbers)[0], (*numbers)[1]);
}

Result<bool> read_negate(const YamlNode& root) {
  const auto node = root.at("negate");
  if (!node.ok()) return node.error();
  const auto number = node->integer();
  if (number.ok() && (*number == 0 || *number == 1)) return *number == 1;
  return node->error("negate is " + node->found() + "; allowed: 0 or 1");
}

Result<MapHead> read_head(const core::Resource& file) {
  const auto root = YamlNode::parse(file.text, file.file);
  if (!root.ok()) return root.error();
  CLEW_RETURN_IF_ERROR(root->check_keys({"about", "image", "resolution", "origin", "negate",
                                         "occupied_thresh", "free_thresh", "mode"}));
  const auto image = root->at("image");
  if (!image.ok()) return image.error();
  CLEW_RETURN_IF_ERROR(check_mode(*root));
  const auto resolution_m = number_in(*root, "resolution", 0.001, 100.0);
  if (!resolution_m.ok()) return resolution_m.error();
  const auto origin = read_origin(*root);
  if (!origin.ok()) return origin.error();
  const auto negate = read_negate(*root);
  if (!negate.ok()) return negate.error();
  const auto occupied = number_in(*root, "occupied_thresh", 0.0, 1.0);
  if (!occupied.ok()) return occupied.error();
  const auto free = number_in(*root, "free_thresh", 0.0, 1.0);
  if (!free.ok()) return free.error();
  if (*free > *occupied) {
    return root->at("free_thresh")
        ->error(fmt::format("free_thresh is {}; allowed: at most occupied_thresh, {}", *free,
                            *occupied));
  }
  return MapHead{*resolution_m, *origin, *negate, *occupied, *free};
}

}  // namespace

Result<BlockedMap> read_ros_map(const core::Resource& file) {
  const auto head = read_head(file);
  if (!head.ok()) return head.error();
  const std::string image_file = "image of " + file.file;
  const auto picture = read_pgm(file.image, image_file);
  if (!picture.ok()) return picture.error();
  BlockedMap map{{head->origin, head->resolution_m, picture->columns, picture->rows}, {}};
  map.blocked.resize(map.grid.size());
  for (std::size_t i = 0; i < map.blocked.size(); ++i) {
    const Cell cell = map.grid.cell(i);
    const std::size_t pixel = map.grid.index({cell.column, map.grid.rows - 1 - cell.row});
    const double grey = picture->greys[pixel];
    const double occupied = (head->negate ? grey : picture->white - grey) / picture->white;
    map.blocked[i] = occupied < head->free_ratio ? 0 : 1;
  }
  return map;
}

}  // namespace clew::map
