// A picture in memory: discs, lines and rectangles with smooth edges, enough for the frames of a film.
// Colours are 0xRRGGBB; positions in pixels from the upper left corner.
#pragma once
#include <cstdint>
#include <string>

#include "base/vec.hpp"

namespace phy::report {

class Canvas {
 public:
  Canvas(int width, int height, std::uint32_t background);
  void disc(double x, double y, double r, std::uint32_t color);
  void line(Vec2 from, Vec2 to, double width, std::uint32_t color);
  int width() const { return width_; }
  int height() const { return height_; }
  /// Rows of RGB, three bytes per pixel.
  const std::string& rgb() const { return pixels_; }

 private:
  template <class Cover>
  void paint(Vec2 low, Vec2 high, std::uint32_t color, Cover cover);
  int width_, height_;
  std::string pixels_;
};

}  // namespace phy::report
