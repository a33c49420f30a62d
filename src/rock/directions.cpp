#include "rock/directions.hpp"

#include <array>

#include "base/units.hpp"
#include "rock/names.hpp"

namespace phy::rock {
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

/// "V", "H", "vertical", "horizontal".
bool is_upright_or_flat(const std::string& cell) {
  return holds_any(" " + lower_case(cell) + " ", std::array{" v ", " h ", " vertical ", " horizontal "}) &&
         cell.size() <= 10;
}

bool is_degree(const std::string& text) {
  const auto unit = find_unit(text);
  return unit && unit->name == "deg";
}

}  // namespace

std::optional<double> direction_in_words(const std::string& cell, const std::string& header) {
  // "30° to bedding" holds the word and another angle.
  if (cell.find_first_of("0123456789") != cell.npos) return {};
  const std::string key = lower_case(cell), head = lower_case(header);
  // "30° to parallel", "not parallel", "sub-parallel" say something else.
  if (holds_any(key, std::array{"not ", "sub", "near", "oblique"})) return {};
  const bool along = holds_any(key, std::array{"parall", "paral", "∥", "||", "//", "параллел", "平行"});
  const bool across = holds_any(key, std::array{"perpend", "⊥", "_|_", "senkrecht", "перпенд", "垂直"});
  if (names_a_normal(head) || ((along || across) && names_a_normal(key))) return {};
  const bool normal = key.starts_with("normal to") || key == "normal" || key == "perp" || key == "perp.";
  // Both words in one cell leave open which of them is about the load.
  if (along != (across || normal)) return along ? 90.0 : 0.0;
  const std::optional<bool> of_axis = names_an_axis(head);
  if (along || !of_axis || !is_upright_or_flat(cell)) return {};
  // Upright layers lie along the load. An upright plug is drilled across layers that lie flat.
  return key.starts_with('v') != *of_axis ? 90.0 : 0.0;
}

std::optional<std::string> without_degree_sign(const std::string& cell) {
  const std::size_t digits = cell.find_last_of("0123456789");
  if (digits == cell.npos || digits + 1 == cell.size() || !is_degree(cell.substr(digits + 1))) return {};
  return cell.substr(0, digits + 1);
}

}  // namespace phy::rock
