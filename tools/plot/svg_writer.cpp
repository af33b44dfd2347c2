// SPDX-License-Identifier: Apache-2.0
#include "plot/svg_writer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace clew::plot {
namespace {

/// How many bytes a character of UTF-8 that begins here has; 0 if none begins here.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  // Longer than it must be, half of a surrogate pair, or beyond the last character.
  const bool is_none = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xED && byte(1) > 0x9F) ||
                       (first == 0xF0 && byte(1) < 0x90) || (first == 0xF4 && byte(1) > 0x8F);
  return is_none ? 0 : length;
}

/// Text, of a file's name for instance, that XML can hold: what is no UTF-8 becomes U+FFFD.
std::string escaped(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length != 1) {
      length == 0 ? out += "\xEF\xBF\xBD" : out += text.substr(0, length);
      text.remove_prefix(std::max<std::size_t>(length, 1));
      continue;
    }
    const char c = text.front();
    text.remove_prefix(1);
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
  if (style.halo) {
    attribute("stroke", "#FFFFFF");
    attribute("stroke-width", 3.0);
    attribute("stroke-linejoin", "round");
    attribute("paint-order", "stroke");
  }
  out_ += '>' + escaped(text) + "</text>\n";
}

void SvgWriter::begin_group(std::string_view name) { out_ += "<g id=\"" + escaped(name) + "\">\n"; }

void SvgWriter::end_group() { out_ += "</g>\n"; }

std::string SvgWriter::finish() && {
  out_ += "</svg>\n";
  return std::move(out_);
}

}  // namespace clew::plot
