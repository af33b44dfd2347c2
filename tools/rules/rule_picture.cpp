// SPDX-License-Identifier: Apache-2.0
#include "rules/rule_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "plot/palette.hpp"
#include "plot/svg_writer.hpp"

namespace clew::rules {
namespace {

using plot::Anchor;
using plot::Point;
using plot::SvgWriter;

// Pixels.
constexpr double kWidth = 1000.0;
constexpr double kMargin = 24.0;
constexpr double kTitle = 40.0;
constexpr double kHeading = 34.0;
constexpr double kSetWidth = 480.0;
constexpr double kSetHeight = 162.0;
constexpr double kSetTop = 44.0;  ///< for the variable's name, and two lines of names of sets
constexpr double kSurfaceWidth = 480.0;
constexpr double kSurfaceHeight = 400.0;
constexpr double kSide = 280.0;  ///< of a surface
constexpr std::size_t kColumns = 2;

constexpr std::array<std::string_view, 6> kColours = {
    plot::kBlue, plot::kVermilion, plot::kGreen, plot::kPurple, plot::kOrange, plot::kBlack};
/// Told apart in grey, too.
constexpr std::array<std::string_view, 6> kDashes = {"", "7,3", "2,3", "9,3,2,3", "4,2", "1,2"};

std::size_t rows_of(std::size_t count) { return (count + kColumns - 1) / kColumns; }

double height_of(const RuleBase& base) {
  return kHeading + static_cast<double>(rows_of(base.variables.size())) * kSetHeight +
         static_cast<double>(rows_of(base.surfaces.size())) * kSurfaceHeight;
}

std::string label_of(const Axis& axis) {
  return axis.unit.empty() ? axis.name : axis.name + ", " + axis.unit;
}

/// The name of a set stands at the middle of where it is fullest.
double middle_of(const FuzzySet& set) {
  const double most = *std::max_element(set.degrees.begin(), set.degrees.end());
  double first = -1.0;
  double last = 0.0;
  for (std::size_t i = 0; i < set.degrees.size(); ++i) {
    if (set.degrees[i] < most - 1e-9) continue;
    if (first < 0.0) first = static_cast<double>(i);
    last = static_cast<double>(i);
  }
  return 0.5 * (first + last) / static_cast<double>(set.degrees.size() - 1);
}

void draw_axis(SvgWriter& svg, const Axis& axis, const Point& lower_left, double width) {
  svg.line(lower_left, {lower_left.x + width, lower_left.y}, {"none", plot::kWallGrey});
  for (int i = 0; i <= 4; ++i) {
    const double share = 0.25 * i;
    const double x = lower_left.x + share * width;
    svg.line({x, lower_left.y}, {x, lower_left.y + 4.0}, {"none", plot::kWallGrey});
    svg.text({x, lower_left.y + 16.0},
             fmt::format("{:.4g}", axis.low + share * (axis.high - axis.low)),
             {11.0, Anchor::kMiddle});
  }
}

void draw_sets(SvgWriter& svg, const Variable& variable, const Point& at) {
  const double width = kSetWidth - 50.0;
  const double height = kSetHeight - kSetTop - 44.0;
  const Point lower_left{at.x + 14.0, at.y + kSetTop + height};
  svg.begin_group(variable.axis.name);
  svg.text({lower_left.x, at.y + 12.0}, label_of(variable.axis),
           {12.0, Anchor::kStart, "#222222", true});
  draw_axis(svg, variable.axis, lower_left, width);
  for (std::size_t s = 0; s < variable.sets.size(); ++s) {
    const FuzzySet& set = variable.sets[s];
    const std::string_view colour = kColours[s % kColours.size()];
    std::vector<Point> points;
    for (std::size_t i = 0; i < set.degrees.size(); ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(set.degrees.size() - 1);
      points.push_back({lower_left.x + share * width, lower_left.y - set.degrees[i] * height});
    }
    svg.polyline(points, {"none", colour, 2.0, kDashes[s % kDashes.size()]});
    // Neighbours may be full side by side: their names take turns in height.
    const double lift = s % 2 == 0 ? 4.0 : 15.0;
    svg.text({lower_left.x + middle_of(set) * width, lower_left.y - height - lift}, set.name,
             {11.0, Anchor::kMiddle, colour});
  }
  svg.end_group();
}

/// From white at 0 to blue at the most; to vermilion at the least, if that is below 0.
std::string colour_of(double value, double most) {
  const double share = most > 0.0 ? std::min(1.0, std::fabs(value) / most) : 0.0;
  const std::array<double, 3> full = value >= 0.0 ? std::array<double, 3>{0.0, 90.0, 160.0}
                                                  : std::array<double, 3>{213.0, 94.0, 0.0};
  std::string colour = "#";
  for (const double part : full) {
    colour += fmt::format("{:02X}", static_cast<int>(std::lround(255.0 + share * (part - 255.0))));
  }
  return colour;
}

void draw_scale(SvgWriter& svg, const Surface& surface, double least, double most,
                const Point& upper_left) {
  constexpr int kSteps = 40;
  const double largest = std::max(std::fabs(least), std::fabs(most));
  for (int i = 0; i < kSteps; ++i) {
    const double value = most + (least - most) * (i + 0.5) / kSteps;
    svg.rectangle({upper_left.x, upper_left.y + kSide * i / kSteps}, 14.0, kSide / kSteps + 0.5,
                  {colour_of(value, largest)});
  }
  for (int i = 0; i <= 4; ++i) {
    svg.text({upper_left.x + 20.0, upper_left.y + 0.25 * i * kSide + 4.0},
             fmt::format("{:.3g}", most + 0.25 * i * (least - most)), {11.0});
  }
  svg.text({upper_left.x, upper_left.y - 10.0}, surface.unit, {11.0});
}

void draw_cells(SvgWriter& svg, const Surface& surface, double largest, const Point& upper_left) {
  const std::size_t rows = surface.values.size() / surface.columns;
  const double width = kSide / static_cast<double>(surface.columns);
  const double height = kSide / static_cast<double>(rows);
  for (std::size_t i = 0; i < surface.values.size(); ++i) {
    const auto column = static_cast<double>(i % surface.columns);
    const auto row = static_cast<double>(rows - 1 - i / surface.columns);
    // A little larger, so that nothing shows between two.
    svg.rectangle({upper_left.x + column * width, upper_left.y + row * height}, width + 0.3,
                  height + 0.3, {colour_of(surface.values[i], largest)});
  }
  svg.rectangle(upper_left, kSide, kSide, {"none", plot::kWallGrey});
}

void draw_surface(SvgWriter& svg, const Surface& surface, const Point& at) {
  const auto [least, most] = std::minmax_element(surface.values.begin(), surface.values.end());
  const Point upper_left{at.x + 60.0, at.y + 52.0};
  svg.begin_group(surface.name);
  svg.text({at.x + 14.0, at.y + 14.0}, surface.name, {12.0, Anchor::kStart, "#222222", true});
  if (!surface.given.empty())
    svg.text({at.x + 14.0, at.y + 30.0}, "where " + surface.given, {11.0});
  draw_cells(svg, surface, std::max(std::fabs(*least), std::fabs(*most)), upper_left);
  draw_axis(svg, surface.across, {upper_left.x, upper_left.y + kSide}, kSide);
  svg.text({upper_left.x + 0.5 * kSide, upper_left.y + kSide + 34.0}, label_of(surface.across),
           {11.0, Anchor::kMiddle});
  for (int i = 0; i <= 4; ++i) {
    const double share = 0.25 * i;
    svg.text({upper_left.x - 6.0, upper_left.y + (1.0 - share) * kSide + 4.0},
             fmt::format("{:.4g}", surface.up.low + share * (surface.up.high - surface.up.low)),
             {11.0, Anchor::kEnd});
  }
  svg.text({upper_left.x - 46.0, upper_left.y - 8.0}, "up: " + label_of(surface.up), {11.0});
  draw_scale(svg, surface, *least, *most, {upper_left.x + kSide + 24.0, upper_left.y});
  svg.end_group();
}

double draw_base(SvgWriter& svg, const RuleBase& base, double y) {
  svg.text({kMargin, y + 20.0}, fmt::format("{}: {}", base.stage, base.name),
           {15.0, Anchor::kStart, "#222222", true});
  y += kHeading;
  const auto place = [&](std::size_t i, double width, double height) {
    return Point{kMargin + static_cast<double>(i % kColumns) * width,
                 y + static_cast<double>(i / kColumns) * height};
  };
  for (std::size_t i = 0; i < base.variables.size(); ++i) {
    draw_sets(svg, base.variables[i], place(i, kSetWidth, kSetHeight));
  }
  y += static_cast<double>(rows_of(base.variables.size())) * kSetHeight;
  for (std::size_t i = 0; i < base.surfaces.size(); ++i) {
    draw_surface(svg, base.surfaces[i], place(i, kSurfaceWidth, kSurfaceHeight));
  }
  return y + static_cast<double>(rows_of(base.surfaces.size())) * kSurfaceHeight;
}

}  // namespace

std::string draw(const std::string& graph, const std::vector<RuleBase>& bases) {
  double height = kTitle + kMargin;
  for (const RuleBase& base : bases) height += height_of(base);
  SvgWriter svg(kWidth, height);
  svg.rectangle({0.0, 0.0}, kWidth, height, {plot::kWhite});
  svg.text({kMargin, 30.0}, "Rule bases of " + graph, {18.0, Anchor::kStart, "#222222", true});
  double y = kTitle;
  for (const RuleBase& base : bases) y = draw_base(svg, base, y);
  return std::move(svg).finish();
}

}  // namespace clew::rules
