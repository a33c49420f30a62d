#include "analysis/analyse.hpp"

#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "analysis/cracks.hpp"
#include "analysis/elastic.hpp"
#include "analysis/energy.hpp"
#include "analysis/strength.hpp"

namespace phy {
namespace {

std::vector<Number> elastic(const LoadingBranch& branch, const AnalysisOptions& options, StrainFrom from,
                            const std::string& suffix) {
  return {tangent_modulus(branch, options.tangent, from, "E_tangent" + suffix),
          secant_modulus(branch, options.secant, from, "E_secant" + suffix),
          poisson_ratio(branch, options.tangent, from, "nu" + suffix),
          tangent_modulus(branch, options.small_strain, from, "E_small" + suffix)};
}

}  // namespace

const Number* find(const std::vector<Number>& numbers, const std::string& name) {
  for (const Number& n : numbers)
    if (n.name == name) return &n;
  return nullptr;
}

std::vector<Number> analyse(const History& history, const std::vector<CrackEvent>& cracks,
                            const AnalysisOptions& options) {
  const LoadingBranch branch = loading_branch(history);
  std::vector<Number> out = strength(branch);
  const auto add = [&out](std::vector<Number> more) {
    out.insert(out.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  add(elastic(branch, options, StrainFrom::gauge, ""));
  add(elastic(branch, options, StrainFrom::platen, "_platen"));
  add(crack_initiation(branch, cracks, options.jump_strain));
  out.push_back(crack_damage(branch));
  add(crack_numbers(branch, cracks));
  add(energy_budget(branch, history));
  add(run_checks(branch, history));
  for (Number& n : out) {
    if (std::isfinite(n.value)) continue;
    n.value = std::numeric_limits<double>::quiet_NaN();
    if (n.note.empty()) n.note = "the history holds no usable values for it";
  }
  return out;
}

}  // namespace phy
