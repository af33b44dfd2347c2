// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace clew::plot {

/// A place in a picture, pixels right and down from its upper left corner.
struct Point {
  double x = 0.0;
  double y = 0.0;
};

/// How a shape is painted. Colours are SVG's: `#0072B2`, `none`.
struct Paint {
  std::string_view fill = "none";
  std::string_view stroke = "none";
  double stroke_width = 1.0;
  std::string_view dashes = {};  ///< SVG's stroke-dasharray; empty: solid
  double opacity = 1.0;
};

enum class Anchor { kStart, kMiddle, kEnd };

/// How a line of text is set.
struct TextStyle {
  double size_px = 12.0;
  Anchor anchor = Anchor::kStart;
  std::string_view colour = "#222222";
  bool bold = false;
  bool halo = false;  ///< white round the letters, where lines lie below them
};

/// Writes an SVG picture piece by piece. Numbers have at most two decimals and do not depend on the
/// locale: the same calls give the same bytes.
class SvgWriter {
 public:
  SvgWriter(double width_px, double height_px);

  void line(const Point& from, const Point& to, const Paint& paint);
  void circle(const Point& centre, double radius_px, const Paint& paint);
  void rectangle(const Point& upper_left, double width_px, double height_px, const Paint& paint);
  void polyline(const std::vector<Point>& points, const Paint& paint);
  void polygon(const std::vector<Point>& points, const Paint& paint);
  /// Lines between points[0] and [1], [2] and [3], and so on, as one shape.
  void segments(const std::vector<Point>& points, const Paint& paint);
  /// `anchor` of the text is at `at`, which lies on its base line.
  void text(const Point& at, std::string_view text, const TextStyle& style = {});

  /// What is written until end_group belongs together, under a name for those who edit the file.
  void begin_group(std::string_view name);
  void end_group();

  /// The whole picture; nothing may be written after it.
  std::string finish() &&;

 private:
  void attribute(std::string_view name, double value);
  void attribute(std::string_view name, std::string_view value);
  void move_and_draw(std::string_view command, const Point& to);
  void paint(const Paint& paint);

  std::string out_;
};

/// A number with at most two decimals: `12.5`, `-0.25`, `3`.
std::string short_number(double value);

}  // namespace clew::plot
