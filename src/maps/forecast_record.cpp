#include "maps/forecast_record.hpp"

#include <algorithm>
#include <string>

#include "io/table.hpp"

namespace phy::maps {

namespace {

std::size_t column(const io::Table& table, const char* name) {
  return static_cast<std::size_t>(std::ranges::find(table.header, name) - table.header.begin());
}

/// As the record counts models; flat joints have none.
std::string group_of(const MappedModel& of) {
  if (of.model->matrix == MatrixModel::flat_joint) return "flat joints";
  return !of.layered() ? "without layers" : of.model->bridges ? "bridges" : "layers";
}

}  // namespace

Finding record_of(const MappedModel& of, std::string_view csv) {
  const io::Table table = io::parse_table(csv, "data/rocks/synthetic_forecasts.csv");
  const std::size_t models = column(table, "models"), wrong = column(table, "wrong"), n = column(table, "of");
  for (const io::TableRow& row : table.rows)
    if (row.cells.at(models) == group_of(of))
      return {FindingKind::forecast_record,
              {},
              {{"wrong", std::stod(row.cells.at(wrong))}, {"of", std::stod(row.cells.at(n))}}};
  return {FindingKind::forecast_untried, {}, {}, {of.label}};
}

Finding record_on_rocks(std::string_view csv) {
  const io::Table table = io::parse_table(csv, "data/rocks/forecasts.csv");
  const std::size_t low = column(table, "low"), high = column(table, "high"),
                    reached = column(table, "reached");
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
