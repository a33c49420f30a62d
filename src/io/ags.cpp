#include "io/ags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/quote.hpp"
#include "base/trimmed.hpp"
#include "io/repeated.hpp"
#include "io/table_cells.hpp"

namespace phy::io {
namespace {

constexpr std::size_t most_groups_named = 100;

/// Items of a line; the first says what it holds.
std::vector<std::string> items_of(std::string_view line) {
  std::vector<std::string> items;
  if (line.ends_with('\r')) line.remove_suffix(1);
  split_cells(line, Separator::comma, items);
  return items;
}

std::string_view first_line(std::string_view text) {
  text = text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text.substr(0, text.find('\n'));
}

/// Edition 3 writes its groups as "**RUCS".
bool is_edition_3(std::string_view text) {
  const std::string_view line = first_line(text);
  return line.starts_with("\"**") || line.starts_with("**");
}

class AgsReader {
 public:
  AgsReader(std::string_view text, std::string group, std::string where)
      // RUCS is the group of uniaxial strength, E and nu; other tests have groups of their own.
      : text_(text), group_(group.empty() ? "RUCS" : std::move(group)), file_(std::move(where)) {
    table_.where = fmt::format("{} [{}]", file_, group_);
  }

  Table read() {
    for (int number = 1; !text_.empty(); ++number) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      take(text_.substr(0, end), number);
      text_.remove_prefix(std::min(end + 1, text_.size()));
    }
    finish();
    return std::move(table_);
  }

 private:
  std::string_view text_;
  std::string group_, file_;
  Table table_;
  std::vector<std::string> others_;
  bool inside_ = false, found_ = false;
  RepeatedProblem encoding_, counts_, words_;

  std::string at(int line) const { return fmt::format("{}:{}", table_.where, line); }

  void take(std::string_view line, int number) {
    if (trimmed(line).empty()) return;
    std::vector<std::string> items = items_of(line);
    const std::string word = items[0];
    if (word == "GROUP") {
      const std::string name = items.size() > 1 ? items[1] : "";
      inside_ = name == group_, found_ = found_ || inside_;
      if (!inside_) remember(name);
    }
    // TYPE says how many digits a number is shown with, which no reading depends on.
    if (!inside_ || word == "GROUP" || word == "TYPE") return;
    items.erase(items.begin());
    if (!std::all_of(items.begin(), items.end(), is_plain))
      encoding_.add({at(number), "", "", "text in UTF-8 without control characters", ""});
    else if (word == "HEADING")
      take_headings(std::move(items), number);
    else if (items.size() != table_.header.size())
      counts_.add({at(number), fmt::format("{} items", items.size()), "",
                   fmt::format("{}, as in the row HEADING", table_.header.size()), ""});
    else if (word == "UNIT")
      take_units(items);
    else if (word == "DATA")
      take_data(std::move(items), number);
    else
      words_.add({at(number), word, "", "GROUP, HEADING, UNIT, TYPE or DATA at the beginning of a row", ""});
  }
  /// Names of four letters or digits, each once; a file has some dozens.
  void remember(const std::string& name) {
    const bool known = std::find(others_.begin(), others_.end(), name) != others_.end();
    if (!known && others_.size() < most_groups_named && name.size() <= 4 && is_plain(name))
      others_.push_back(name);
  }
  void take_headings(std::vector<std::string> items, int number) {
    if (table_.header_line != 0)
      table_.problems.push_back({at(number), "HEADING", "", "one row HEADING in a group", ""});
    else
      table_.header = std::move(items), table_.header_line = number;
  }
  void take_units(const std::vector<std::string>& units) {
    for (std::size_t i = 0; i < units.size(); ++i)
      if (!units[i].empty()) table_.header[i] += " [" + plain_name(units[i]) + "]";
  }
  void take_data(std::vector<std::string> items, int number) {
    for (std::string& item : items) item = plain_cell(item);
    table_.rows.push_back({number, std::move(items)});
  }

  void finish() {
    const std::string names = fmt::format("{}", fmt::join(others_, ", "));
    if (!found_) {
      table_.where = file_;
      table_.problems.push_back(
          {file_, fmt::format("no group {}", group_), "", "a group of tests on rock",
           fmt::format("the file has {}; sheet = \"NAME\" in the rock file names one", names)});
      return;
    }
    for (const RepeatedProblem* p : {&encoding_, &counts_, &words_}) p->tell(table_.problems);
    table_.notes.push_back(fmt::format("an AGS file: its group {} is read", group_) +
                           (others_.empty() ? "" : "; other groups: " + names));
    if (table_.rows.empty() && table_.problems.empty())
      table_.problems.push_back({table_.where, "", "", "rows HEADING, UNIT, TYPE and DATA", ""});
    if (table_.header.size() <= most_table_columns) return;
    table_.problems.push_back({at(table_.header_line), fmt::format("{} headings", table_.header.size()), "",
                               fmt::format("at most {}", most_table_columns), ""});
    table_.header.clear(), table_.rows.clear(), table_.header_line = 0;
  }
};

}  // namespace

bool is_ags(std::string_view text) {
  if (is_edition_3(text)) return true;
  const std::vector<std::string> items = items_of(first_line(text).substr(0, 200));
  // Spreadsheets fill the row up with empty cells.
  return items.size() > 1 && items[0] == "GROUP" && !items[1].empty() &&
         std::all_of(items.begin() + 2, items.end(), [](const std::string& item) { return item.empty(); }) &&
         text.find("HEADING") != text.npos;
}

Table parse_ags(std::string_view text, const std::string& group, const std::string& where) {
  if (!is_edition_3(text)) return AgsReader(text, group, where).read();
  Table none;
  none.where = where;
  none.problems.push_back({where, "an AGS 3 file", "", "AGS 4 or CSV", "save it anew as one of these"});
  return none;
}

}  // namespace phy::io
