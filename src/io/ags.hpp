// Tables in files of laboratories and site investigations after AGS 4 (Association of Geotechnical and
// Geoenvironmental Specialists, Electronic Transfer of Geotechnical and Geoenvironmental Data, edition 4.0.4:
// rules 2 to 6, 8 and 12; groups RUCS, "rock uniaxial compressive strength and deformability", and RPLT,
// "point load"). Text with commas, every item in quotes. A file is a list of groups; each has rows that begin
// with GROUP (its name), HEADING (names of columns), UNIT, TYPE and then DATA, once per test. "" is no value.
//
//   "GROUP","RUCS"
//   "HEADING","LOCA_ID","SPEC_DPTH","RUCS_SDIA","RUCS_UCS","RUCS_E","RUCS_MU"
//   "UNIT","","m","mm","MPa","GPa",""
//   "TYPE","ID","2DP","1DP","3SF","3SF","2DP"
//   "DATA","BH1","12.10","54.0","81.2","21.5","0.24"
//
// Left out: TYPE, the relations between groups, and the dictionary that a file may carry.
#pragma once
#include <string>
#include <string_view>

#include "io/table_rows.hpp"

namespace phy::io {

/// Does a text begin as AGS files do, those of edition 3 included (which parse_ags() refuses)?
bool is_ags(std::string_view text);

/// One group as a table, its units in brackets behind the headings: "RUCS_UCS [MPa]". `group`: its name;
/// "": RUCS. Never throws; `where` names the file in problems.
Table parse_ags(std::string_view text, const std::string& group, const std::string& where);

}  // namespace phy::io
