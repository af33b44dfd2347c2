// SPDX-License-Identifier: Apache-2.0
/// Colours that people with any kind of colour vision tell apart (Okabe & Ito 2008, "Color
/// universal design"), and the greys of the world.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace clew::plot {

inline constexpr std::string_view kBlack = "#000000";
inline constexpr std::string_view kOrange = "#E69F00";
inline constexpr std::string_view kSkyBlue = "#56B4E9";
inline constexpr std::string_view kGreen = "#009E73";
inline constexpr std::string_view kYellow = "#F0E442";
inline constexpr std::string_view kBlue = "#0072B2";
inline constexpr std::string_view kVermilion = "#D55E00";
inline constexpr std::string_view kPurple = "#CC79A7";
inline constexpr std::string_view kWhite = "#FFFFFF";

inline constexpr std::string_view kGridGrey = "#EEEEEE";
inline constexpr std::string_view kObstacleGrey = "#C8C8C8";
inline constexpr std::string_view kMovingGrey = "#8A8A8A";
inline constexpr std::string_view kWallGrey = "#3C3C3C";

/// The path's colour of the first, second, ... run in one picture.
inline constexpr std::array<std::string_view, 6> kRunColours = {kBlue,   kVermilion, kGreen,
                                                                kPurple, kOrange,    kBlack};
inline std::string_view run_colour(std::size_t run) {
  return kRunColours[run % kRunColours.size()];
}

}  // namespace clew::plot
