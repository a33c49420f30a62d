#include "io/table_cells.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "base/quote.hpp"
#include "base/trimmed.hpp"

namespace phy::io {
namespace {

constexpr std::array<std::string_view, 7> other_blanks = {
    "\xC2\xA0",      // U+00A0, breaks no line
    "\xE2\x80\x87",  // U+2007, as wide as a digit
    "\xE2\x80\x89",  // U+2009, thin
    "\xE2\x80\x8B",  // U+200B, without width
    "\xE2\x80\xAF",  // U+202F, narrow, breaks no line
    "\xE3\x80\x80",  // U+3000, as wide as an ideograph
    "\xEF\xBB\xBF"   // U+FEFF, a byte-order mark inside of a text
};
constexpr std::array<std::string_view, 7> dashes = {
    "-", "\xE2\x80\x90", "\xE2\x80\x91", "\xE2\x80\x93", "\xE2\x80\x94", "\xE2\x88\x92", "\xEF\xBC\x8D"};

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_ascii(std::string_view text) {
  return std::none_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
}

/// The length of the one of a list with which a text begins, or ends; 0: none.
template <class List>
std::size_t at_front(std::string_view text, const List& list) {
  const auto found = std::find_if(list.begin(), list.end(), [&](auto s) { return text.starts_with(s); });
  return found == list.end() ? 0 : found->size();
}
template <class List>
std::size_t at_back(std::string_view text, const List& list) {
  const auto found = std::find_if(list.begin(), list.end(), [&](auto s) { return text.ends_with(s); });
  return found == list.end() ? 0 : found->size();
}

std::string_view without_blanks(std::string_view text) {
  text = trimmed(text);
  // Nearly all cells: the search below is for the few that come from a text processor.
  if (is_ascii(text)) return text;
  for (std::size_t n = 0; (n = at_front(text, other_blanks)) > 0;) text = trimmed(text.substr(n));
  for (std::size_t n = 0; (n = at_back(text, other_blanks)) > 0;)
    text = trimmed(text.substr(0, text.size() - n));
  return text;
}

/// U+FF01 to U+FF5E are the printable characters of ASCII, as wide as ideographs.
char narrow(std::string_view character) {
  if (character.size() != 3 || character[0] != '\xEF') return 0;
  const int code = (static_cast<unsigned char>(character[1]) & 0x3F) * 64 +
                   (static_cast<unsigned char>(character[2]) & 0x3F);  // beyond U+F000
  return code >= 0xF01 && code <= 0xF5E ? static_cast<char>(code - 0xF00 + 0x20) : '\0';
}

char character_of(Separator separator) {
  return separator == Separator::comma ? ',' : separator == Separator::semicolon ? ';' : '\t';
}

bool split_at(std::string_view line, char delimiter, std::vector<std::string>& cells) {
  std::string cell;
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    // A doubled quote inside quotes is one quote.
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      cell += line[++i];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == delimiter && !quoted)
      cells.emplace_back(without_blanks(cell)), cell.clear();
    else
      cell += line[i];
  }
  cells.emplace_back(without_blanks(cell));
  return !quoted;
}

/// Cells that `least` blanks part.
bool split_at_blanks(std::string_view line, std::size_t least, std::vector<std::string>& cells) {
  std::string cell;
  bool quoted = false;
  for (std::size_t i = 0; i < line.size();) {
    const std::size_t blanks = quoted ? 0 : std::min(line.find_first_not_of(' ', i), line.size()) - i;
    if (blanks >= least && !cell.empty()) cells.emplace_back(without_blanks(cell)), cell.clear();
    if (blanks > 0 && blanks < least && !cell.empty()) cell += ' ';
    if (blanks == 0 && line[i] == '"') quoted = !quoted;
    if (blanks == 0 && line[i] != '"') cell += line[i];
    i += std::max<std::size_t>(1, blanks);
  }
  if (!cell.empty()) cells.emplace_back(without_blanks(cell));
  return !quoted;
}

