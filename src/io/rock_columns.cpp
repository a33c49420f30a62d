#include "io/rock_columns.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <utility>

#include "base/trimmed.hpp"
#include "io/table_cells.hpp"

namespace phy::io {
namespace {

/// A column: our name, what it holds, and what laboratories call it.
struct Known {
  const char* name;
  Column kind;
  Property property;
  const char* meaning;
  std::vector<const char*> others;
};

/// The one list: readers, messages and docs/tables.md follow it. Left out on purpose: "d" and "no", which
/// mean other things too.
const std::vector<Known>& known_columns() {
  using C = Column;
  using P = Property;
  static const std::vector<Known> known = {
      {"theta",
       C::theta,
       P::E,
       "inclination of the layers, load upright: 0 = across the load, 90 = along it",
       {"θ", "dip", "dip angle", "inclination", "bedding inclination", "bedding dip", "bedding dip angle",
        "foliation dip", "foliation dip angle", "foliation inclination", "angle theta"}},
      {"beta", C::beta, P::E, "angle between load and layers: 90 - theta", {"β", "angle beta"}},
      {"E",
       C::value,
       P::E,
       "Young's modulus; the rock file's `E_is` says how it was read",
       {"E50", "Young", "Young modulus", "Young's modulus", "elastic modulus", "elasticity modulus",
        "modulus of elasticity", "deformation modulus", "modulus of deformation", "RUCS_E"}},
      {"nu",
       C::value,
       P::nu,
       "apparent Poisson's ratio",
       {"ν", "v", "Poisson", "Poisson ratio", "Poisson's ratio", "RUCS_MU"}},
      {"UCS",
       C::value,
       P::ucs,
       "uniaxial compressive strength; beside a `confining` above 0 it is sigma_1",
       {"sigma_c", "sigma_ucs", "q_u", "uniaxial compressive strength", "unconfined compressive strength",
        "uniaxial strength", "compressive strength", "peak strength", "RUCS_UCS"}},
      {"DTS",
       C::value,
       P::direct_tension,
       "direct tensile strength",
       {"direct tensile strength", "direct tension", "uniaxial tensile strength"}},
      {"BTS",
       C::value,
       P::brazilian,
       "Brazilian (splitting) tensile strength",
       {"sigma_t", "sigma_bt", "Brazilian strength", "Brazilian tensile strength",
        "indirect tensile strength", "splitting tensile strength", "tensile strength", "ITS"}},
      {"sigma_1",
       C::value,
       P::confined,
       "axial stress at the peak under `confining`",
       {"s1", "major principal stress", "axial stress at failure"}},
      {"deviator",
       C::value,
       P::confined,
       "sigma_1 - sigma_3 at the peak",
       {"q", "sigma_d", "sigma_1 - sigma_3", "deviator stress", "deviatoric stress", "peak deviator stress",
        "peak deviatoric stress"}},
      {"sigma_ci",
       C::value,
       P::crack_initiation,
       "axial stress at which cracks begin, in the test of UCS",
       {"crack initiation", "crack initiation stress"}},
      {"K_Ic",
       C::value,
       P::fracture_toughness,
       "fracture toughness of a semi-circular bend test, notch along the load",
       {"K_1c", "fracture toughness", "mode I fracture toughness", "mode 1 fracture toughness",
        "fracture toughness K_Ic", "toughness"}},
      {"n",
       C::n,
       P::E,
       "specimens behind the row",
       {"number of specimens", "number of tests", "number of samples", "no. of specimens", "no. of samples",
        "no. of tests", "n specimens", "n samples", "n tests"}},
      {"diameter",
       C::diameter,
       P::E,
       "diameter of the disc of a BTS, of the half disc of a K_Ic",
       {"disc diameter", "disk diameter"}},
      {"confining",
       C::confining,
       P::E,
       "confining stress; empty: none",
       {"sigma_3", "s3", "p_c", "confining pressure", "confining stress", "confinement", "cell pressure",
        "minor principal stress"}},
      {"c", C::cohesion, P::E, "cohesion of an envelope through n tests", {"cohesion"}},
      {"phi",
       C::friction,
       P::E,
       "its angle of friction",
       {"φ", "friction angle", "angle of friction", "internal friction angle", "angle of internal friction"}},
      {"confining_min", C::least_confining, P::E, "least confining stress of these tests", {"sigma_3 min"}},
      {"confining_max", C::most_confining, P::E, "largest confining stress of these tests", {"sigma_3 max"}},
      {"sigma_2",
       C::intermediate,
       P::E,
       "intermediate stress; where it is not `confining` the row is refused",
       {"s2", "intermediate principal stress"}}};
  return known;
}

/// Words of angles, which count from the load in some laboratories, from the horizontal in others.
constexpr std::array angle_words = {
    "angle", "orientation", "inclination", "bedding", "foliation", "schistosity", "theta",
    "beta",  "alpha",       "dip",         "winkel",  "neigung",   "倾角",        "傾角",
    "层理",  "層理",        "угол",        "ngulo",   "inclinac",  "orientac",    "tca"};
/// Words that speak of a direction where no other column does.
constexpr std::array direction_words = {"direction", "cleavage",    "laminat",    "loading", "plug",
                                        "schicht",   "schieferung", "layer",      "stratif", "tilt",
                                        "degrees",   "取芯",        "напластован"};
/// Words of what is read, and of what is not told apart from it.
constexpr std::array value_words = {
    "strength", "stress",   "modul",     "poisson", "young",   "ucs",     "bts",    "dts",
    "cohesion", "friction", "toughness", "kic",     "compres", "tensile", "brazil", "festigkeit",
    "resist",   "résist",   "módul",     "强度",    "強度",    "模量",    "弾性",   "弹性",
    "彈性",     "泊松",     "прочность", "предел",  "модуль",  "пуассон", "сж"};
/// Words of a column that has one of these beside it and is no value: "strain at peak stress".
constexpr std::array other_words = {"load",   "force",  "velocity", "strain",   "rate",       "thickness",
                                    "length", "number", "no",       "diameter", "height",     "width",
                                    "class",  "type",   "mode",     "remark",   "description"};
/// Words around the name of an angle that leave its meaning to the name: "Bedding angle, θ".
constexpr std::array words_beside_names = {"angle",       "bedding", "foliation", "inclination",
                                           "orientation", "of",      "the"};

/// Moduli whose symbol says how they are read (ISRM's suggested methods; waves).
const std::map<std::string, ModulusReading>& moduli() {
  using M = ModulusReading;
  static const std::map<std::string, M> names = {
      {"et", M::tangent_50}, {"et50", M::tangent_50}, {"etan50", M::tangent_50}, {"eav", M::average},
      {"es", M::secant_50},  {"es50", M::secant_50},  {"esec50", M::secant_50},  {"ed", M::small_strain}};
  return names;
}
/// The same in words beside a name: "secant modulus", "Young's modulus (dynamic)".
constexpr std::pair<const char*, ModulusReading> modulus_words[] = {
    {"tangent", ModulusReading::tangent_50}, {"tan", ModulusReading::tangent_50},
    {"average", ModulusReading::average},    {"secant", ModulusReading::secant_50},
    {"sec", ModulusReading::secant_50},      {"dynamic", ModulusReading::small_strain},
    {"dyn", ModulusReading::small_strain}};

constexpr std::pair<const char*, const char*> signs_in_words[] = {
    {"σ", "sigma"},
    {"Σ", "sigma"},
    {"θ", "theta"},
    {"ϑ", "theta"},
    {"β", "beta"},
    {"ν", "nu"},
    {"υ", "nu"},
    {"φ", "phi"},
    {"ϕ", "phi"},
    {"Φ", "phi"},
    {"α", "alpha"},
    {"ψ", "angle"},  // "psi" is a unit of stress
    {"₂", "2"},
    {"₀", "0"},
    {"₁", "1"},
    {"₃", "3"},
    {"−", ""},
    {"–", ""},
    {"—", ""},
    {"‘", ""},
    {"’", ""},
    {"′", ""},
    {"´", ""},
    {"“", ""},
    {"”", ""},
    {"\xC2\xA0", ""},      // a blank that breaks no line
    {"\xE2\x80\x89", ""},  // a thin one
};

/// Lower case of ASCII, of the Latin letters with accents and of Cyrillic (two bytes each in UTF-8).
std::string lower_case(std::string_view text) {
  std::string lower;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
    const auto add = [&](int first, int second) {
      lower += static_cast<char>(first), lower += static_cast<char>(second), ++i;
    };
    if (c == 0xC3 && next >= 0x80 && next <= 0x9E && next != 0x97)
      add(c, next + 0x20);
    else if (c == 0xD0 && next >= 0x90 && next <= 0x9F)
      add(c, next + 0x20);
    else if (c == 0xD0 && next >= 0xA0 && next <= 0xAF)
      add(0xD1, next - 0x20);
    else
      lower += static_cast<char>(std::tolower(c));
  }
  return lower;
}

/// A name as names are compared: lower case, no blanks and signs, Greek letters by their names.
std::string key_of(std::string_view text) {
  std::string key;
  const std::string lower = lower_case(text);
  std::string_view name = lower;
  while (!name.empty()) {
    const auto letter = std::find_if(std::begin(signs_in_words), std::end(signs_in_words),
                                     [&](const auto& l) { return name.starts_with(l.first); });
    if (letter != std::end(signs_in_words)) {
      key += letter->second;
      name.remove_prefix(std::string_view(letter->first).size());
      continue;
    }
    const auto c = static_cast<unsigned char>(name.front());
    if (std::isalnum(c) != 0 || c >= 0x80) key += static_cast<char>(c);
    name.remove_prefix(1);
  }
  return key;
}

template <class List>
bool contains(const List& list, const std::string& key) {
  return std::find(list.begin(), list.end(), key) != list.end();
}

std::string bare(std::string_view s, std::string_view of = " \t") { return std::string(trimmed(s, of)); }

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
      ++open;
      continue;
    }
    unit = joined_units(unit, counts ? inside : known);
    cell = bare(cell.substr(0, open)) + " " + bare(cell.substr(close + 1));
  }
  return bare(cell);
}

