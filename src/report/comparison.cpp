#include "report/comparison.hpp"

#include "base/quote.hpp"

namespace phy::report {
namespace {

constexpr double column_width = 90.0, column_height = 65.0;  // [mm] one column of a journal

std::vector<GnuplotScript::Row> rows_of(const History& h) {
  std::vector<GnuplotScript::Row> rows;
  for (const HistoryRow& r : h.rows) rows.push_back({100.0 * r.axial_strain, 1e-6 * r.axial_stress});
  return rows;
}

}  // namespace

std::string comparison_script(const History& ours, const History& theirs, const std::string& our_name,
                              const std::string& their_name, FigureFormat format, const std::string& out) {
  GnuplotScript s;
  s.add("set xlabel 'axial strain [%]'; set ylabel 'axial stress [MPa]' offset 1");
  s.add("set xrange [0:*]; set yrange [0:*]; set key bottom right reverse Left");
  const auto line = [&](const History& h, const std::string& name, const char* style) {
    return s.block(rows_of(h)) + " with lines " + style + " title " + gnuplot_string(gnuplot_plain(name));
  };
  s.plot({line(ours, our_name, "lw 1.5 lc rgb '#0072b2'"),
          line(theirs, their_name, "dt 2 lw 1.5 lc rgb '#9a3f7d'")});
  return gnuplot_head(format, column_width, column_height, out) + s.text();
}

}  // namespace phy::report
