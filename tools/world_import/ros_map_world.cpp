// SPDX-License-Identifier: Apache-2.0
#include "world_import/ros_map_world.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <system_error>

#include "core/angle.hpp"
#include "core/math.hpp"
#include "core/yaml_reader.hpp"
#include "world_import/picture_file.hpp"

namespace clew::world_import {
namespace {

using core::Error;
using core::Result;
using core::YamlNode;

enum class Mode { kTrinary, kScale, kRaw };

struct Head {
  std::string image;
  double resolution_m = 0.05;
  Pose2 origin;
  bool negate = false;
  double occupied = 0.65;
  double free = 0.25;
  Mode mode = Mode::kTrinary;
};

Result<double> number_in(const YamlNode& root, const char* key, double least, double greatest) {
  const auto node = root.at(key);
  if (!node.ok()) return node.error();
  const auto number = node->number();
  if (!number.ok()) return number.error();
  if (*number >= least && *number <= greatest) return *number;
  return node->error(fmt::format("{} is {}; allowed: {} to {}", key, *number, least, greatest));
}

Result<Mode> mode_in(const YamlNode& root) {
  const auto node = root.find("mode");
  if (!node) return Mode::kTrinary;
  const auto text = node->string();
  if (!text.ok()) return text.error();
  if (*text == "trinary") return Mode::kTrinary;
  if (*text == "scale") return Mode::kScale;
  if (*text == "raw") return Mode::kRaw;
  return node->error("mode is '" + *text + "'; allowed: trinary, scale, raw");
}

Result<bool> negate_in(const YamlNode& root) {
  const auto node = root.find("negate");
  if (!node) return false;
  // map_server writes 0 and 1; people write true and false, too.
  if (const auto truth = node->boolean(); truth.ok()) return *truth;
  const auto number = node->integer();
  if (number.ok() && (*number == 0 || *number == 1)) return *number == 1;
  return node->error("negate is " + node->found() + "; allowed: 0 and 1");
}

Result<Pose2> origin_in(const YamlNode& root) {
  const auto node = root.at("origin");
  if (!node.ok()) return node.error();
  const auto numbers = node->numbers(3, "[x, y, yaw]");
  if (!numbers.ok()) return numbers.error();
  return Pose2{(*numbers)[0], (*numbers)[1], core::wrap_angle_rad((*numbers)[2])};
}

Result<Head> read_head(const std::string& path) {
  const auto text = read_file(path);
  if (!text.ok()) return text.error();
  const auto root = YamlNode::parse(*text, path);
  if (!root.ok()) return root.error();
  CLEW_RETURN_IF_ERROR(root->check_keys(
      {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"}));
  Head head;
  const auto image = root->at("image");
  if (!image.ok()) return image.error();
  const auto name = image->string();
  if (!name.ok()) return name.error();
  head.image = (std::filesystem::path(path).parent_path() / *name).string();
  if (std::error_code code; !std::filesystem::exists(head.image, code)) {
    return image->error("there is no image '" + head.image + "'");
  }
  const auto resolution = number_in(*root, "resolution", 1e-3, 100.0);
  if (!resolution.ok()) return resolution.error();
  head.resolution_m = *resolution;
  const auto origin = origin_in(*root);
  if (!origin.ok()) return origin.error();
  head.origin = *origin;
  const auto negate = negate_in(*root);
  if (!negate.ok()) return negate.error();
  head.negate = *negate;
  const auto mode = mode_in(*root);
  if (!mode.ok()) return mode.error();
  head.mode = *mode;
  const auto occupied = number_in(*root, "occupied_thresh", 0.0, 1.0);
  if (!occupied.ok()) return occupied.error();
  head.occupied = *occupied;
  const auto free = number_in(*root, "free_thresh", 0.0, head.occupied);
  if (!free.ok()) return free.error();
  head.free = *free;
  return head;
}

CellState state_of(const Head& head, double brightness, double opacity) {
  constexpr double kWhite = 255.0;
  constexpr double kMostPercent = 100.0;
  if (head.mode == Mode::kRaw) {
    const double percent = std::round(brightness * kWhite);
    if (percent > kMostPercent) return CellState::kUnknown;
    if (percent >= head.occupied * kMostPercent) return CellState::kOccupied;
    return percent <= head.free * kMostPercent ? CellState::kFree : CellState::kUnknown;
  }
  const double darkness = head.negate ? brightness : 1.0 - brightness;
  if (head.mode == Mode::kScale && opacity < 1.0) return CellState::kUnknown;
  if (darkness > head.occupied) return CellState::kOccupied;
  if (darkness < head.free) return CellState::kFree;
  if (head.mode == Mode::kTrinary) return CellState::kUnknown;
  return 2.0 * darkness >= head.free + head.occupied ? CellState::kOccupied : CellState::kFree;
}

CellMap cells_of(const Head& head, const GreyPicture& picture) {
  CellMap map;
  map.columns = picture.columns;
  map.rows = picture.rows;
  map.cell_m = head.resolution_m;
  map.origin = head.origin;
  map.cells.reserve(picture.brightness.size());
  for (std::size_t row = picture.rows; row-- > 0;) {
    for (std::size_t column = 0; column < picture.columns; ++column) {
      const std::size_t pixel = row * picture.columns + column;
      map.cells.push_back(state_of(head, static_cast<double>(picture.brightness[pixel]),
                                   static_cast<double>(picture.opacity[pixel])));
    }
  }
  return map;
}

}  // namespace

Result<CellMap> read_ros_map_cells(const std::string& path) {
  const auto head = read_head(path);
  if (!head.ok()) return head.error();
  const auto picture = read_picture(head->image);
  if (!picture.ok()) return picture.error();
  return cells_of(*head, *picture);
}

Result<CellMap> read_picture_cells(const std::string& path, double cell_m) {
  const auto picture = read_picture(path);
  if (!picture.ok()) return picture.error();
  Head head;
  head.resolution_m = cell_m;
  head.occupied = head.free = 0.5;
  head.mode = Mode::kScale;
  return cells_of(head, *picture);
}

}  // namespace clew::world_import
