// SPDX-License-Identifier: Apache-2.0
/// Quantities as people say them, for the sentences of Inside.
#pragma once

#include <string>

#include "domain/messages.hpp"

namespace clew::domain {

/// `0.42 m`
std::string say_metres(double value_m);
/// `15 degrees`, without a sign
std::string say_degrees(double angle_rad);
/// `15 degrees left`, `straight ahead`, `straight behind`
std::string say_bearing(double bearing_rad);
/// `80 %` of 0.8
std::string say_percent(double ratio);
/// `12.5 s`
std::string say_seconds(double value_s);
/// With two decimals and no unit.
std::string say_number(double value);
/// `1 beam`, `3 beams`
std::string say_count(std::size_t count, const std::string& thing);
/// `(1.20, -3.40)`
std::string say_place(const core::Vec2& place);
/// `turn 12 degrees left and step 0.10 m`
std::string say_motion(const Motion& motion);

}  // namespace clew::domain
