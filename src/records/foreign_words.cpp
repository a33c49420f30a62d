#include "records/foreign_words.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/trimmed.hpp"

namespace phy {
namespace {

struct Variable {
  const char *word, *path;
};
constexpr Variable variables[] = {
    {"rdmin", "packing.radius_min"}, {"rmin", "packing.radius_min"},  {"r_min", "packing.radius_min"},
    {"rlo", "packing.radius_min"},   {"rdmax", "packing.radius_max"}, {"rmax", "packing.radius_max"},
    {"r_max", "packing.radius_max"}, {"rhi", "packing.radius_max"},   {"poro", "packing.porosity"},
    {"wlx", "specimen.width"},       {"wly", "specimen.height"},
};

struct Absent {
  const char *words, *instead;
};
// Words without a key: said why, since a script that is carried over has them, and they change results there.
constexpr Absent absent[] = {
    {"rgap lin_gap",
     "it has no key: overlaps of a new packing are free of stress (packing.initial_stress = "
     "\"stress_free\")"},
    {"dp_nratio dp_sratio dp_mode",
     "it has no key: specimens have no dashpots; engine.damping is PFC's local damping, damp"},
    {"kn ks lin_kn lin_ks",
     "it has no key: stiffnesses of contacts follow from matrix.E_c and matrix.ks_over_kn"},
    {"pb_kn pb_ks", "it has no key: stiffnesses of bonds follow from matrix.E_b and matrix.bond_ks_over_kn"},
    {"fj_kn fj_ks", "it has no key: stiffnesses follow from matrix.E_c and matrix.ks_over_kn"},
    {"fj_radius pb_radius sj_radius", "it has no key: radius_multiplier times the smaller grain radius"},
    {"timestep", "it has no key: the stable step is computed, and engine.step_safety is a share of it"},
};

/// The part of "1/kratio, 1/fj_kratio" that has the word.
std::string formula_of(const Field& f, const std::string& word) {
  Field part;
  std::string_view rest = f.pfc_name;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(','), rest.size());
    part.pfc_name = trimmed(rest.substr(0, end));
    if (has_pfc_name(part, word)) return part.pfc_name;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return "";
}

bool has_word(std::string_view words, const std::string& word) {
  Field list;
  list.pfc_name = words;
  return has_pfc_name(list, word);
}

}  // namespace

ForeignWord foreign_word(const Fields& fields, const std::string& word, const std::string& table) {
  const Field* found = nullptr;
  for (const Field& f : fields)
    // Friction stands in several tables. Whoever writes below [matrix] means the matrix.
    if (has_pfc_name(f, word) && (found == nullptr || (f.table == table && found->table != table)))
      found = &f;
  if (found != nullptr) return {found, formula_of(*found, word), ""};
  // Properties of PFC first: a variable of a script may have any name, a property has one.
  for (const Variable& v : variables)
    if (word == v.word) return {find_field(fields, v.path), word, ""};
  for (const Absent& a : absent)
    if (has_word(a.words, word)) return {nullptr, "", a.instead};
  return {};
}

double value_of(const ForeignWord& word, double theirs) {
  if (word.formula.starts_with("1/")) return 1.0 / theirs;
  // A dip counts the other way round; planes are the same after half a turn.
  if (word.formula.starts_with("180 - ")) return std::fmod(std::fmod(180.0 - theirs, 180.0) + 180.0, 180.0);
  return theirs;
}

}  // namespace phy