bool take_name(const std::string& key, Head& h);
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
  const std::string cell = plain_name(header);
  // Units of toughness hold separators and brackets themselves, "K_Ic MPa sqrt(m)": the longest tail first.
  const char* const separators = "_ ,;:/";
  for (std::size_t at = cell.find_first_of(separators); at != cell.npos;
       at = cell.find_first_of(separators, at + 1))
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
        (inside.find('/') != inside.npos || (inside.size() == 2 && is_ascii(inside))) &&
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
  if (contains(std::array{"log", "log10", "lg", "ln", "sqrt", "exp", "f", "sin", "cos", "tan"}, before))
    return all;
  const std::size_t letters = static_cast<std::size_t>(std::count_if(
      inside.begin(), inside.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80; }));
  if (letters <= 2 || is_name(key_of(inside))) all.push_back(title.substr(0, open) + title.substr(close + 1));
  if (letters > 2) all.push_back(inside);
  return all;
}

/// "UCS_sd", "SD of UCS", "UCS std. dev.": the rest of the name, or nothing.
std::string without_scatter(const std::string& key) {
  for (const std::string word :
       {"standarddeviationof", "standarddeviation", "stddev", "stdev", "std", "sdof", "sd"}) {
    if (key.size() > word.size() && key.ends_with(word)) return key.substr(0, key.size() - word.size());
    if (key.size() > word.size() && key.starts_with(word)) return key.substr(word.size());
  }
  return "";
}

