#include "rock/columns.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <tuple>
#include <utility>

#include "base/trimmed.hpp"
#include "io/table_cells.hpp"

namespace phy::rock {
namespace {

std::string bare(std::string_view s, std::string_view of = " \t") { return std::string(trimmed(s, of)); }

// Longer tails are sentences, and each of their words would be looked up.
constexpr std::size_t most_of_a_unit = 40;  // letters

/// The program's word for a unit; nothing for what is none.
std::string unit_word(std::string_view text) {
  if (text.size() > most_of_a_unit) return "";
  const auto unit = find_unit(text.starts_with("in ") ? text.substr(3) : text);
  return unit ? unit->name : "";
}
bool is_toughness(const std::string& text) {
  const std::string word = unit_word(text);
  return !word.empty() && find_unit(word)->dimension == Dimension::toughness;
}

constexpr const char* opening = "[({";
constexpr const char* closings = "])}";

/// The bracket that closes the one at `open`; where none does, the first that closes any.
std::size_t closing(const std::string& cell, std::size_t open) {
  // Units of toughness hold brackets themselves: "(MPa sqrt(m))".
  int depth = 0;
  for (std::size_t at = open; at < cell.size(); ++at) {
    if (std::string_view(opening).find(cell[at]) != std::string_view::npos) ++depth;
    if (std::string_view(closings).find(cell[at]) != std::string_view::npos && --depth == 0) return at;
  }
  return cell.find_first_of(closings, open);
}

/// Does every bracket of a text close one that it opens? "ft)" of "(ton/ft)" is no unit.
bool is_balanced(const std::string& text) {
  int depth = 0;
  for (const char c : text) {
    if (std::string_view(opening).find(c) != std::string_view::npos) ++depth;
    if (std::string_view(closings).find(c) != std::string_view::npos && --depth < 0) return false;
  }
  return depth == 0;
}

bool is_power(const std::string& unit) { return unit.starts_with("10^") && unit.ends_with(" 1"); }

/// Joins what two brackets of a header say: "(10^3) [MPa]" is one unit, "(MPa) (psi)" none.
std::string joined_units(const std::string& first, const std::string& second) {
  const auto power_of = [](const std::string& unit) { return unit.substr(0, unit.size() - 1); };
  if (first.empty() || first == "-" || first == "1" || first == second) return second;
  if (second.empty() || second == "-" || second == "1") return first;
  if (is_power(first)) return power_of(first) + second;
  if (is_power(second)) return power_of(second) + first;
  // No unit has that name, so that the header is asked about, with both in view.
  return first + " and " + second;
}

/// Takes "[GPa]", "(GPa)" and "{GPa}" out of a header, wherever they stand.
std::string take_units(std::string cell, std::string& unit) {
  for (std::size_t open = cell.find_first_of(opening); open != cell.npos;
       open = cell.find_first_of(opening, open)) {
    const std::size_t close = closing(cell, open);
    if (close == cell.npos) break;
    const std::string inside = bare(cell.substr(open + 1, close - open - 1)), known = unit_word(inside);
    // "(1)" counts specimens, "[1]" is a unit.
    const bool counts = inside.empty() || inside == "-" || (inside == "1" && cell[open] == '[');
    if (inside == "1" ? !counts : known.empty() && !counts) {
      // What is no unit stays in the title, where readings_of() looks at it.
      ++open;
      continue;
    }
    unit = joined_units(unit, counts ? inside : known);
    cell = bare(cell.substr(0, open)) + " " + bare(cell.substr(close + 1));
  }
  return bare(cell);
}

/// Takes a name; false where it is not one of ours or of a laboratory's.
bool take_name(const std::string& key, Head& h) {
  if (const Known* known = known_column(key)) {
    h.kind = known->kind, h.property = known->property, h.name = known->name;
    h.deviatoric = h.name == "deviator";
    return true;
  }
  // Names of the list go before composed ones: "E50" is a header of E, and says no reading.
  const auto reading = modulus_of(key);
  if (reading) h.kind = Column::value, h.property = Property::E, h.name = "E", h.E_is = reading;
  return reading.has_value();
}

bool is_name(const std::string& key) {
  Head none;
  return take_name(key, none);
}

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

/// "E [GPa]", "E (GPa)", "E, GPa", "E GPa" and "E_GPa" are the same: title and unit. Behind a separator a
/// tail counts as a unit only if it is one ("E_sd" is a name); so does what stands in the last brackets.
std::pair<std::string, std::string> split_head(const std::string& header) {
  const std::string cell = io::plain_name(header);
  // Units of toughness hold separators and brackets themselves, "K_Ic MPa sqrt(m)": the longest tail first.
  const char* const separators = "_ ,;:/";
  for (std::size_t at = cell.find_first_of(separators); at != cell.npos;
       at = cell.find_first_of(separators, at + 1))
    // A separator at the very front leaves no name before the unit.
    if (at > 0 && cell.size() - at <= most_of_a_unit && is_toughness(cell.substr(at + 1)))
      return {bare(cell.substr(0, at), " \t_,;:/"), unit_word(cell.substr(at + 1))};
  std::string unit;
  std::string title = take_units(cell, unit);
  if (!is_power(unit) && (!unit.empty() || title != bare(cell))) return {title, unit};
  for (const std::string degree : {"°", "º", "˚"})  // "N°" is a number
    if (title.ends_with(degree) && lower_case(title) != "n" + degree)
      return {bare(title.substr(0, title.size() - degree.size())), "deg"};
  // "N/mm2" and "x10^4 MPa" hold separators themselves: tails that begin a word or two earlier are tried too.
  std::pair<std::string, std::string> found{title, ""};
  std::size_t at = title.find_last_of(separators);
  for (int words = 0; words < 3 && at != title.npos && at > 0;
       ++words, at = title.find_last_of(separators, at - 1))
    if (std::string known = unit_word(title.substr(at + 1));
        !known.empty() && known != "1" && is_balanced(title.substr(at + 1)))
      found = {bare(title.substr(0, at), " \t_,;:/"), known};
  if (!unit.empty() || !found.second.empty()) return {found.first, joined_units(unit, found.second)};
  // A unit of none of our columns, "[km/s]": the last brackets hold it.
  const std::size_t open = title.find_last_of(opening), close = title.find_last_of(closings);
  if (open != title.npos && open > 0 && close == title.size() - 1 && close > open)
    if (const std::string inside = bare(title.substr(open + 1, close - open - 1));
        (inside.find('/') != inside.npos ||
         (inside.size() == 2 && is_ascii(inside) &&
          std::isdigit(static_cast<unsigned char>(inside.front())) == 0)) &&
        !is_name(key_of(inside)))
      return {bare(title.substr(0, open)), inside};
  return {title, ""};
}

/// What a title may say: "compressive strength (UCS)" its words, or what stands in brackets. A letter or two
/// there may be anything: "porosity (n)". What else stands there changes the meaning, "UCS (residual)", and
/// only the whole is read.
std::vector<std::string> readings_of(const std::string& title) {
  std::vector<std::string> all = {title};
  const std::size_t open = title.find_first_of("[("), close = title.find_first_of("])", open);
  if (open == title.npos || close == title.npos) return all;
  const std::string inside = title.substr(open + 1, close - open - 1), before = key_of(title.substr(0, open));
  // A function of a value is not the value.
  if (contains(std::array{"log", "log10", "lg", "ln", "sqrt", "exp", "f", "sin", "cos", "tan"}, before))
    return all;
  // Letters and not bytes: in UTF-8 a Greek letter has two.
  const std::size_t letters = static_cast<std::size_t>(std::count_if(
      inside.begin(), inside.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80; }));
  if (letters <= 2 || is_name(key_of(inside))) all.push_back(title.substr(0, open) + title.substr(close + 1));
  // In brackets after the words stands their symbol: "compressive strength (UCS)".
  if (letters > 2) all.push_back(inside);
  return all;
}

/// "UCS_sd", "SD of UCS", "UCS std. dev.": the rest of the name, or nothing.
std::string without_scatter(const std::string& key) {
  for (const std::string word :
       // The longest first: behind "std" a "dev" would be left over, and name nothing.
       {"standarddeviationof", "standarddeviation", "stddev", "stdev", "std", "sdof", "sd"}) {
    if (key.size() > word.size() && key.ends_with(word)) return key.substr(0, key.size() - word.size());
    if (key.size() > word.size() && key.starts_with(word)) return key.substr(word.size());
  }
  return "";
}

/// "mean UCS" is UCS; how far the errors of c and phi go together no table says.
void take_reading(const std::string& key, Head& h) {
  std::string name = key;
  for (const std::string_view word : {"mean", "average", "avg"}) {
    if (name.starts_with(word)) name = name.substr(word.size()), h.summary = true;
    if (name.ends_with(word)) name = name.substr(0, name.size() - word.size()), h.summary = true;
  }
  if (take_name(key, h)) return void(h.summary = false);  // "average modulus" is a modulus
  if (take_name(name, h)) return;
  const std::string of = without_scatter(key);
  h.summary = !of.empty();
  if (of.empty() || !take_name(of, h)) return;
  const bool scatters = h.kind == Column::value;
  h.kind = scatters ? Column::scatter : Column::other;
  h.name = scatters ? h.name + "_sd" : key, h.deviatoric = false, h.E_is.reset();
}

/// Words around the name of an angle that leave its meaning to the name: "Bedding angle, θ".
constexpr std::array words_beside_names = {"angle",       "bedding", "foliation", "inclination",
                                           "orientation", "of",      "the"};

/// "Bedding angle, θ" names an angle, with nothing beside the name that could turn it.
void take_angle(const std::string& title, Head& h) {
  std::string name;
  for (const std::string& word : words_of(title))
    if ((word == "theta" || word == "beta") && name.empty())
      name = word;
    else if (!contains(words_beside_names, word))
      return;
  if (!name.empty()) take_name(name, h);
}

/// "Uniaxial compressive strength, σc" says one thing twice.
void take_two_names(const std::string& title, Head& h) {
  const std::vector<std::string> words = words_of(title);
  for (std::size_t n = 1; n < words.size() && h.kind == Column::other; ++n) {
    std::string front, behind;
    for (std::size_t i = 0; i < words.size(); ++i) (i < n ? front : behind) += words[i];
    Head a, b;
    if (take_name(front, a) && take_name(behind, b) && a.name == b.name) take_name(front, h);
  }
}

/// "theta (gon)": a name that is known, and a unit that is not, for the question that follows.
void take_odd_unit(const std::string& title, Head& h) {
  const std::size_t open = title.find_first_of(opening);
  if (open == title.npos || open == 0 || closing(title, open) != title.size() - 1) return;
  if (take_name(key_of(title.substr(0, open)), h)) h.unit = bare(title.substr(open), "[](){} ");
}

/// What tells specimens of one row apart: "2", "S2", "b", "specimen 2"; nothing for any other word.
std::string replicate_mark(std::string_view key) {
  // The longest first here too: "s" is the beginning of "sample".
  for (const std::string_view word : {"specimen", "sample", "test", "no", "nr", "s", "t"})
    if (key.starts_with(word) && key.size() > word.size()) {
      key.remove_prefix(word.size());
      break;
    }
  const bool letter = key.size() == 1 && key[0] >= 'a' && key[0] <= 'f';
  const bool number = !key.empty() && key.size() <= 2 &&
                      std::all_of(key.begin(), key.end(), [](char c) { return c >= '0' && c <= '9'; });
  return letter || number ? std::string(key) : "";
}

/// "UCS2", "UCS (S2)", "E b", "Specimen 2 UCS": a value of one of several specimens.
void take_replicate(const std::string& title, Head& h) {
  const std::string key = key_of(title);
  const std::vector<std::string> words = words_of(title);
  const auto take = [&](const std::string& name, const std::string& mark) {
    Head made;
    if (h.kind != Column::other || mark.empty() || !take_name(name, made) || made.kind != Column::value)
      return;
    h.kind = made.kind, h.property = made.property, h.name = made.name, h.deviatoric = made.deviatoric;
    h.E_is = made.E_is, h.replicate = mark;
  };
  // A mark is a word or two of its own, or digits behind the name.
  for (std::size_t n = 1; n <= 2 && n < words.size(); ++n) {
    std::string front, behind;
    for (std::size_t i = 0; i < words.size(); ++i) (i < n ? front : behind) += words[i];
    take(behind, replicate_mark(front));
    front.clear(), behind.clear();
    for (std::size_t i = 0; i < words.size(); ++i) (i + n < words.size() ? front : behind) += words[i];
    take(front, replicate_mark(behind));
  }
  // E1 and nu12 are constants of an anisotropic body.
  const std::size_t digits = key.find_last_not_of("0123456789") + 1;
  if (digits > 1 && digits < key.size()) take(key.substr(0, digits), replicate_mark(key.substr(digits)));
}

}  // namespace

