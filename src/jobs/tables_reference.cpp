#include "jobs/tables_reference.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/units.hpp"
#include "io/table.hpp"
#include "records/measured_property.hpp"
#include "rock/columns.hpp"

namespace phy::jobs {
namespace {

constexpr const char* head = R"(# Tables of laboratories

Written by `phyllite rock --tables`. This page lists what is read from a table of laboratory tests: layouts,
columns, units. A column that may hold a direction, a strength or a modulus is read or asked for. It is never
left out in silence. The question names the line to write in the [rock file](formats.md#rock-version-1).

## Layouts

| layout | how it is read |
|---|---|
)";

constexpr std::pair<const char*, const char*> layouts[] = {
    {"separators", "commas, semicolons, tabs, or runs of blanks; decimal commas where no comma parts cells"},
    {"encoding", "UTF-8, with or without a byte-order mark; any line ends"},
    {"workbook (.xlsx)", "the first sheet, or the one that `sheet` names"},
    {"AGS 4", "the group RUCS, or the one that `sheet` names"},
    {"above the headers", "titles and instrument lines are passed over"},
    {"units", "in the header, as `E [GPa]`, `E (GPa)`, `E, GPa`, `E GPa`, `E_GPa`, or in a row below"},
    {"two rows of headers", "a merged name above, its specimens below: `UCS (MPa)` over `S1`, `S2`, `Mean`"},
    {"rows", "one per angle, or one per test; rows of one angle are replicates"},
    {"specimens side by side",
     "`UCS 1`, `UCS 2`, `UCS 3` (or a, b, c) are replicates; their mean and SD are set aside"},
    {"SD behind its value", "`UCS (MPa)`, `SD`: the scatter of UCS"},
    {"rows of means", "\"Mean\", \"SD\", \"Average value\" beside specimens are refused"},
    {"angles", "numbers with or without a degree sign"},
    {"angles in words",
     "after one line in the rock file: parallel (∥) is theta = 90, perpendicular (⊥) is theta = 0"},
    {"V and H", "of the layers upright is 90; of a plug, core axis or load it is 0"},
    {"no column of angles", "asks for `bedded = false`"},
    {"empty cells, `-`, `–`", "not measured"}};

constexpr const char* columns_head = R"(
## Columns

Names are compared without case, blanks and signs. Greek letters are their names. Of every value `..._sd` is
the standard deviation of single specimens. `[columns]` in the rock file goes before every name of this list.

| column | unit | meaning | also read |
|---|---|---|---|
)";

constexpr const char* tolerances_head = R"(
E_t and E_tan are tangents at half of UCS, E_s and E_sec secants there, E_av averages, E_dyn dynamic moduli.

## Tolerances

How a calibration judges each property. A value is missed where chance does not explain the difference, and it
is larger than the tolerance. A value is met where an error that matters is excluded. Usual scatter stands for
single specimens until the table tells.

| property | tolerance | error that matters | usual scatter | test of the model |
|---|---|---|---|---|
)";

constexpr const char* units_head = R"(
## Units

The same units are read in tables, recipes, curves, on the page and in Python. Case, blanks, dots and
superscripts do not matter. A power of ten may stand in front: `x10^4 MPa`, `10⁵ Pa`. Values are converted,
and the check says so.

| quantity | unit | also read | one of it is |
|---|---|---|---|
)";

/// "3 %", or the difference itself of a property that is compared as it is.
std::string share(const MeasuredProperty& property, double value) {
  // Poisson's ratio and its like are compared by difference: a share of a small number says nothing.
  return property.absolute ? fmt::format("{:g}", value) : fmt::format("{:g} %", 100.0 * value);
}

}  // namespace

std::string tables_reference() {
  std::string text = head;
  for (const auto& [layout, how] : layouts) text += fmt::format("| {} | {} |\n", layout, how);
  text += fmt::format("| limit | {} columns |\n", io::most_table_columns) + columns_head;
  for (const rock::ColumnRow& c : rock::column_rows())
    text += fmt::format("| `{}` | {} | {} | {} |\n", c.name, c.unit, c.meaning, fmt::join(c.others, ", "));
  text += tolerances_head;
  for (const MeasuredProperty& p : measured_properties())
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", p.name, share(p, p.tolerance), share(p, p.coarsest),
                        // Moduli need no time steps, and so no test of the press.
                        share(p, p.usual_scatter), p.test == nullptr ? "direct solution" : p.test);
  text += units_head;
  for (const UnitRow& u : unit_rows())
    text += fmt::format("| {} | `{}` | {} | {} |\n", to_string(u.dimension), u.name, u.spellings, u.size);
  return text;
}

}  // namespace phy::jobs
