// Figures for print, as gnuplot scripts with their data inside. Sizes of journals: one column 90 mm, one and
// a half 140 mm, two 190 mm; letters of 8 points; colours that differ in lightness (report/palette.hpp), and
// symbols beside colours.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "records/calibration.hpp"
#include "records/rock.hpp"
#include "records/specimen_record.hpp"
#include "records/variation.hpp"
#include "report/gnuplot.hpp"

namespace phy::report {

struct FigureKind {
  const char* name;
  const char* paper;    ///< its number in the paper behind this project ("fig5"), or ""
  const char* meaning;  ///< and of which results
  double width;         ///< usual width [mm]
  bool varied;          ///< drawn from a study, else from a run or a calibration
};
const std::vector<FigureKind>& figure_kinds();
/// By name or by the paper's number; throws InputError with the names.
const FigureKind& figure_kind(const std::string& word);

/// What a figure is drawn from: a run, a study, or a calibration and the specimens that it has kept.
struct FigureData {
  RunRecord run;
  std::vector<Target> laboratory;  ///< beside E, UCS, nu of a run
  Variation variation;
  std::optional<Calibration> calibration;
};

/// The script that writes the figure into `out`. `width` [mm], 0: the usual one. Throws InputError when the
/// results do not hold what the kind shows.
std::string figure_script(const FigureKind& kind, const FigureData& data, FigureFormat format, double width,
                          const std::string& out);

}  // namespace phy::report
