// SPDX-License-Identifier: Apache-2.0
#include "ros2/run_markers.hpp"

#include <fmt/format.h>

#include <optional>

namespace clew::ros2 {
namespace {

struct Look {
  const char* name_space;
  std::int32_t type;
  double size_m;
  ColorRGBA color;
};

std::optional<Look> look_of(const domain::EventEntry& entry) {
  switch (entry.kind) {
    case domain::EventKind::kTrap:
      return Look{entry.shadow ? "traps in shadow" : "traps",
                  Marker::kSphere,
                  0.2,
                  {0.85F, 0.15F, 0.1F, entry.shadow ? 0.4F : 0.9F}};
    case domain::EventKind::kVirtualTarget:
      return Look{"virtual targets", Marker::kCylinder, 0.2, {0.1F, 0.3F, 0.9F, 0.8F}};
    case domain::EventKind::kLandmark:
      return Look{"landmarks", Marker::kCube, 0.08, {0.1F, 0.6F, 0.2F, 0.8F}};
    default:
      return std::nullopt;
  }
}

const char* words_of(domain::EventKind kind) {
  switch (kind) {
    case domain::EventKind::kLandmark:
      return "landmark recognised";
    case domain::EventKind::kReflex:
      return "reflex";
    case domain::EventKind::kTrap:
      return "trap";
    case domain::EventKind::kEscapeBegun:
      return "escape begun";
    case domain::EventKind::kEscapeEnded:
      return "escape ended";
    case domain::EventKind::kEscapeFailed:
      return "escape failed";
    case domain::EventKind::kVirtualTarget:
      return "virtual target set";
    case domain::EventKind::kUnreachable:
      return "target unreachable";
  }
  return "event";
}

bool is_warning(domain::EventKind kind) {
  return kind == domain::EventKind::kTrap || kind == domain::EventKind::kEscapeFailed ||
         kind == domain::EventKind::kUnreachable;
}

}  // namespace

void RunMarkers::add(const domain::TickStamp& stamp, const domain::EventEntry& entry) {
  const auto look = look_of(entry);
  if (!look) return;
  Marker marker;
  marker.header = {to_time(stamp.sim_time_s), frame_};
  marker.ns = look->name_space;
  marker.id = next_id_++;
  marker.type = look->type;
  marker.action = Marker::kAdd;
  marker.pose = to_pose({entry.x_m, entry.y_m, 0.0});
  marker.scale = {look->size_m, look->size_m, look->size_m};
  marker.color = look->color;
  marker.text = entry.rule;
  std::deque<Marker>& of_a_kind = markers_[marker.ns];
  if (of_a_kind.size() >= kMostOfAKind) of_a_kind.pop_front();
  of_a_kind.push_back(std::move(marker));
  changed_ = true;
}

MarkerArray RunMarkers::all() {
  MarkerArray array;
  Marker& clear = array.markers.emplace_back();
  clear.header.frame_id = frame_;
  clear.action = Marker::kDeleteAll;
  for (const auto& [name, markers] : markers_) {
    array.markers.insert(array.markers.end(), markers.begin(), markers.end());
  }
  changed_ = false;
  return array;
}

Log to_log(const domain::TickStamp& stamp, const domain::EventEntry& entry,
           const std::string& node) {
  Log log;
  log.stamp = to_time(stamp.sim_time_s);
  log.level = is_warning(entry.kind) && !entry.shadow ? Log::kWarn : Log::kInfo;
  log.name = node;
  log.msg = fmt::format("tick {}: {}{} ({}) at ({:.2f}, {:.2f}){}{}", stamp.tick,
                        words_of(entry.kind), entry.shadow ? ", in shadow" : "", entry.rule,
                        entry.x_m, entry.y_m, entry.text.empty() ? "" : ": ", entry.text);
  return log;
}

}  // namespace clew::ros2
