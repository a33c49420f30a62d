#include "io/rock_columns.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <utility>

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
      {"sigma_ci", C::value, P::crack_initiation, {"crackinitiation", "crackinitiationstress"}},
      {"n", C::n, P::E, {"numberofspecimens", "numberoftests", "numberofsamples", "specimens"}},
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

/// Words whose angle counts from the load in some laboratories, from the horizontal in others.
constexpr std::array unclear_angles = {
    "angle",      "orientation",        "beddingangle",         "foliationangle", "anisotropyangle",
    "layerangle", "beddingorientation", "foliationorientation", "alpha",          "psi"};

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
                                                 {"dynamicmodulus", M::small_strain},
                                                 {"dynamicyoungsmodulus", M::small_strain}};
  return names;
}

/// The deviatoric stress at the peak: sigma_1 less the confining stress.
constexpr std::array deviators = {"q",
                                  "sigmad",
                                  "sigma1sigma3",
                                  "deviator",
                                  "deviatorstress",
                                  "deviatoricstress",
                                  "peakdeviatorstress",
                                  "peakdeviatoricstress"};

constexpr std::array<std::pair<const char*, const char*>, 16> letters = {
    {{"σ", "sigma"},
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
     {"\xC2\xA0", ""}}};  // the last: a blank that breaks no line

/// A name as names are compared: lower case, no blanks and signs, Greek letters by their names.
std::string key_of(std::string_view name) {
  std::string key;
  while (!name.empty()) {
    const auto letter = std::find_if(letters.begin(), letters.end(),
                                     [&](const auto& l) { return name.starts_with(l.first); });
    if (letter != letters.end()) {
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

std::string trimmed(std::string_view s, std::string_view of = " \t") {
  const std::size_t from = s.find_first_not_of(of), to = s.find_last_not_of(of);
  return from == s.npos ? "" : std::string(s.substr(from, to - from + 1));
}

/// The program's word for a unit; nothing for what is no unit of a table.
std::string unit_word(const std::string& text) {
  static const std::map<std::string, std::string> same = {
      {"°", "deg"},      {"degree", "deg"}, {"degrees", "deg"}, {"N/mm²", "MPa"},
      {"N/mm2", "MPa"},  {"N/mm^2", "MPa"}, {"MN/m²", "MPa"},   {"MN/m2", "MPa"},
      {"MN/m^2", "MPa"}, {"kN/m²", "kPa"},  {"kN/m2", "kPa"},   {"kN/m^2", "kPa"}};
  const auto found = same.find(text);
  const std::string& word = found == same.end() ? text : found->second;
  for (const Dimension d : {Dimension::pressure, Dimension::angle, Dimension::length})
    if (parse_quantity("1 " + word, d).ok) return word;
  return "";
}

/// "E [GPa]", "E (GPa)", "E, GPa", "E GPa" and "E_GPa" are the same: title and unit. In brackets anything is
/// a unit; a tail counts as one only if it is one ("E_sd" is a name).
std::pair<std::string, std::string> split_head(const std::string& cell) {
  const std::size_t open = cell.find_first_of("[(");
  if (open != cell.npos) {
    const std::string inside = trimmed(cell.substr(open + 1, cell.find_first_of("])", open) - open - 1));
    const std::string known = unit_word(inside);
    return {trimmed(cell.substr(0, open)), known.empty() ? inside : known};
  }
  if (cell.ends_with("°")) return {trimmed(cell.substr(0, cell.size() - 2)), "deg"};
  const std::size_t bar = cell.find_last_of("_ ,;/");
  // "N/mm2" holds a separator itself: the tail that begins a word earlier is tried too.
  for (std::size_t at = bar; at != cell.npos && at > 0; at = cell.find_last_of("_ ,;/", at - 1)) {
    const std::string unit = unit_word(cell.substr(at + 1));
    if (!unit.empty()) return {trimmed(cell.substr(0, at), " \t_,;/"), unit};
    if (cell[at] != '/') break;
  }
  return {trimmed(cell), ""};
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
      h.kind = k.kind, h.property = k.property, h.name = k.name;
      return true;
    }
  if (const auto modulus = moduli().find(key); modulus != moduli().end()) {
    h.kind = Column::value, h.property = Property::E, h.name = "E", h.E_is = modulus->second;
    return true;
  }
  if (contains(deviators, key)) {
    h.kind = Column::value, h.property = Property::confined, h.name = "sigma_1", h.deviatoric = true;
    return true;
  }
  return false;
}

}  // namespace

Head head_of(const std::string& cell, const std::string& meant) {
  Head h;
  std::tie(h.title, h.unit) = split_head(cell);
  const std::string key = key_of(meant.empty() ? h.title : meant);
  h.name = key;
  if (meant == "-") {
    h.kind = Column::passed;
    return h;
  }
  // "mean UCS" is UCS; how far the errors of c and phi go together no table says.
  const std::string bare = key.starts_with("mean") ? key.substr(4)
                           : key.ends_with("mean") ? key.substr(0, key.size() - 4)
                                                   : key;
  const std::string of = without_scatter(key);
  if (!take_name(bare, h) && !of.empty() && take_name(of, h)) {
    const bool scatters = h.kind == Column::value && !h.deviatoric;
    h.kind = scatters ? Column::scatter : Column::other;
    if (scatters) h.name += "_sd", h.E_is.reset();
    if (!scatters) h.name = key, h.unit.clear();
  }
  if (h.kind == Column::other && contains(unclear_angles, key)) h.kind = Column::unclear;
  const std::string own = meant.empty() ? h.title : meant;
  h.own = own.size() == h.name.size() && key_of(own) == key_of(h.name);
  return h;
}

std::string title_of(const std::string& cell) { return split_head(cell).first; }

std::string unit_of_cell(const std::string& cell) {
  return unit_word(cell.starts_with('[') || cell.starts_with('(') ? trimmed(cell, "[]() \t") : cell);
}

Dimension dimension_of(const Head& h) {
  if (h.kind == Column::theta || h.kind == Column::beta || h.kind == Column::friction)
    return Dimension::angle;
  if (h.kind == Column::diameter) return Dimension::length;
  if (h.kind == Column::n || h.property == Property::nu) return Dimension::none;
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
