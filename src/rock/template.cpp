#include "rock/template.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "base/quote.hpp"
#include "base/units.hpp"
#include "records/rock_model.hpp"

namespace phy::rock {
namespace {

constexpr const char* before_name =
    R"(# A rock for `phyllite calibrate`. What is not measured stays out of the table: empty cells are fine.
# `phyllite rock check` tells what the data determine before anything runs.
name = ")";
constexpr const char* before_table = R"("
data = )";
constexpr const char* after_table =
    R"(        # the table of tests, CSV or .xlsx, counted from this file's folder

# What E is: "tangent 50 %", "average", "secant 50 %", "secant at peak"; "small strain" of waves.
# Left out: what the header says (Et, E_av, Es, E_dyn), else the tangent.
# E_is = "tangent 50 %"
# Moduli of cylinders are read as plane stress; "plane strain" converts them (needs nu).
elastic_reading = "plane stress"

# confining = "10 MPa"          # E and nu under this pressure alone; default: under all of the table
# bedded = false                # a rock without bedding needs no column of angles
# recipe = "model.toml"         # grain size, bedding rule, press, and the size: take out [specimen] then
#                               # (`phyllite recipe --template`). Without it: the paper's specimen,
#                               # magnified to the size below
# layers = "choose"             # "choose", "planes" (smooth joints), "directions" (of the bonds),
#                               # "planes and directions", "planes with bridges" (joints on a share of them)
# matrix = "choose"             # "choose", "parallel_bond", "flat_joint" (UCS far above tension)
# grain_size = "3 mm"           # mean diameter of the model's grains: coarse ones are quick, fine ones
#                               # nearer to the rock; without it K_Ic is not fitted
# sheet = "Results"             # of a workbook; default: the first

[bedding]
# spacing = "5 mm"             # of bedding or foliation, as seen; without it a guess: 5 mm on 38 mm of width

[specimen]                      # of the compression tests
width = "38 mm"
height = "76 mm"

# [brazilian]                   # discs of the BTS column, unless a column diameter [mm] says otherwise
# diameter = "38 mm"           # default: the smaller side of the specimen
# loading_angle = "10 deg"     # arc of each jaw; "0 deg": flat platens

# [report]                      # on the first page of the report
# project = "..."              # also client, laboratory, author

# [columns]                     # where `phyllite rock check` reads a header otherwise than it is meant
# "peak stress" = "UCS"         # header = name; "-": passed over
)";

constexpr const char* table_template =
    R"(# One row per angle, or per angle and test; repeated rows are replicates. Units stand in the header.
# theta: inclination of the bedding, load along y: 0 = bedding across the load, 90 = along it.
# Or a column beta [deg], the angle between load and bedding (beta = 90 - theta). Three angles at least.
# Also known: DTS [MPa] (direct tension), BTS [MPa] (Brazilian; diameter [mm] of its disc), I_s50 [MPa] (point
# load), K_Ic [MPa sqrt(m)] (semi-circular bend; diameter [mm] of the half disc), each with _sd;
# confining [MPa], under which UCS is sigma_1 at the peak, E and nu from q over strain; or c [MPa],
# phi [deg], confining_min [MPa], confining_max [MPa] of an envelope. The load, or the pull of DTS, is
# along y in every test. Direct shear of bedding: tau_peak [MPa], tau_residual [MPa] under sigma_n [MPa], in
# rows that need no angle.
# E and nu are what E_is of the rock file says.
# _sd: standard deviation of single specimens; n: specimens. Other columns are passed over.
theta [deg],E [GPa],E_sd [GPa],nu,nu_sd,UCS [MPa],UCS_sd [MPa],n
0,,,,,,,
15,,,,,,,
30,,,,,,,
45,,,,,,,
60,,,,,,,
75,,,,,,,
90,,,,,,,
)";

/// The line that shows the key, in a comment or not; the explanation behind it stays.
void set_key(std::string& text, const std::string& key, const std::string& value) {
  const std::string shown = key + " = ";
  std::size_t line = text.find("\n# " + shown);
  if (line == text.npos) line = text.find("\n" + shown);
  PHY_CHECK(line != text.npos, "a key that the template shows");
  const std::size_t end = std::min(text.find('\n', line + 1), text.find("  #", line + 1));
  text.replace(line + 1, end - line - 1, shown + value);
}

}  // namespace

std::string rock_template(const std::string& name, const std::string& file, const Start& start) {
  std::string keys = after_table;
  const auto length = [](double value) { return toml_string(print_quantity(value, Dimension::length)); };
  if (!start.E_is.empty()) set_key(keys, "E_is", toml_string(start.E_is));
  if (!start.bedded) set_key(keys, "bedded", "false");
  if (!start.layers.empty()) set_key(keys, "layers", toml_string(start.layers));
  if (!start.matrix.empty()) set_key(keys, "matrix", toml_string(start.matrix));
  if (start.grain_size) set_key(keys, "grain_size", length(*start.grain_size));
  // Directions of bonds have no spacing.
  if (start.spacing && start.layers != to_string(LayerModel::directions))
    set_key(keys, "spacing", length(*start.spacing));
  set_key(keys, "width", length(start.size.width)), set_key(keys, "height", length(start.size.height));
  return before_name + name + before_table + toml_string(file) + keys;
}

std::string rock_table_template() { return table_template; }

}  // namespace phy::rock
