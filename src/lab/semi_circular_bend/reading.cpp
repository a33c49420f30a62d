#include "lab/semi_circular_bend/reading.hpp"

#include <fmt/format.h>

#include <cmath>

#include "analysis/analyse.hpp"
#include "analysis/strength.hpp"
#include "base/exact_math.hpp"
#include "base/nan.hpp"

namespace phy::lab {
namespace {

/// a/R of a specimen is that of its grains: what is as near to a bound as this counts as within.
constexpr double in_range = 0.01;

}  // namespace

double bend_factor(double notch_ratio, double span_ratio) {
  // Kuruppu et al. (2014), for a/R of 0.4 to 0.6 and s/2R of 0.5 to 0.8.
  const double b = notch_ratio, s = span_ratio;
  return -1.297 + 9.516 * s - (0.47 + 16.457 * s) * b + (1.071 + 34.401 * s) * b * b;
}

double isotropic_K_I(const BendSpecimen& specimen, double nominal_stress) {
  const double R = specimen.radius, a = specimen.notch;
  return bend_factor(a / R, 0.5 * specimen.span / R) * std::sqrt(pi * a) * nominal_stress;
}

std::vector<Number> toughness(const analysis::LoadingBranch& branch, const BendSpecimen& specimen) {
  const std::string note = analysis::branch_note(branch);
  const auto at_peak = [&](double value) { return branch.peaked ? value : nan; };
  const double R = specimen.radius, notch_ratio = specimen.notch / R;
  // The factor is a fit: outside its range it is not wrong by a known amount.
  const bool published = notch_ratio >= 0.4 - in_range && notch_ratio <= 0.6 + in_range;
  const std::string outside =
      published ? "" : fmt::format("a/R = {:.3f}, the factor is published for 0.4 - 0.6", notch_ratio);
  return {{"K_Ic_apparent", at_peak(isotropic_K_I(specimen, branch.largest)), "Pa sqrt(m)",
           "apparent K_Ic, isotropic factor of Kuruppu et al. 2014: Y' sqrt(pi a) P_max/(2 R B)",
           analysis::joined(note, outside)},
          {"bend_strength", at_peak(branch.largest), "Pa", "largest nominal stress P/(2 R B)", note},
          {"P_max", at_peak(2.0 * R * branch.largest), "N/m",
           "largest load per thickness, mean of loading and support rollers", note},
          {"u_peak", at_peak(branch.strain), "m", "load-point displacement at P_max", note},
          {"mouth_opening_at_peak", at_peak(branch.empty() ? nan : branch.rows.back().mouth_opening), "m",
           "crack mouth opening at P_max", note},
          {"notch_length", specimen.notch, "m",
           "a, from the flat face to the centre of the first grain on the axis", ""},
          {"Y_prime", bend_factor(notch_ratio, 0.5 * specimen.span / R), "1",
           "factor Y' of an isotropic body, Kuruppu et al. 2014", ""}};
}

std::vector<Number> bend_numbers(const History& history, const std::vector<CrackEvent>& cracks,
                                 const BendSpecimen& specimen, double density) {
  const analysis::LoadingBranch branch = analysis::loading_branch(history);
  std::vector<Number> out = toughness(branch, specimen);
  analysis::add(out, analysis::crack_initiation(branch, cracks, 0.0));
  const double diameter = 2.0 * specimen.radius;  // the loading column is a displacement, no strain
  analysis::add(out, analysis::common_numbers(history, branch, cracks,
                                              {density, specimen.radius, bend_compliance * diameter}));
  return out;
}

}  // namespace phy::lab
