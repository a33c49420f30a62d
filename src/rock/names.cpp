#include "rock/names.hpp"

#include <array>
#include <cctype>
#include <map>
#include <utility>

#include "base/units.hpp"

namespace phy::rock {
namespace {

/// Words of angles, which count from the load in some laboratories, from the horizontal in others.
/// Stems, which several languages share; "ngulo" is written with an accent in front, or without.
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

/// Every name of the list, as names are compared.
const std::map<std::string, const Known*>& known_by_key() {
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

/// A column of values for every property that a laboratory measures.
void add_properties(std::vector<Known>& known) {
  for (const MeasuredProperty& p : measured_properties()) {
    known.push_back({p.name, Column::value, p.property, p.meaning, p.headers});
    if (!p.deviator_headers.empty())
      known.push_back(
          {"deviator", Column::value, p.property, "sigma_1 - sigma_3 at the peak", p.deviator_headers});
  }
}

constexpr Property none = Property::E;  // of columns without values

/// Columns that say how the layers lie.
std::vector<Known> angle_columns() {
  using C = Column;
  return {{"theta",
           C::theta,
           none,
           "inclination of the layers, load upright: 0 = across the load, 90 = along it",
           {"θ", "dip", "dip angle", "inclination", "bedding inclination", "bedding dip", "bedding dip angle",
            "foliation dip", "foliation dip angle", "foliation inclination", "angle theta"}},
          {"beta", C::beta, none, "angle between load and layers: 90 - theta", {"β", "angle beta"}}};
}

/// Columns that say how a row was tested.
std::vector<Known> columns_of_tests() {
  using C = Column;
  return {
      {"n",
       C::n,
       none,
       "specimens behind the row",
       {"number of specimens", "number of tests", "number of samples", "no. of specimens", "no. of samples",
        "no. of tests", "n specimens", "n samples", "n tests"}},
      {"diameter",
       C::diameter,
       none,
       "diameter of the disc of a BTS, of the half disc of a K_Ic",
       {"disc diameter", "disk diameter"}},
      {"confining",
       C::confining,
       none,
       "confining stress; empty: none",
       {"sigma_3", "s3", "p_c", "confining pressure", "confining stress", "confinement", "cell pressure",
        "minor principal stress"}},
      {"c", C::cohesion, none, "cohesion of an envelope through n tests", {"cohesion"}},
      {"phi",
       C::friction,
       none,
       "its angle of friction",
       {"φ", "friction angle", "angle of friction", "internal friction angle", "angle of internal friction"}},
      {"confining_min", C::least_confining, none, "least confining stress of these tests", {"sigma_3 min"}},
      {"confining_max", C::most_confining, none, "largest confining stress of these tests", {"sigma_3 max"}},
      {"sigma_2",
       C::intermediate,
       none,
       "intermediate stress; where it is not `confining` the row is refused",
       {"s2", "intermediate principal stress"}},
      {"sigma_n",
       C::normal,
       none,
       "normal stress across sheared bedding, of tau_peak and tau_residual",
       {"s_n", "normal stress"}}};
}

}  // namespace

/// The one list: readers, messages and docs/tables.md follow it. Left out on purpose: "d" and "no", which
/// mean other things too.
const std::vector<Known>& known_columns() {
  static const std::vector<Known> known = [] {
    std::vector<Known> all = angle_columns();
    add_properties(all);
    const std::vector<Known> others = columns_of_tests();
    all.insert(all.end(), others.begin(), others.end());
    return all;
  }();
  return known;
}

/// Lower case of ASCII, of the Latin letters with accents and of Cyrillic (two bytes each in UTF-8).
std::string lower_case(std::string_view text) {
  std::string lower;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0;
    const auto add = [&](int first, int second) {
      lower += static_cast<char>(first), lower += static_cast<char>(second), ++i;
    };
    // 0x97 is the sign of multiplication, which stands among the letters and has no lower case.
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
    // Letters beyond ASCII stay as they are: names in other scripts are compared byte by byte.
    if (std::isalnum(c) != 0 || c >= 0x80) key += static_cast<char>(c);
    name.remove_prefix(1);
  }
  return key;
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

const Known* known_column(const std::string& key) {
  const auto known = known_by_key().find(key);
  return known == known_by_key().end() ? nullptr : known->second;
}

std::optional<ModulusReading> modulus_of(const std::string& key) {
  if (const auto modulus = moduli().find(key); modulus != moduli().end()) return modulus->second;
  for (const auto& [word, reading] : modulus_words) {
    if (key == word + std::string("modulus")) return reading;
    const std::size_t n = std::string_view(word).size();
    const std::string rest = key.starts_with(word) ? key.substr(n)
                             : key.ends_with(word) ? key.substr(0, key.size() - n)
                                                   : "";
    if (const Known* known = known_column(rest);
        known != nullptr && known->property == Property::E && known->kind == Column::value)
      return reading;
  }
  return {};
}

Subjects subjects_of(const std::string& title) {
  const std::string key = key_of(title);
  const std::vector<std::string> words = words_of(title);
  const auto any_word = [&](const auto& is) { return std::any_of(words.begin(), words.end(), is); };
  const bool of_else = any_word([](const std::string& word) { return contains(other_words, word); });
  const bool named = any_word([](const std::string& word) {
    // A single letter names something in every laboratory: "batch c" holds no cohesion.
    const Known* known = word.size() > 1 ? known_column(word) : nullptr;
    return (known != nullptr && known->kind == Column::value) || (word.size() > 1 && modulus_of(word));
  });
  const auto unit = find_unit(title);
  Subjects about;
  about.angles = (unit && unit->name == "deg") || (!of_else && holds_any(key, angle_words));
  // Whatever may be an angle may be a direction: "bedding" stands above both.
  about.directions = about.angles || holds_any(key, direction_words);
  about.values = !of_else && (named || holds_any(key, value_words));
  return about;
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

bool is_summary(const std::string& cell) {
  // A longer cell is a remark, and one that begins with a digit a value.
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

}  // namespace phy::rock