Head head_of(const std::string& cell, const std::string& meant) {
  Head h;
  std::tie(h.title, h.unit) = split_head(cell);
  h.name = key_of(h.title);
  if (meant == "-") {
    h.kind = Column::passed;
    return h;
  }
  const std::string said = meant.empty() ? h.title : meant;
  if (meant.empty() && (h.title.starts_with('-') || h.title.starts_with('|'))) {  // the negative, the amount
    h.speaks_of = subjects_of(h.title);
    return h;
  }
  // From the plainest reading to the boldest: what one has understood no later one may turn.
  for (const std::string& reading : readings_of(said))
    if (h.kind == Column::other) take_reading(key_of(reading), h);
  if (h.kind == Column::other) take_angle(said, h);
  if (h.kind == Column::other) take_two_names(said, h);
  // "SD 1" is made of others, and no first specimen.
  if (h.kind == Column::other && !h.summary) take_replicate(said, h);
  if (h.kind == Column::other && h.unit.empty()) take_odd_unit(said, h);
  h.summary = h.summary || is_summary(h.title);
  // Which modulus it is the header says, also where the user says that it is E.
  if (!meant.empty() && h.name == "E" && h.kind == Column::value) h.E_is = head_of(cell).E_is;
  if (h.kind == Column::other) h.speaks_of = subjects_of(h.title);
  h.own = said.size() == h.name.size() && key_of(said) == key_of(h.name);
  return h;
}

