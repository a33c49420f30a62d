#include "analysis/analyse.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "analysis/crack_strain.hpp"
#include "analysis/cracks.hpp"
#include "analysis/elastic.hpp"
#include "analysis/strength.hpp"
#include "base/nan.hpp"

namespace phy::analysis {
namespace {

std::vector<Number> elastic(const LoadingBranch& branch, const AxialOptions& options, StrainFrom from,
                            const std::string& suffix) {
  return {tangent_modulus(branch, options.tangent, from, "E_tangent" + suffix),
          secant_modulus(branch, options.secant, from, "E_secant" + suffix),
          poisson_ratio(branch, options.tangent, from, "nu" + suffix),
          tangent_modulus(branch, options.small_strain, from, "E_small" + suffix)};
}

}  // namespace

void add(std::vector<Number>& numbers, std::vector<Number> more) {
  numbers.insert(numbers.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

std::vector<Number> common_numbers(const History& history, const LoadingBranch& branch,
                                   const std::vector<CrackEvent>& cracks, const WavePath& path) {
  std::vector<Number> out = crack_numbers(branch, cracks);
  add(out, energy_budget(branch, history));
  add(out, run_checks(branch, history, path));
  return out;
}

std::vector<Number> axial_numbers(const History& history, const LoadingBranch& branch,
                                  const std::vector<CrackEvent>& cracks, const AxialOptions& options) {
  // The strength first: it is what people look for, and what notes are joined to.
  std::vector<Number> out = strength(branch);
  add(out, strength_rule(branch));
  // Platens hold back the ends and dent them: the gauge is the rock's, the platen what a laboratory without
  // gauges reads.
  add(out, elastic(branch, options, StrainFrom::gauge, ""));
  add(out, elastic(branch, options, StrainFrom::platen, "_platen"));
  add(out, window_checks(branch, cracks, options.tangent));
  add(out, crack_initiation(branch, cracks, options.pre_strain));
  out.push_back(crack_initiation_by_strain(branch));
  out.push_back(crack_damage(branch)), out.push_back(crack_damage_volume(branch));
  add(out, common_numbers(history, branch, cracks, options.path));
  return out;
}

std::vector<Number> with_reasons(std::vector<Number> numbers) {
  for (Number& n : numbers) {
    // An infinite number is none either: JSON and CSV have no word for it.
    if (std::isfinite(n.value)) continue;
    n.value = nan;
    if (n.note.empty()) n.note = "the history holds no usable values for it";
  }
  return numbers;
}

void note_slowing(std::vector<Number>& numbers, const LoadingBranch& branch, double from, double to) {
  const AxialOptions usual;
  const auto passed = [&](StressRange range) {
    const auto rows = first_passage(branch, range);
    return !rows.empty() && std::fabs(rows.front().axial_strain) <= to &&
           std::fabs(rows.back().axial_strain) >= from;
  };
  // Ranges of stress are compared by their strains: the speed changed at a strain.
  const bool middle = passed(usual.tangent), start = passed(usual.small_strain);
  for (Number& n : numbers) {
    const bool tangent = n.name.starts_with("E_tangent") || n.name.starts_with("nu");
    const bool small = n.name.starts_with("E_small") || n.name == "sigma_ci_strain";
    if ((tangent && middle) || (small && start))
      n.note = joined(
          n.note,
          fmt::format("the bodies slowed down in this range, at strains of {:.3g} to {:.3g}", from, to));
  }
}

const Number* find(const std::vector<Number>& numbers, const std::string& name) {
  for (const Number& n : numbers)
    if (n.name == name) return &n;
  return nullptr;
}

}  // namespace phy::analysis
