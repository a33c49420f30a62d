#include "report/canvas.hpp"

#include <algorithm>
#include <cmath>

namespace phy::report {

Canvas::Canvas(int width, int height, std::uint32_t background) : width_(width), height_(height) {
  const std::size_t n_pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  // Three bytes without padding: both ffmpeg and gnuplot read the buffer as it is.
  pixels_.reserve(3 * n_pixels);
  for (std::size_t i = 0; i < n_pixels; ++i)
    for (const unsigned shift : {16U, 8U, 0U}) pixels_ += static_cast<char>(background >> shift & 255U);
}

/// Blends the colour into every pixel of a box by the part of it that `cover` says is covered.
template <class Cover>
void Canvas::paint(Vec2 low, Vec2 high, std::uint32_t color, Cover cover) {
  const int left = std::max(0, static_cast<int>(std::floor(low.x))),
            top = std::max(0, static_cast<int>(std::floor(low.y)));
  const int right = std::min(width_ - 1, static_cast<int>(std::ceil(high.x)));
  const int bottom = std::min(height_ - 1, static_cast<int>(std::ceil(high.y)));
  for (int y = top; y <= bottom; ++y) {
    char* row = &pixels_[3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(width_)];
    for (int x = left; x <= right; ++x) {
      // Pixels count from their centres; coverage instead of yes or no keeps small discs round.
      const double part = std::clamp(cover(x + 0.5, y + 0.5), 0.0, 1.0);
      if (part == 0.0) continue;
      char* pixel = row + 3 * static_cast<std::ptrdiff_t>(x);
      for (unsigned k = 0; k < 3; ++k) {
        const double old = static_cast<unsigned char>(pixel[k]), ink = color >> (16U - 8U * k) & 255U;
        // Through unsigned char: a char above 127 is negative on some machines, and lround of it would be,
        // too.
        pixel[k] = static_cast<char>(static_cast<unsigned char>(std::lround(old + part * (ink - old))));
      }
    }
  }
}

void Canvas::disc(double x, double y, double r, std::uint32_t color) {
  paint({x - r - 1.0, y - r - 1.0}, {x + r, y + r}, color,
        // The edge falls from 1 to 0 over one pixel, the true radius in its middle.
        [=](double px, double py) {
          return r + 0.5 - norm(Vec2{px - x, py - y});
        });
}

void Canvas::line(Vec2 from, Vec2 to, double width, std::uint32_t color) {
  const Vec2 along = to - from;
  // A line of no length is a dot, and no division by zero.
  const double length2 = std::max(1e-12, dot(along, along)), half = 0.5 * width;
  const auto cover = [=](double px, double py) {
    const Vec2 p{px - from.x, py - from.y};
    const double t = std::clamp(dot(p, along) / length2, 0.0, 1.0);
    return half + 0.5 - norm(p - t * along);
  };
  paint({std::min(from.x, to.x) - half - 1.0, std::min(from.y, to.y) - half - 1.0},
        {std::max(from.x, to.x) + half, std::max(from.y, to.y) + half}, color, cover);
}

}  // namespace phy::report
