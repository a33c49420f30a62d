#include "io/rock_columns.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <utility>

#include "base/trimmed.hpp"

namespace phy::io {
namespace {

/// A column: our name, and what laboratories call it, as key_of() has it.
struct Known {
  const char* name;
  Column kind;
  Property property;
  std::vector<const char*> others;
};

/// The one list. Left out on purpose: "d" and "no", which mean other things too.
const std::vector<Known>& known_columns() {
  using C = Column;
  using P = Property;
  static const std::vector<Known> known = {
      {"theta",
       C::theta,
       P::E,
       {"dip", "dipangle", "inclination", "beddinginclination", "beddingdip", "beddingdipangle",
        "foliationdip", "foliationdipangle", "foliationinclination"}},
      {"beta", C::beta, P::E, {}},
      {"E",
       C::value,
       P::E,
       {"e50", "young", "youngmodulus", "youngsmodulus", "elasticmodulus", "modulusofelasticity",
        "deformationmodulus", "modulusofdeformation"}},
      {"nu", C::value, P::nu, {"v", "poisson", "poissonratio", "poissonsratio"}},
      {"UCS",
       C::value,
       P::ucs,
       {"sigmac", "sigmaucs", "qu", "uniaxialcompressivestrength", "unconfinedcompressivestrength",
        "uniaxialstrength", "compressivestrength", "peakstrength"}},
      {"DTS",
       C::value,
       P::direct_tension,
       {"directtensilestrength", "directtension", "uniaxialtensilestrength"}},
      {"BTS",
       C::value,
       P::brazilian,
       {"sigmat", "sigmabt", "brazilianstrength", "braziliantensilestrength", "indirecttensilestrength",
        "splittingtensilestrength", "tensilestrength", "its"}},
      {"sigma_1", C::value, P::confined, {"s1", "majorprincipalstress", "axialstressatfailure"}},
      {"deviator",
       C::value,
       P::confined,
       {"q", "sigmad", "sigma1sigma3", "deviatorstress", "deviatoricstress", "peakdeviatorstress",
        "peakdeviatoricstress"}},
      {"sigma_ci", C::value, P::crack_initiation, {"crackinitiation", "crackinitiationstress"}},
      {"K_Ic",
       C::value,
       P::fracture_toughness,
       {"k1c", "fracturetoughness", "modeifracturetoughness", "mode1fracturetoughness",
        "fracturetoughnesskic", "toughness"}},
      {"n", C::n, P::E, {"numberofspecimens", "numberoftests", "numberofsamples"}},
      {"diameter", C::diameter, P::E, {"discdiameter", "diskdiameter"}},
      {"confining",
       C::confining,
       P::E,
       {"sigma3", "s3", "pc", "confiningpressure", "confiningstress", "confinement", "cellpressure",
        "minorprincipalstress"}},
      {"c", C::cohesion, P::E, {"cohesion"}},
      {"phi",
       C::friction,
       P::E,
       {"frictionangle", "angleoffriction", "internalfrictionangle", "angleofinternalfriction"}},
      {"confining_min", C::least_confining, P::E, {"sigma3min"}},
      {"confining_max", C::most_confining, P::E, {"sigma3max"}}};
  return known;
}

/// Words of angles, which count from the load in some laboratories, from the horizontal in others.
constexpr std::array angle_words = {"angle",     "orientation", "inclination", "bedding",
                                    "foliation", "schistosity", "theta",       "beta",
                                    "alpha",     "psi",         "dip"};

/// Moduli whose name says how they are read (ISRM's suggested methods; waves).
const std::map<std::string, ModulusReading>& moduli() {
  using M = ModulusReading;
  static const std::map<std::string, M> names = {{"et", M::tangent_50},
                                                 {"et50", M::tangent_50},
                                                 {"etan", M::tangent_50},
                                                 {"etan50", M::tangent_50},
                                                 {"tangentmodulus", M::tangent_50},
                                                 {"tangentyoungsmodulus", M::tangent_50},
                                                 {"eav", M::average},
                                                 {"averagemodulus", M::average},
                                                 {"averageyoungsmodulus", M::average},
                                                 {"es", M::secant_50},
                                                 {"es50", M::secant_50},
                                                 {"esec", M::secant_50},
                                                 {"esec50", M::secant_50},
                                                 {"secantmodulus", M::secant_50},
                                                 {"secantyoungsmodulus", M::secant_50},
                                                 {"ed", M::small_strain},
                                                 {"edyn", M::small_strain},
                                                 {"edynamic", M::small_strain},
                                                 {"dynamicmodulus", M::small_strain},
                                                 {"dynamicyoungsmodulus", M::small_strain}};
  return names;
}

constexpr std::array<std::pair<const char*, const char*>, 26> signs_in_words = {{
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
    {"ψ", "psi"},
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
}};

/// A name as names are compared: lower case, no blanks and signs, Greek letters by their names.
std::string key_of(std::string_view name) {
  std::string key;
  while (!name.empty()) {
    const auto letter = std::find_if(signs_in_words.begin(), signs_in_words.end(),
                                     [&](const auto& l) { return name.starts_with(l.first); });
    if (letter != signs_in_words.end()) {
      key += letter->second;
      name.remove_prefix(std::string_view(letter->first).size());
      continue;
    }
    const auto c = static_cast<unsigned char>(name.front());
    if (std::isalnum(c) != 0 || c >= 0x80) key += static_cast<char>(std::tolower(c));
    name.remove_prefix(1);
  }
  return key;
}

template <class List>
bool contains(const List& list, const std::string& key) {
  return std::find(list.begin(), list.end(), key) != list.end();
}

std::string bare(std::string_view s, std::string_view of = " \t") { return std::string(trimmed(s, of)); }

std::string without(std::string text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at))
      text.erase(at, part.size());
  return text;
}

