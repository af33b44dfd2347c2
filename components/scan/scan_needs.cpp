// SPDX-License-Identifier: Apache-2.0
#include "scan/scan_needs.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/angle.hpp"

namespace clew::scan {
namespace {

// A beam may lie this far from where it is said to be.
constexpr double kTolerance_rad = core::radians(0.1);
// An angle of a config file is rounded when it becomes radians.
constexpr double kRounding_rad = 1e-9;

bool at_most(double angle_rad, double most_rad) { return angle_rad <= most_rad + kTolerance_rad; }
bool at_least(double angle_rad, double least_rad) {
  return angle_rad >= least_rad - kTolerance_rad;
}

bool are_close(const ScanNeeds& needs, const domain::ScanLayout& layout) {
  if (layout.beam_count < 2) return true;
  return at_most(std::fabs(layout.bearing_step_rad), needs.most_apart_rad) &&
         at_most(layout.between_beams_rad(), needs.most_unseen_rad);
}

bool reach_far_enough(const ScanNeeds& needs, const domain::ScanLayout& layout) {
  const double half_width_rad = 0.5 * layout.beam_width_rad;
  for (const double side_rad : {layout.leftmost_rad(), -layout.rightmost_rad()}) {
    if (needs.least_axis_rad > 0.0 && !at_least(side_rad, needs.least_axis_rad)) return false;
    if (needs.least_seen_rad > 0.0 && !at_least(side_rad + half_width_rad, needs.least_seen_rad)) {
      return false;
    }
  }
  return layout.field_rad() >= needs.least_field_rad - kRounding_rad;
}

std::string text_of(const ScanNeeds& needs) {
  std::string text;
  const auto add = [&](const std::string& need) { text += (text.empty() ? "" : ", ") + need; };
  if (needs.least_beams > 1) add(fmt::format("{} beams or more", needs.least_beams));
  if (std::isfinite(needs.most_apart_rad)) {
    add(fmt::format("at most {:.4g} degrees from beam to beam",
                    core::degrees(needs.most_apart_rad)));
  }
  if (std::isfinite(needs.most_unseen_rad)) {
    add(fmt::format("at most {:.4g} degrees unseen between beams",
                    core::degrees(needs.most_unseen_rad)));
  }
  if (needs.least_axis_rad > 0.0) {
    add(fmt::format("beams out to {:.4g} degrees on each side",
                    core::degrees(needs.least_axis_rad)));
  }
  if (needs.least_seen_rad > 0.0) {
    add(fmt::format("a view out to {:.4g} degrees on each side",
                    core::degrees(needs.least_seen_rad)));
  }
  if (needs.least_field_rad > 0.0) {
    add(fmt::format("a field of view of {:.4g} degrees", core::degrees(needs.least_field_rad)));
    if (!needs.field_reason.empty()) text += " (" + needs.field_reason + ')';
  }
  return text;
}

}  // namespace

core::Result<void> check_needs(const ScanNeeds& needs, const domain::ScanLayout& layout,
                               const std::string& behaviour) {
  const bool fits = layout.beam_count >= needs.least_beams && are_close(needs, layout) &&
                    reach_far_enough(needs, layout);
  if (fits) return {};
  return core::Error{fmt::format(
      "{} needs {}; '{}' gives {} beams of {:.4g} degrees, {:.4g} degrees apart from "
      "{:.4g} on",
      behaviour, text_of(needs), layout.sensor, layout.beam_count,
      core::degrees(layout.beam_width_rad), core::degrees(std::fabs(layout.bearing_step_rad)),
      core::degrees(layout.bearing_first_rad))};
}

}  // namespace clew::scan
