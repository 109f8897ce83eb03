// Drawings as SVG text: the few shapes that plots need. Equal drawings give equal bytes.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace deliso {

// In pixels, from the upper left corner.
struct SvgPoint {
  double x = 0;
  double y = 0;
};

// How a line or an outline is drawn.
struct SvgStroke {
  std::string_view color = "#000000";
  double width = 1;
};

struct SvgFont {
  double size = 12;                   // in pixels
  std::string_view anchor = "start";  // which part of the text stands at its point: start, middle or end
  bool bold = false;
  bool upwards = false;  // written from bottom to top
};

class SvgDrawing {
 public:
  // White, width x height pixels.
  SvgDrawing(double width, double height);

  void line(SvgPoint from, SvgPoint to, const SvgStroke& stroke);
  void polyline(std::span<const SvgPoint> points, const SvgStroke& stroke);
  void polygon(std::span<const SvgPoint> points, std::string_view fill, double opacity = 1);
  void rectangle(SvgPoint corner, double width, double height, std::string_view fill);
  void circle(SvgPoint center, double radius, std::string_view fill);
  void text(SvgPoint at, std::string_view text, const SvgFont& font = {});

  // The document.
  [[nodiscard]] std::string document() const;

 private:
  double width_;
  double height_;
  std::string body_;
};

// About how wide a text will be, in pixels; fonts differ from viewer to viewer.
double text_width(std::string_view text, double size);

}  // namespace deliso
