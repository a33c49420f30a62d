// A design as people see it: tables of constants, one figure, and the sheet of report.html.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "design/design.hpp"
#include "report/figure.hpp"

namespace phy::design {

/// A part as rows of text: constant, value with unit, 95 % interval, meaning. Constants of inclinations
/// (Hoek-Brown) have a row per inclination.
struct SheetTable {
  std::string title;  ///< with fit error and error of the stress that is left out
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};
std::vector<SheetTable> sheet_tables(const Design& design);

/// sigma_1, E and nu over theta: draws with the laws through them, and the laboratory's own values.
report::Figure design_figure(const Design& design);

nlohmann::ordered_json sheet_json(const Design& design);
std::string sheet_page(const Design& design);

}  // namespace phy::design
