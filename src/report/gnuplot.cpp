#include "report/gnuplot.hpp"

#include <cmath>
#include <filesystem>

#include "base/quote.hpp"

namespace phy::report {

const std::map<std::string, FigureFormat>& figure_formats() {
  static const std::map<std::string, FigureFormat> formats = {
      {"svg", FigureFormat::svg}, {"pdf", FigureFormat::pdf}, {"png", FigureFormat::png}};
  return formats;
}

std::string GnuplotScript::block(const std::vector<Row>& rows) {
  std::string name = "$d" + std::to_string(n_blocks_++);
  // Data blocks inside the script: no files that could be left behind or mixed up.
  data_ += name + " << EOD\n";
  for (const Row& row : rows) {
    // gnuplot leaves a gap at this word, and would stop at "inf".
    for (const double v : row) data_ += std::isfinite(v) ? fmt::format("{:.8g} ", v) : "NaN ";
    data_ += "\n";
  }
  data_ += "EOD\n";
  return name;
}

void GnuplotScript::plot(const std::vector<std::string>& parts) {
  commands_ += "plot ";
  for (std::size_t i = 0; i < parts.size(); ++i) commands_ += (i == 0 ? "" : ", \\\n     ") + parts[i];
  commands_ += "\n";
}

void GnuplotScript::picture(const Canvas& canvas, double x0, double y0, double x1, double y1) {
  const double dx = (x1 - x0) / canvas.width(), dy = (y1 - y0) / canvas.height();
  add("plot '-' binary array=({},{}) flipy dx={:.9g} dy={:.9g} origin=({:.9g},{:.9g}) format='%uchar' using "
      "1:2:3 with rgbimage notitle",
      canvas.width(), canvas.height(), dx, dy, x0 + 0.5 * dx, y0 + 0.5 * dy);
  // Raw bytes follow the command on standard input, zeros among them: the script is no C string.
  commands_ += canvas.rgb();
}

// Letters of 8 points in all three formats: the SVG terminal counts in pixels of 1/96 inch, the PNG terminal
// in pixels of 1/450 inch with letters of 1/72 at 72 per inch, the PDF terminal makes them 4/3 as large.
std::string gnuplot_head(const Sheet& sheet) {
  const double w = sheet.width / 25.4, h = sheet.height / 25.4;
  const std::string file =
      (std::filesystem::path(".") / sheet.out).string();  // "|" in front would be a command
  std::string terminal;
  if (sheet.format == FigureFormat::pdf)
    terminal = fmt::format(
        "pdfcairo enhanced size {:.4f},{:.4f} font 'DejaVu Sans,8' fontscale 0.75 lw 1 rounded", w, h);
  else if (sheet.format == FigureFormat::png)
    terminal = fmt::format(
        "pngcairo enhanced size {:.0f},{:.0f} font 'DejaVu Sans,8' fontscale 4.7 lw 4.2 pointscale 3.6 "
        "rounded",
        w * 450.0, h * 450.0);
  else
    terminal = fmt::format(
        "svg enhanced size {:.0f},{:.0f} font 'DejaVu Sans,10.7' lw 1.1 rounded background 'white'", w * 96.0,
        h * 96.0);
  // What an axis is stands clear of its numbers and inside the page, by what a terminal takes for their size.
  const char* const labels = sheet.format == FigureFormat::svg
                                 ? "set ylabel offset 1; set y2label offset -1; set xlabel offset 0,0.6\n"
                                 : "set ylabel offset -0.3\n";
  // Encoding first: the terminal chooses its fonts by it.
  return "set encoding utf8\nset terminal " + terminal + "\nset output " + gnuplot_string(file) +
         "\nset border 3 lw 0.8\nset tics nomirror out scale 0.5 font ',7'\n" + labels +
         "set key samplen 1.6 spacing 0.95 width -1 font ',7' noopaque\n";
}

}  // namespace phy::report