/// Every name of the list, as names are compared.
const std::map<std::string, const Known*>& known_names() {
  static const std::map<std::string, const Known*> names = [] {
    std::map<std::string, const Known*> all;
    for (const Known& k : known_columns()) {
      all.emplace(key_of(k.name), &k);
      for (const char* other : k.others) all.emplace(key_of(other), &k);
    }
    return all;
  }();
  return names;
}

/// Takes a name; false where it is not one of ours or of a laboratory's.
bool take_name(const std::string& key, Head& h) {
  if (const auto known = known_names().find(key); known != known_names().end()) {
    const Known& k = *known->second;
    h.kind = k.kind, h.property = k.property, h.name = k.name, h.deviatoric = h.name == "deviator";
    return true;
  }
  const auto take = [&](ModulusReading reading) {
    h.kind = Column::value, h.property = Property::E, h.name = "E", h.E_is = reading;
    return true;
  };
  if (const auto modulus = moduli().find(key); modulus != moduli().end()) return take(modulus->second);
  for (const auto& [word, reading] : modulus_words) {
    if (key == word + std::string("modulus")) return take(reading);
    const std::size_t n = std::string_view(word).size();
    const std::string rest = key.starts_with(word) ? key.substr(n)
                             : key.ends_with(word) ? key.substr(0, key.size() - n)
                                                   : "";
    if (const auto known = known_names().find(rest); known != known_names().end() &&
                                                     known->second->property == Property::E &&
                                                     known->second->kind == Column::value)
      return take(reading);
  }
  return false;
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

/// The words of a title, as names are compared.
std::vector<std::string> words_of(const std::string& title) {
  std::vector<std::string> words;
  std::size_t from = 0;
  for (std::size_t at = 0; at <= title.size(); ++at)
    if (at == title.size() ||
        std::string_view(" \t_-,;:/()[]{}#.").find(title[at]) != std::string_view::npos) {
      if (std::string key = key_of(title.substr(from, at - from)); !key.empty())
        words.push_back(std::move(key));
      from = at + 1;
    }
  return words;
}

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

template <class List>
bool holds_any(const std::string& key, const List& words) {
  return std::any_of(words.begin(), words.end(),
                     [&](const char* word) { return key.find(word) != key.npos; });
}

/// What a name that is not understood may be about.
void speak(Head& h) {
  const std::string key = key_of(h.title);
  const std::vector<std::string> words = words_of(h.title);
  const bool of_else =
      std::any_of(words.begin(), words.end(), [](const auto& word) { return contains(other_words, word); });
  h.speaks_of_angles = unit_word(h.title) == "deg" || (!of_else && holds_any(key, angle_words));
  h.speaks_of_directions = h.speaks_of_angles || holds_any(key, direction_words);
  const bool named = std::any_of(words.begin(), words.end(), [](const auto& word) {
    Head one;
    return word.size() > 1 && take_name(word, one) && one.kind == Column::value;
  });
  h.speaks_of_values = !of_else && (named || holds_any(key, value_words));
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
    speak(h);
    return h;
  }
  for (const std::string& reading : readings_of(said))
    if (h.kind == Column::other) take_reading(key_of(reading), h);
  if (h.kind == Column::other) take_angle(said, h);
  if (h.kind == Column::other) take_two_names(said, h);
  if (h.kind == Column::other && !h.summary) take_replicate(said, h);
  if (h.kind == Column::other && h.unit.empty()) take_odd_unit(said, h);
  h.summary = h.summary || is_summary(h.title);
  // Which modulus it is the header says, also where the user says that it is E.
  if (!meant.empty() && h.name == "E" && h.kind == Column::value) h.E_is = head_of(cell).E_is;
  if (h.kind == Column::other) speak(h);
  h.own = said.size() == h.name.size() && key_of(said) == key_of(h.name);
  return h;
}

