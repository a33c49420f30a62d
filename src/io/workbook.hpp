// Tables in workbooks of spreadsheet programs (.xlsx, Office Open XML, ECMA-376 part 1). A workbook is a ZIP
// archive of XML files; io/zip opens the one, pugixml reads the others.
//
// What of a sheet is the table: the header is the first row with two cells that are not empty (a title above
// it has one), the table is as wide as it. Cells merged over several rows hold their value in each of them,
// marked. Of formulas the value counts that the spreadsheet saved last.
#pragma once
#include <string>
#include <string_view>

#include "io/table_rows.hpp"

namespace phy::io {

/// What stands in a cell whose formula was saved without its value.
constexpr const char* formula_without_value = "a formula";

/// Does a file begin as ZIP archives do?
bool is_archive(std::string_view bytes);

/// A sheet as a table whose lines are rows of the sheet. `sheet`: its name; "": the first. Never throws;
/// `where` names the file in problems.
Table parse_workbook(std::string_view bytes, const std::string& sheet, const std::string& where);

}  // namespace phy::io
