// SPDX-License-Identifier: Apache-2.0
#include "plot/svg_writer.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

namespace clew::plot {
namespace {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      // XML has no control characters.
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

std::string_view anchor_name(Anchor anchor) {
  switch (anchor) {
    case Anchor::kStart:
      return "start";
    case Anchor::kMiddle:
      return "middle";
    case Anchor::kEnd:
      break;
  }
  return "end";
}

}  // namespace

std::string short_number(double value) {
  const std::int64_t hundredths = std::llround(value * 100.0);
  const std::int64_t magnitude = hundredths < 0 ? -hundredths : hundredths;
  std::string text = hundredths < 0 ? "-" : "";
  text += std::to_string(magnitude / 100);
  if (magnitude % 100 == 0) return text;
  text += '.';
  text += static_cast<char>('0' + magnitude / 10 % 10);
  if (magnitude % 10 != 0) text += static_cast<char>('0' + magnitude % 10);
  return text;
}

SvgWriter::SvgWriter(double width_px, double height_px) {
  const std::string width = short_number(width_px);
  const std::string height = short_number(height_px);
  out_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"";
  out_ += " width=\"" + width + "\" height=\"" + height + "\" viewBox=\"0 0 " + width + ' ' +
          height + "\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n";
  rectangle({0.0, 0.0}, width_px, height_px, {"#FFFFFF"});
}

void SvgWriter::attribute(std::string_view name, double value) {
  attribute(name, short_number(value));
}

void SvgWriter::attribute(std::string_view name, std::string_view value) {
  out_ += ' ';
  out_ += name;
  out_ += "=\"";
  out_ += value;
  out_ += '"';
}

void SvgWriter::paint(const Paint& paint) {
  attribute("fill", paint.fill);
  if (paint.stroke != "none") {
    attribute("stroke", paint.stroke);
    attribute("stroke-width", paint.stroke_width);
    attribute("stroke-linejoin", "round");
    attribute("stroke-linecap", paint.dashes.empty() ? "round" : "butt");
  }
  if (!paint.dashes.empty()) attribute("stroke-dasharray", paint.dashes);
  if (paint.opacity < 1.0) attribute("opacity", paint.opacity);
  out_ += "/>\n";
}

void SvgWriter::line(const Point& from, const Point& to, const Paint& style) {
  segments({from, to}, style);
}

void SvgWriter::circle(const Point& centre, double radius_px, const Paint& style) {
  out_ += "<circle";
  attribute("cx", centre.x);
  attribute("cy", centre.y);
  attribute("r", radius_px);
  paint(style);
}

void SvgWriter::rectangle(const Point& upper_left, double width_px, double height_px,
                          const Paint& style) {
  out_ += "<rect";
  attribute("x", upper_left.x);
  attribute("y", upper_left.y);
  attribute("width", width_px);
  attribute("height", height_px);
  paint(style);
}

void SvgWriter::move_and_draw(std::string_view command, const Point& to) {
  out_ += command;
  out_ += short_number(to.x);
  out_ += ' ';
  out_ += short_number(to.y);
}

void SvgWriter::polyline(const std::vector<Point>& points, const Paint& style) {
  out_ += "<path d=\"";
  for (std::size_t i = 0; i < points.size(); ++i) move_and_draw(i == 0 ? "M" : "L", points[i]);
  out_ += '"';
  paint(style);
}

void SvgWriter::polygon(const std::vector<Point>& points, const Paint& style) {
  out_ += "<path d=\"";
  for (std::size_t i = 0; i < points.size(); ++i) move_and_draw(i == 0 ? "M" : "L", points[i]);
  out_ += "Z\"";
  paint(style);
}

void SvgWriter::segments(const std::vector<Point>& points, const Paint& style) {
  out_ += "<path d=\"";
  for (std::size_t i = 0; i + 1 < points.size(); i += 2) {
    move_and_draw("M", points[i]);
    move_and_draw("L", points[i + 1]);
  }
  out_ += '"';
  paint(style);
}

void SvgWriter::text(const Point& at, std::string_view text, const TextStyle& style) {
  out_ += "<text";
  attribute("x", at.x);
  attribute("y", at.y);
  attribute("font-size", style.size_px);
  if (style.anchor != Anchor::kStart) attribute("text-anchor", anchor_name(style.anchor));
  if (style.bold) attribute("font-weight", "bold");
  attribute("fill", style.colour);
  out_ += '>' + escaped(text) + "</text>\n";
}

void SvgWriter::begin_group(std::string_view name) { out_ += "<g id=\"" + escaped(name) + "\">\n"; }

void SvgWriter::end_group() { out_ += "</g>\n"; }

std::string SvgWriter::finish() && {
  out_ += "</svg>\n";
  return std::move(out_);
}

}  // namespace clew::plot