/// Single blanks part names too: a bracket belongs to the name before it, "sigma1 (MPa) sigma3 (MPa)".
void join_brackets(std::vector<std::string>& names) {
  std::vector<std::string> joined;
  int depth = 0;
  for (const std::string& name : names) {
    const bool inside = depth > 0 || name.starts_with('(') || name.starts_with('[');
    if (inside && !joined.empty())
      joined.back() += " " + name;
    else
      joined.push_back(name);
    for (const char c : name) depth += c == '(' || c == '[' ? 1 : c == ')' || c == ']' ? -1 : 0;
  }
  names = std::move(joined);
}

}  // namespace

bool split_cells(std::string_view line, Separator separator, std::vector<std::string>& cells) {
  cells.clear();
  if (separator != Separator::runs && separator != Separator::blanks)
    return split_at(line, character_of(separator), cells);
  line = trimmed(line);
  if (separator == Separator::runs) return split_at_blanks(line, 2, cells);
  const auto are_names = [&] { return std::none_of(cells.begin(), cells.end(), looks_measured); };
  // Names of several words are often parted by two blanks, above rows that single ones part.
  if (line.find("  ") != line.npos) {
    if (split_at_blanks(line, 2, cells) && are_names()) return true;
    cells.clear();
  }
  const bool closed = split_at_blanks(line, 1, cells);
  if (are_names()) join_brackets(cells);
  return closed;
}

std::string plain_cell(std::string_view cell) {
  cell = without_blanks(cell);
  const std::size_t n = at_front(cell, dashes);
  if (n == 0) return std::string(cell);
  std::string_view rest = cell;
  for (std::size_t more = n; more > 0; more = at_front(rest, dashes)) rest.remove_prefix(more);
  // A run of dashes of whatever kind means that nothing was measured.
  if (rest.empty()) return "-";
  // A dash before a word is a bullet or a hyphen, and no sign.
  const bool minus = cell.size() > n && (is_digit(cell[n]) || cell[n] == '.' || cell[n] == ',');
  return minus ? "-" + std::string(cell.substr(n)) : std::string(cell);
}

std::string plain_name(std::string_view header) {
  header = without_blanks(header);
  if (is_ascii(header)) return std::string(header);
  std::string name;
  while (!header.empty()) {
    const std::size_t blank = at_front(header, other_blanks);
    const std::size_t n = blank > 0 ? blank : std::max<std::size_t>(1, utf8_length(header));
    const std::string_view character = header.substr(0, n);
    header.remove_prefix(n);
    if (blank > 0)
      name += ' ';
    else if (const char ascii = narrow(character); ascii != 0)
      name += ascii;
    else
      name += character;
  }
  return std::string(trimmed(name));
}

bool is_comma_number(const std::string& cell) {
  // At least a digit on either side; a list such as "1,2,3" is no number.
  const std::size_t comma = cell.find(',');
  if (comma == 0 || comma == cell.npos || comma + 1 == cell.size()) return false;
  return std::all_of(cell.begin(), cell.end(),
                     [](char c) {
                       return is_digit(c) || c == ',' || c == '-' || c == '+' || c == 'e' || c == 'E';
                     }) &&
         cell.find(',', comma + 1) == cell.npos;
}

bool looks_measured(std::string_view cell) {
  constexpr std::array<std::string_view, 9> before = {
      "<",        ">",           "~", "=", "+", "\xE2\x89\xA4", "\xE2\x89\xA5",
      "\xC2\xB1", "\xE2\x89\x88"};  // also <=, >=, +-, about
  for (std::size_t n = 0; (n = std::max(at_front(cell, before), at_front(cell, dashes))) > 0;)
    cell = without_blanks(cell.substr(n));
  if (cell.empty() ||
      !(is_digit(cell[0]) || (cell.size() > 1 && is_digit(cell[1]) && (cell[0] == '.' || cell[0] == ','))))
    return false;
  // Letters make it a name, "3-point bending", but for the one of a power of ten.
  for (std::size_t i = 1; i < cell.size(); ++i) {
    const bool exponent = (cell[i] == 'e' || cell[i] == 'E') && is_digit(cell[i - 1]) &&
                          i + 1 < cell.size() &&
                          (is_digit(cell[i + 1]) || cell[i + 1] == '-' || cell[i + 1] == '+');
    const bool letter = std::isalpha(static_cast<unsigned char>(cell[i])) != 0 && !exponent;
    if (letter || cell[i] == ';' || cell[i] == '\t') return false;
  }
  return true;
}

}  // namespace phy::io