std::string title_of(const std::string& cell) { return split_head(cell).first; }

bool has_factor(const std::string& title) {
  for (std::size_t at = title.find("10"); at != title.npos; at = title.find("10", at + 1)) {
    const std::string before = bare(title.substr(0, at));
    const std::string_view behind = std::string_view(title).substr(at + 2);
    // A factor may tell what was done to the numbers or what is to be done: both are in use, so it is asked.
    if (before.ends_with('x') || before.ends_with('X') || before.ends_with('*') || before.ends_with("×") ||
        before.ends_with("·"))
      return true;
    if (behind.starts_with('^') || behind.starts_with("⁻") || behind.starts_with("³") ||
        behind.starts_with("⁴"))
      return true;
  }
  return false;
}

std::string unit_of_cell(const std::string& cell) {
  if (std::string word = unit_word(cell); !word.empty()) return word;
  return unit_word(cell.starts_with('[') || cell.starts_with('(') ? bare(cell, "[]() \t") : cell);
}

namespace {

bool holds_values(const Head& h) { return h.kind == Column::value || h.kind == Column::scatter; }

}  // namespace

Dimension dimension_of(const Head& h) {
  if (h.is_angle() || h.kind == Column::friction) return Dimension::angle;
  if (h.kind == Column::diameter) return Dimension::length;
  if (h.kind == Column::n) return Dimension::none;
  return holds_values(h) ? measured(h.property).dimension : Dimension::pressure;
}

std::string usual_unit(const Head& h) {
  if (holds_values(h)) return measured(h.property).shown.name;
  switch (dimension_of(h)) {
    case Dimension::angle: return "deg";
    case Dimension::length: return "mm";
    case Dimension::none: return "";
    default: return "MPa";
  }
}

const std::vector<ColumnRow>& column_rows() {
  static const std::vector<ColumnRow> rows = [] {
    std::vector<ColumnRow> all;
    for (const Known& k : known_columns()) {
      Head h;
      h.kind = k.kind, h.property = k.property;
      all.push_back({k.name, usual_unit(h), k.meaning, {k.others.begin(), k.others.end()}});
    }
    return all;
  }();
  return rows;
}

}  // namespace phy::rock
