#include "report/canvas.hpp"

#include <algorithm>
#include <cmath>

namespace phy::report {

Canvas::Canvas(int width, int height, std::uint32_t background) : width_(width), height_(height) {
  const std::size_t n_pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  pixels_.reserve(3 * n_pixels);
  for (std::size_t i = 0; i < n_pixels; ++i)
    for (const unsigned shift : {16U, 8U, 0U}) pixels_ += static_cast<char>(background >> shift & 255U);
}

/// Blends the colour into every pixel of a box by the part of it that `cover` says is covered.
template <class Cover>
void Canvas::paint(double x0, double y0, double x1, double y1, std::uint32_t color, Cover cover) {
  const int left = std::max(0, static_cast<int>(std::floor(x0))),
            top = std::max(0, static_cast<int>(std::floor(y0)));
  const int right = std::min(width_ - 1, static_cast<int>(std::ceil(x1)));
  const int bottom = std::min(height_ - 1, static_cast<int>(std::ceil(y1)));
  for (int y = top; y <= bottom; ++y) {
    char* row = &pixels_[3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(width_)];
    for (int x = left; x <= right; ++x) {
      const double part = std::clamp(cover(x + 0.5, y + 0.5), 0.0, 1.0);
      if (part == 0.0) continue;
      char* pixel = row + 3 * static_cast<std::ptrdiff_t>(x);
      for (unsigned k = 0; k < 3; ++k) {
        const double old = static_cast<unsigned char>(pixel[k]), ink = color >> (16U - 8U * k) & 255U;
        pixel[k] = static_cast<char>(static_cast<unsigned char>(std::lround(old + part * (ink - old))));
      }
    }
  }
}

void Canvas::disc(double x, double y, double r, std::uint32_t color) {
  paint(x - r - 1.0, y - r - 1.0, x + r, y + r, color,
        [=](double px, double py) { return r + 0.5 - std::hypot(px - x, py - y); });
}

void Canvas::line(double x0, double y0, double x1, double y1, double width, std::uint32_t color) {
  const double dx = x1 - x0, dy = y1 - y0, length2 = std::max(1e-12, dx * dx + dy * dy), half = 0.5 * width;
  const auto cover = [=](double px, double py) {
    const double t = std::clamp(((px - x0) * dx + (py - y0) * dy) / length2, 0.0, 1.0);
    return half + 0.5 - std::hypot(px - x0 - t * dx, py - y0 - t * dy);
  };
  paint(std::min(x0, x1) - half - 1.0, std::min(y0, y1) - half - 1.0, std::max(x0, x1) + half,
        std::max(y0, y1) + half, color, cover);
}

}  // namespace phy::report
