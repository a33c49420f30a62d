// Panels of a figure in rows and columns, with margins in millimetres whatever the width of the figure.
#pragma once
#include <algorithm>
#include <cstddef>

#include "report/gnuplot.hpp"

namespace phy::report {

/// Begins a grid of `n` panels in a figure that is `width` mm wide and leaves `head` mm above them free.
/// `aspect`: height over width of a panel. Returns the height of the figure [mm].
inline double begin_panels(GnuplotScript& s, std::size_t n, double width, double aspect, double head = 0.0) {
  constexpr double left = 13.5, right = 1.5, top = 6.0, bottom = 11.0;  // of each panel
  const int columns = n <= 2 ? static_cast<int>(std::max<std::size_t>(1, n)) : n == 4 ? 2 : 3;
  const int rows = (static_cast<int>(n) + columns - 1) / columns;
  const double panel = (width - right - columns * left) / columns;  // between the axes
  const double height = rows * (aspect * panel + top + bottom) + head;
  s.add("set multiplot layout {},{} margins {:.4f},{:.4f},{:.4f},{:.4f} spacing {:.4f},{:.4f}", rows, columns,
        left / width, 1.0 - right / width, bottom / height, 1.0 - (top + head) / height, left / width,
        (top + bottom) / height);
  return height;
}

}  // namespace phy::report
