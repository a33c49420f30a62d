#include "gui/imports.hpp"

#include <nlohmann/json.hpp>

#include "base/check.hpp"
#include "base/quote.hpp"
#include "io/table.hpp"
#include "jobs/rock_base.hpp"

namespace phy::gui {
namespace {

std::string line_of(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i == 0 ? "" : ",") + csv_cell(cells[i]);
  return line + "\n";
}

}  // namespace

Json table_from(std::string_view bytes, const std::string& file) {
  const io::Table table = io::parse_table(bytes, file);
  // Problems beside rows are shown in the page at their cells; without rows there is nowhere to show them.
  if (table.rows.empty() && !table.problems.empty()) throw InputError(table.problems);
  if (table.rows.empty())
    throw InputError(Problem{file, "", "", "a table: a row of headings, and values below them", ""});
  std::string text = line_of(table.header);
  // As CSV, whatever it was: the page edits one format, and that is what it saves.
  for (const io::TableRow& row : table.rows) text += line_of(row.cells);
  return {{"table", text}};
}

Json rock_like(const std::string& measured) {
  Json j;
  for (const jobs::BaseFile& f : jobs::base_files(measured)) {
    // The model and the card stay behind: the copy is a rock of the user's, not yet calibrated.
    if (f.name == "rock.toml") j["toml"] = f.text;
    if (f.name == "table.csv") j["table"] = f.text;
  }
  return j;
}

}  // namespace phy::gui
