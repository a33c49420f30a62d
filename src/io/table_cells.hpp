// Single cells of tables: how a line is split into them, and how they are typed.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace phy::io {

/// What parts the cells of a line. `runs`: two blanks or more. `blanks`: one or more; but a line of names
/// alone is parted by the runs that it has (names hold single blanks), and brackets belong to the name
/// before.
enum class Separator { comma, semicolon, tab, runs, blanks };

/// Cells without quotes and outer blanks. A quoted cell may hold the separator, and "" for a quote. False:
/// quotes left open.
bool split_cells(std::string_view line, Separator separator, std::vector<std::string>& cells);

/// A value as it was meant: without outer blanks, wide, thin and unbreakable ones included; "-" where only
/// dashes of any width stand ("not measured"); a typographic minus before digits is one.
std::string plain_cell(std::string_view cell);

/// A header as it was meant: blanks of every kind as plain ones, none outside; full-width brackets, colons,
/// commas, digits and letters of East Asian keyboards as those of ASCII.
std::string plain_name(std::string_view header);

/// Digits, one comma, digits: a number of half of Europe.
bool is_comma_number(const std::string& cell);

/// Could a cell be a measured value? A number, or what is written in its place: "<5", "22.5°", "10-30".
bool looks_measured(std::string_view cell);

}  // namespace phy::io