namespace {

/// Does a header name the axis of a plug or of the load, or the layers? Nothing: neither or both.
std::optional<bool> names_an_axis(const std::string& key) {
  const bool layers = holds_any(key, std::array{"bedding", "foliation", "layer", "schist", "cleavage",
                                                "laminat", "strat", "schicht", "层理"});
  const bool axis = holds_any(key, std::array{"load", "plug", "core", "coring", "drill", "axis"});
  if (layers == axis) return {};
  return axis;
}

/// "Parallel to the normal of bedding" is across it, and no word says so alone.
bool names_a_normal(const std::string& key) {
  return holds_any(key, std::array{"pole", "symmetr", "normal"});
}

}  // namespace

std::optional<double> direction_in_words(const std::string& cell, const std::string& header) {
  const std::string key = lower_case(cell), head = lower_case(header);
  // "30° to parallel", "not parallel", "sub-parallel" say something else.
  if (holds_any(key, std::array{"0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "not ", "sub", "near",
                                "oblique"}))
    return {};
  const bool along = holds_any(key, std::array{"parall", "paral", "∥", "||", "//", "параллел", "平行"});
  const bool across = holds_any(key, std::array{"perpend", "⊥", "_|_", "senkrecht", "перпенд", "垂直"});
  if (names_a_normal(head) || ((along || across) && names_a_normal(key))) return {};
  const bool normal = key.starts_with("normal to") || key == "normal" || key == "perp" || key == "perp.";
  if (along != (across || normal)) return along ? 90.0 : 0.0;
  const std::optional<bool> of_axis = names_an_axis(head);
  if (along || !of_axis || !is_upright_or_flat(cell)) return {};
  return key.starts_with('v') != *of_axis ? 90.0 : 0.0;
}

