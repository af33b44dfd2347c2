// SPDX-License-Identifier: Apache-2.0
#include "plot/line_chart.hpp"

#include <algorithm>
#include <cmath>

#include "plot/palette.hpp"

namespace clew::plot {
namespace {

constexpr double kWidthPx = 860.0;
constexpr double kHeightPx = 480.0;
constexpr double kLeftPx = 70.0;
constexpr double kRightPx = 600.0;
constexpr double kTopPx = 60.0;
constexpr double kBottomPx = 420.0;
constexpr double kLegendLeftPx = kRightPx + 24.0;
constexpr double kEntryPx = 22.0;
constexpr double kTicks = 5.0;

/// 1, 2 or 5 times a power of ten: the step of about kTicks ticks up to `most`.
double tick_step(double most) {
  double step = 1.0;
  while (step * kTicks < most) step *= 10.0;
  while (step * kTicks >= 10.0 * most) step /= 10.0;
  if (step * kTicks >= 5.0 * most) return step / 5.0;
  if (step * kTicks >= 2.0 * most) return step / 2.0;
  return step;
}

/// A tick's number with as many decimals as its step needs.
std::string tick_text(double value, double step) {
  int decimals = 0;
  for (double unit = 1.0; step < unit * 0.999 && decimals < 6; unit /= 10.0) ++decimals;
  std::string text = std::to_string(value);  // six decimals
  text.resize(text.size() - 6 + static_cast<std::size_t>(decimals));
  if (decimals == 0) text.pop_back();
  return text;
}

class ChartPainter {
 public:
  explicit ChartPainter(const LineChart& chart) : chart_(chart), svg_(kWidthPx, kHeightPx) {
    for (const ChartLine& line : chart.lines) {
      for (const Point& point : line.points) {
        most_.x = std::max(most_.x, point.x);
        most_.y = std::max(most_.y, point.y);
        least_y_ = std::min(least_y_, point.y);
      }
    }
    for (const ChartLevel& level : chart.levels) most_.y = std::max(most_.y, level.y);
    if (most_.x <= 0.0) most_.x = 1.0;
    if (most_.y <= least_y_) most_.y = least_y_ + 1.0;
  }

  std::string draw() && {
    svg_.text({kLeftPx, 30}, chart_.title, {18, Anchor::kStart, kBlack, true});
    draw_axes();
    std::size_t entry = 0;
    for (const ChartLevel& level : chart_.levels) draw_level(level, entry++);
    for (const ChartLine& line : chart_.lines) draw_line(line, entry++);
    return std::move(svg_).finish();
  }

 private:
  double x_px(double x) const { return kLeftPx + x / most_.x * (kRightPx - kLeftPx); }
  double y_px(double y) const {
    return kBottomPx - (y - least_y_) / (most_.y - least_y_) * (kBottomPx - kTopPx);
  }

  void draw_axes() {
    const double x_step = tick_step(most_.x);
    for (double i = 0.0; i * x_step <= most_.x; ++i) {
      const double x = x_px(i * x_step);
      svg_.line({x, kTopPx}, {x, kBottomPx}, {"none", kGridGrey});
      svg_.text({x, kBottomPx + 18}, tick_text(i * x_step, x_step), {12, Anchor::kMiddle});
    }
    const double y_step = tick_step(most_.y - least_y_);
    for (double i = std::ceil(least_y_ / y_step); i * y_step <= most_.y; ++i) {
      const double y = y_px(i * y_step);
      svg_.line({kLeftPx, y}, {kRightPx, y}, {"none", kGridGrey});
      svg_.text({kLeftPx - 8, y + 4}, tick_text(i * y_step, y_step), {12, Anchor::kEnd});
    }
    svg_.line({kLeftPx, kTopPx}, {kLeftPx, kBottomPx}, {"none", kWallGrey});
    svg_.line({kLeftPx, kBottomPx}, {kRightPx, kBottomPx}, {"none", kWallGrey});
    svg_.text({0.5 * (kLeftPx + kRightPx), kBottomPx + 40}, chart_.x_label, {13, Anchor::kMiddle});
    svg_.text({kLeftPx, kTopPx - 10}, chart_.y_label, {13});
  }

  void draw_level(const ChartLevel& level, std::size_t entry) {
    const Paint paint{"none", run_colour(entry), 1.5, "6 4"};
    svg_.line({kLeftPx, y_px(level.y)}, {kRightPx, y_px(level.y)}, paint);
    name(level.name, paint, entry);
  }

  void draw_line(const ChartLine& line, std::size_t entry) {
    const Paint paint{"none", run_colour(entry), 2.0};
    std::vector<Point> points;
    for (const Point& point : line.points) points.push_back({x_px(point.x), y_px(point.y)});
    svg_.polyline(points, paint);
    name(line.name, paint, entry);
  }

  void name(const std::string& text, const Paint& paint, std::size_t entry) {
    const double y = kTopPx + kEntryPx * static_cast<double>(entry);
    svg_.line({kLegendLeftPx, y}, {kLegendLeftPx + 26, y}, paint);
    svg_.text({kLegendLeftPx + 34, y + 4}, text);
  }

  const LineChart& chart_;
  SvgWriter svg_;
  Point most_;
  double least_y_ = 0.0;
};

}  // namespace

std::string draw(const LineChart& chart) { return ChartPainter(chart).draw(); }

}  // namespace clew::plot
