// A gnuplot script in the making: data blocks, commands, pictures. Texts of the user go through
// base/quote.hpp.
#pragma once
#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "report/canvas.hpp"

namespace phy::report {

class GnuplotScript {
 public:
  using Row = std::vector<double>;

  /// A block of rows; returns its name for a plot command. NaN is left out by gnuplot.
  std::string block(const std::vector<Row>& rows);
  template <class... A>
  void add(fmt::format_string<A...> line, A&&... args) {
    commands_ += fmt::format(line, std::forward<A>(args)...) + "\n";
  }
  void plot(const std::vector<std::string>& parts);
  /// A plot of one picture that spans [x0, x1] x [y0, y1].
  void picture(const Canvas& canvas, double x0, double y0, double x1, double y1);
  std::string text() const { return data_ + commands_; }

 private:
  std::string data_, commands_;
  int n_blocks_ = 0;
};

enum class FigureFormat { svg, pdf, png };
/// By the ending of a file's name, without the point.
const std::map<std::string, FigureFormat>& figure_formats();

/// What a figure is drawn on.
struct Sheet {
  FigureFormat format = FigureFormat::svg;
  double width = 0.0, height = 0.0;  ///< [mm]; a height of 0: what the figure takes
  std::string out;                   ///< the file
};

/// The lines that set size, letters and lines for print, and the file.
std::string gnuplot_head(const Sheet& sheet);

}  // namespace phy::report
