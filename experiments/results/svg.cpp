#include "experiments/results/svg.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace deliso {
namespace {

// Hundredths of a pixel are enough; no "-0", no trailing zeros.
std::string pixels(double value) {
  std::array<char, 40> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.2f", value);
  std::string text = buffer.data();
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string attribute(std::string_view name, std::string_view value) {
  return std::string(" ").append(name).append("=\"").append(value).append("\"");
}

std::string stroke_attributes(const SvgStroke& stroke) {
  return attribute("stroke", stroke.color) + attribute("stroke-width", pixels(stroke.width));
}

std::string point_list(std::span<const SvgPoint> points) {
  std::string list;
  for (const SvgPoint& p : points) list += (list.empty() ? "" : " ") + pixels(p.x) + "," + pixels(p.y);
  return list;
}

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      default:
        safe += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return safe;
}

}  // namespace

SvgDrawing::SvgDrawing(double width, double height) : width_(width), height_(height) {
  rectangle({0, 0}, width, height, "#ffffff");
}

void SvgDrawing::line(SvgPoint from, SvgPoint to, const SvgStroke& stroke) {
  body_ += "<line" + attribute("x1", pixels(from.x)) + attribute("y1", pixels(from.y)) + attribute("x2", pixels(to.x)) +
           attribute("y2", pixels(to.y)) + stroke_attributes(stroke) + "/>\n";
}

void SvgDrawing::polyline(std::span<const SvgPoint> points, const SvgStroke& stroke) {
  body_ += "<polyline" + attribute("points", point_list(points)) + attribute("fill", "none") +
           attribute("stroke-linejoin", "round") + stroke_attributes(stroke) + "/>\n";
}

void SvgDrawing::polygon(std::span<const SvgPoint> points, std::string_view fill, double opacity) {
  body_ += "<polygon" + attribute("points", point_list(points)) + attribute("fill", fill) +
           (opacity < 1 ? attribute("fill-opacity", pixels(opacity)) : "") + "/>\n";
}

void SvgDrawing::rectangle(SvgPoint corner, double width, double height, std::string_view fill) {
  body_ += "<rect" + attribute("x", pixels(corner.x)) + attribute("y", pixels(corner.y)) +
           attribute("width", pixels(width)) + attribute("height", pixels(height)) + attribute("fill", fill) + "/>\n";
}

void SvgDrawing::circle(SvgPoint center, double radius, std::string_view fill) {
  body_ += "<circle" + attribute("cx", pixels(center.x)) + attribute("cy", pixels(center.y)) +
           attribute("r", pixels(radius)) + attribute("fill", fill) + "/>\n";
}

void SvgDrawing::text(SvgPoint at, std::string_view text, const SvgFont& font) {
  body_ += "<text" + attribute("x", pixels(at.x)) + attribute("y", pixels(at.y)) +
           attribute("font-size", pixels(font.size)) + attribute("text-anchor", font.anchor);
  if (font.bold) body_ += attribute("font-weight", "bold");
  if (font.upwards) body_ += attribute("transform", "rotate(-90 " + pixels(at.x) + " " + pixels(at.y) + ")");
  body_ += ">" + escaped(text) + "</text>\n";
}

std::string SvgDrawing::document() const {
  return "<svg" + attribute("xmlns", "http://www.w3.org/2000/svg") + attribute("width", pixels(width_)) +
         attribute("height", pixels(height_)) + attribute("viewBox", "0 0 " + pixels(width_) + " " + pixels(height_)) +
         attribute("font-family", "Helvetica, Arial, 'DejaVu Sans', sans-serif") + ">\n" + body_ + "</svg>\n";
}

double text_width(std::string_view text, double size) {
  constexpr double kMeanAdvance = 0.56;  // of a sans-serif font, in units of its size
  const auto characters = std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;  // bytes that begin a character in UTF-8
  });
  return kMeanAdvance * size * static_cast<double>(characters);
}

}  // namespace deliso
