#include "maps/forecast_record.hpp"

#include <algorithm>
#include <string>

#include "io/table.hpp"

namespace phy::maps {

// docs/calibration.md; specimens with bridges, whose share was stated, differ by where these lie.
Finding record_of(const MappedModel& of) {
  if (of.model->matrix == MatrixModel::flat_joint) return {FindingKind::forecast_untried, {}, {}, {of.label}};
  const double wrong = !of.layered()       ? 1.0
                       : of.model->bridges ? 30.0
                                           : 18.0,
               n = !of.layered()       ? 60.0
                   : of.model->bridges ? 200.0
                                       : 220.0;
  return {FindingKind::forecast_record, {}, {{"wrong", wrong}, {"of", n}}};
}

Finding record_on_rocks(std::string_view csv) {
  const io::Table table = io::parse_table(csv, "data/rocks/forecasts.csv");
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(table.header, name) - table.header.begin());
  };
  const std::size_t low = column("low"), high = column("high"), reached = column("reached");
  double inside = 0.0, below = 0.0;
  for (const io::TableRow& row : table.rows) {
    const double error = std::stod(row.cells.at(reached));
    if (error < std::stod(row.cells.at(low)))
      below += 1.0;
    else if (error <= std::stod(row.cells.at(high)))
      inside += 1.0;
  }
  return {FindingKind::forecast_on_rocks,
          {},
          {{"inside", inside}, {"below", below}, {"of", static_cast<double>(table.rows.size())}}};
}

}  // namespace phy::maps
