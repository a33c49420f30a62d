// Figures as gnuplot scripts with their data inside. Sizes of journals: one column 90 mm, one and a half
// 140 mm, two 190 mm; letters of 8 points; colours that differ in lightness (report/palette.hpp), and symbols
// or dashes beside colours.
#pragma once
#include <string>

#include "report/figure.hpp"
#include "report/gnuplot.hpp"

namespace phy::report {

/// The script that writes a figure onto a sheet. Throws InputError where the sheet is too low for its panels.
std::string gnuplot_script(const Figure& figure, Sheet sheet);

/// A text with its symbols in italics and what follows "_" low, as gnuplot's markup.
std::string typeset(const std::string& text);

}  // namespace phy::report