bool is_upright_or_flat(const std::string& cell) {
  return holds_any(" " + lower_case(cell) + " ", std::array{" v ", " h ", " vertical ", " horizontal "}) &&
         cell.size() <= 10;
}

std::optional<std::string> without_degree_sign(const std::string& cell) {
  const std::size_t digits = cell.find_last_of("0123456789");
  if (digits == cell.npos || digits + 1 == cell.size() || unit_word(cell.substr(digits + 1)) != "deg")
    return {};
  return cell.substr(0, digits + 1);
}

bool is_summary(const std::string& cell) {
  if (cell.empty() || cell.size() > 40 || std::isdigit(static_cast<unsigned char>(cell.front())) != 0)
    return false;
  constexpr std::array words = {"mean",
                                "average",
                                "avg",
                                "sd",
                                "std",
                                "stdev",
                                "stddev",
                                "min",
                                "max",
                                "minimum",
                                "maximum",
                                "median",
                                "cov",
                                "cv",
                                "range",
                                "variance",
                                "standarddeviation",
                                "coefficientofvariation",
                                "media",
                                "平均",
                                "标准差"};
  return contains(words, key_of(cell));
}

bool is_scatter(const std::string& header) {
  const std::string cell = header.starts_with("±") ? header.substr(std::string_view("±").size()) : header;
  constexpr std::array words = {
      "sd", "std", "stdev", "stddev", "standarddeviation", "stabw", "standardabweichung"};
  return contains(words, key_of(cell));
}

bool begins_summary(const std::string& cell) {
  if (cell.empty() || cell.size() > 80 || std::isdigit(static_cast<unsigned char>(cell.front())) != 0)
    return false;
  constexpr std::array words = {
      "mean",    "average",  "avg",    "mittel", "mittelwert", "mittelwerte", "durchschnitt",
      "moyenne", "promedio", "media",  "média",  "среднее",    "средние",     "平均",
      "平均值",  "均值",     "标准差", "x̄",      "stdev",      "stabw",       "standardabweichung",
      "desv",    "écart",    "sd"};
  const std::vector<std::string> all = words_of(cell);
  if (all.empty()) return false;
  const bool deviation = (all[0] == "standard" || all[0] == "std" || all[0] == "st") && all.size() > 1 &&
                         all[1].starts_with("dev");
  return deviation || contains(words, all[0]);
}

std::string title_of(const std::string& cell) { return split_head(cell).first; }

bool has_factor(const std::string& title) {
  for (std::size_t at = title.find("10"); at != title.npos; at = title.find("10", at + 1)) {
    const std::string before = bare(title.substr(0, at));
    const std::string_view behind = std::string_view(title).substr(at + 2);
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

Dimension dimension_of(const Head& h) {
  if (h.kind == Column::theta || h.kind == Column::beta || h.kind == Column::friction)
    return Dimension::angle;
  if (h.kind == Column::diameter) return Dimension::length;
  if (h.kind == Column::n || h.property == Property::nu) return Dimension::none;
  if (h.property == Property::fracture_toughness) return Dimension::toughness;
  return Dimension::pressure;
}

std::string usual_unit(const Head& h) {
  switch (dimension_of(h)) {
    case Dimension::angle: return "deg";
    case Dimension::length: return "mm";
    case Dimension::toughness: return "MPa sqrt(m)";
    case Dimension::none: return "";
    default: break;
  }
  const bool modulus = h.property == Property::E && (h.kind == Column::value || h.kind == Column::scatter);
  return modulus ? "GPa" : "MPa";
}

const std::vector<std::string>& column_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Known& k : known_columns()) {
      all.emplace_back(k.name);
      if (k.kind == Column::value) all.push_back(std::string(k.name) + "_sd");
    }
    return all;
  }();
  return names;
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

}  // namespace phy::io