/// "MPa m^0.5", "MPa√m", "MN/m^1.5", "kPa·m^(1/2)" and so on: the program's word for a unit of fracture
/// toughness; nothing for any other. `text`: in lower case.
std::string toughness_word(const std::string& text) {
  const std::string bare =
      without(text, {" ", "_", "\xC2\xA0", "·", "⋅", "*", ".", "^", "(", ")", "{", "}"});  // "m^0.5" is "m05"
  for (const auto& [stress, force, ours] :
       {std::array{"mpa", "mn", "MPa sqrt(m)"}, std::array{"kpa", "kn", "kPa sqrt(m)"},
        std::array{"pa", "n", "Pa sqrt(m)"}}) {
    for (const char* root : {"m05", "m1/2", "m½", "√m", "sqrtm", "rootm"})
      if (bare == stress + std::string(root)) return ours;
    for (const char* power : {"/m15", "/m3/2", "m-15", "m-3/2", "m−15", "m−3/2"})
      if (bare == force + std::string(power)) return ours;
  }
  return "";
}

std::string lower_case(const std::string& text) {
  std::string lower;
  for (const char c : text) lower += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

/// The program's word for a unit; nothing for what is no unit of a table.
std::string unit_word(std::string text) {
  static const std::map<std::string, std::string> same = {
      {"°", "deg"},       {"º", "deg"},      {"degree", "deg"}, {"degrees", "deg"}, {"n/mm²", "MPa"},
      {"n/mm2", "MPa"},   {"n/mm^2", "MPa"}, {"mn/m²", "MPa"},  {"mn/m2", "MPa"},   {"mn/m^2", "MPa"},
      {"kn/m²", "kPa"},   {"kn/m2", "kPa"},  {"kn/m^2", "kPa"}, {"kn/mm²", "GPa"},  {"kn/mm2", "GPa"},
      {"kn/mm^2", "GPa"}, {"gn/m2", "GPa"},  {"pa", "Pa"},      {"kpa", "kPa"},     {"mpa", "MPa"},
      {"gpa", "GPa"},     {"deg", "deg"}};
  text = without(std::move(text), {"\xC2\xA0", " "});
  if (text.ends_with('.')) text.pop_back();
  const std::string lower = lower_case(text);
  if (std::string toughness = toughness_word(lower); !toughness.empty()) return toughness;
  if (const auto found = same.find(lower); found != same.end()) return found->second;
  return parse_quantity("1 " + text, Dimension::length).ok ? text : "";
}

/// The bracket that closes the one at `open`; where none does, the first that closes any.
std::size_t closing(const std::string& cell, std::size_t open) {
  int depth = 0;
  for (std::size_t at = open; at < cell.size(); ++at) {
    if (cell[at] == '[' || cell[at] == '(') ++depth;
    if ((cell[at] == ']' || cell[at] == ')') && --depth == 0) return at;
  }
  return cell.find_first_of("])", open);
}

/// Takes "[GPa]" and "(GPa)" out of a header, wherever they stand; the last one is its unit.
std::string take_units(std::string cell, std::string& unit) {
  for (std::size_t open = cell.find_first_of("[("); open != cell.npos;
       open = cell.find_first_of("[(", open)) {
    const std::size_t close = closing(cell, open);
    if (close == cell.npos) break;
    const std::string inside = bare(cell.substr(open + 1, close - open - 1)), known = unit_word(inside);
    const bool counts = inside.empty() || inside == "-" || inside == "1" || inside == "%";
    if (known.empty() && !counts) {
      ++open;
      continue;
    }
    unit = known.empty() ? inside : known;
    cell = bare(cell.substr(0, open)) + " " + bare(cell.substr(close + 1));
  }
  return bare(cell);
}

bool take_name(const std::string& key, Head& h);
bool is_name(const std::string& key) {
  Head none;
  return take_name(key, none);
}

/// "E [GPa]", "E (GPa)", "E, GPa", "E GPa" and "E_GPa" are the same: title and unit. Behind a separator a
/// tail counts as a unit only if it is one ("E_sd" is a name); so does what stands in the last brackets.
std::pair<std::string, std::string> split_head(const std::string& cell) {
  // Units of toughness hold separators and brackets themselves, "K_Ic MPa sqrt(m)": the longest tail first.
  const char* const separators = "_ ,;/";
  for (std::size_t at = cell.find_first_of(separators); at != cell.npos;
       at = cell.find_first_of(separators, at + 1))
    if (std::string word = toughness_word(lower_case(cell.substr(at + 1))); at > 0 && !word.empty())
      return {bare(cell.substr(0, at), " \t_,;/"), word};
  std::string unit;
  std::string title = take_units(cell, unit);
  if (!unit.empty() || title != bare(cell)) return {title, unit};
  for (const std::string degree : {"°", "º"})
    if (title.ends_with(degree)) return {bare(title.substr(0, title.size() - degree.size())), "deg"};
  // "N/mm2" holds a separator itself: the tail that begins a word earlier is tried too.
  for (std::size_t at = title.find_last_of("_ ,;/"); at != title.npos && at > 0;
       at = title.find_last_of("_ ,;/", at - 1)) {
    if (unit = unit_word(title.substr(at + 1)); !unit.empty())
      return {bare(title.substr(0, at), " \t_,;/"), unit};
    if (title[at] != '/') break;
  }
  // A unit of none of our columns, "[km/s]": the last brackets hold it.
  const std::size_t open = title.find_last_of("[("), close = title.find_last_of("])");
  if (open != title.npos && open > 0 && close == title.size() - 1 && close > open)
    if (const std::string inside = bare(title.substr(open + 1, close - open - 1));
        (inside.find('/') != inside.npos || inside.size() <= 2) && !is_name(key_of(inside)))
      return {bare(title.substr(0, open)), inside};
  return {title, ""};
}

/// What a title may say: "compressive strength (UCS)" its words, or what stands in brackets. A letter or two
/// there may be anything: "porosity (n)".
std::vector<std::string> readings_of(const std::string& title) {
  std::vector<std::string> all = {title};
  const std::size_t open = title.find_first_of("[("), close = title.find_first_of("])", open);
  if (open == title.npos || close == title.npos) return all;
  all.push_back(title.substr(0, open) + title.substr(close + 1));
  if (close - open > 3) all.push_back(title.substr(open + 1, close - open - 1));
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

/// Takes a name; false where it is not one of ours or of a laboratory's.
bool take_name(const std::string& key, Head& h) {
  for (const Known& k : known_columns())
    if (key == key_of(k.name) || contains(k.others, key)) {
      h.kind = k.kind, h.property = k.property, h.name = k.name, h.deviatoric = h.name == "deviator";
      return true;
    }
  if (const auto modulus = moduli().find(key); modulus != moduli().end()) {
    h.kind = Column::value, h.property = Property::E, h.name = "E", h.E_is = modulus->second;
    return true;
  }
  return false;
}

/// "mean UCS" is UCS; how far the errors of c and phi go together no table says.
void take_reading(const std::string& key, Head& h) {
  const std::string name = key.starts_with("mean") ? key.substr(4)
                           : key.ends_with("mean") ? key.substr(0, key.size() - 4)
                                                   : key;
  const std::string of = without_scatter(key);
  if (take_name(name, h) || of.empty() || !take_name(of, h)) return;
  const bool scatters = h.kind == Column::value;
  h.kind = scatters ? Column::scatter : Column::other;
  h.name = scatters ? h.name + "_sd" : key, h.deviatoric = false, h.E_is.reset();
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
  for (const std::string& reading : readings_of(meant.empty() ? h.title : meant))
    if (h.kind == Column::other) take_reading(key_of(reading), h);
  const std::string key = key_of(h.title);
  h.speaks_of_toughness =
      h.kind == Column::other && (key.starts_with("kic") || key.find("toughness") != key.npos);
  if (h.kind == Column::other)
    h.speaks_of_angles = std::any_of(angle_words.begin(), angle_words.end(),
                                     [&](const char* word) { return key.find(word) != key.npos; });
  const std::string own = meant.empty() ? h.title : meant;
  h.own = own.size() == h.name.size() && key_of(own) == key_of(h.name);
  return h;
}

bool is_summary(const std::string& cell) {
  constexpr std::array words = {
      "mean",    "average", "avg",     "sd",     "std", "stdev", "stddev", "standarddeviation", "min",
      "minimum", "max",     "maximum", "median", "cov", "cv",    "range",  "variance"};
  return contains(words, key_of(cell));
}

std::string title_of(const std::string& cell) { return split_head(cell).first; }

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

}  // namespace phy::io
