// The kinds of figures that can be asked for, each made from records here and drawn by whoever is asked:
// as a file (gnuplot_figure, specimen_figures), on a terminal (terminal_plot), on the page.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "records/calibration.hpp"
#include "records/rock.hpp"
#include "records/specimen_record.hpp"
#include "records/variation.hpp"
#include "report/figure.hpp"
#include "report/gnuplot.hpp"

namespace phy::report {

/// What a figure is drawn from: a run, a study, or a calibration and the specimens that it has kept.
struct FigureData {
  RunRecord run;
  std::vector<Target> laboratory;  ///< beside E, UCS, nu of a run
  Variation variation;
  std::optional<Calibration> calibration;
};

struct FigureKind {
  const char* name;
  const char* paper;    ///< its number in the paper behind this project ("fig5"), or ""
  const char* meaning;  ///< and of which results
  double width;         ///< usual width [mm]
  bool varied;          ///< drawn from a study, else from a run or a calibration
  /// Throws InputError when the results do not hold what the kind shows. Null: a picture of specimens
  Figure (*make)(const FigureData&) = nullptr;
  /// in a script for gnuplot, which returns its height [mm].
  double (*picture)(GnuplotScript&, const RunRecord&, double width) = nullptr;
};
const std::vector<FigureKind>& figure_kinds();
/// By name or by the paper's number; throws InputError with the names.
const FigureKind& figure_kind(const std::string& word);

/// The script that writes the figure; a sheet of width 0 has the usual one.
std::string figure_script(const FigureKind& kind, const FigureData& data, Sheet sheet);
/// What is drawn, as CSV: a line per point, with panel, series, and the quantities and units of both axes.
std::string figure_csv(const FigureKind& kind, const FigureData& data);
/// The panels for a terminal, one below the other.
std::string figure_text(const FigureKind& kind, const FigureData& data, int columns);

}  // namespace phy::report
