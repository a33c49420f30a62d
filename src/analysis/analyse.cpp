#include "analysis/analyse.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "analysis/brazilian.hpp"
#include "analysis/confined.hpp"
#include "analysis/cracks.hpp"
#include "analysis/elastic.hpp"
#include "analysis/energy.hpp"
#include "analysis/strength.hpp"
#include "analysis/tension.hpp"

namespace phy {
namespace {

std::vector<Number> elastic(const LoadingBranch& branch, const AnalysisOptions& options, StrainFrom from,
                            const std::string& suffix) {
  return {tangent_modulus(branch, options.tangent, from, "E_tangent" + suffix),
          secant_modulus(branch, options.secant, from, "E_secant" + suffix),
          poisson_ratio(branch, options.tangent, from, "nu" + suffix),
          tangent_modulus(branch, options.small_strain, from, "E_small" + suffix)};
}

void add(std::vector<Number>& out, std::vector<Number> more) {
  out.insert(out.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// What every kind of test has.
void add_cracks_energies_checks(std::vector<Number>& out, const History& history, const LoadingBranch& branch,
                                const std::vector<CrackEvent>& cracks, const WavePath& path) {
  add(out, crack_numbers(branch, cracks));
  add(out, energy_budget(branch, history));
  add(out, run_checks(branch, history, path));
}

/// A specimen loaded along its axis: strength, elasticity, damage, cracks, energies, checks.
std::vector<Number> press(const History& history, const LoadingBranch& branch,
                          const std::vector<CrackEvent>& cracks, const AnalysisOptions& options) {
  std::vector<Number> out = strength(branch);
  add(out, elastic(branch, options, StrainFrom::gauge, ""));
  add(out, elastic(branch, options, StrainFrom::platen, "_platen"));
  add(out, crack_initiation(branch, cracks, options.jump_strain));
  out.push_back(crack_damage(branch));
  add_cracks_energies_checks(out, history, branch, cracks, {options.density, options.length});
  return out;
}

std::vector<Number> tension(const History& history, const std::vector<CrackEvent>& cracks,
                            const AnalysisOptions& options) {
  const History pulled = mirrored(history);
  LoadingBranch branch = loading_branch(pulled);
  branch.strength = "sigma_t", branch.tool = "grip";
  std::vector<Number> out = press(pulled, branch, mirrored(cracks), options);
  std::erase_if(out, [](const Number& n) { return n.name == "sigma_cd"; });  // a notion of compression
  const double grip = options.grip_thickness;
  std::vector<Number> place = place_of_failure(history, cracks, -branch.strain, grip);
  if (place.back().value > 0.5)
    out.front().note = joined(out.front().note, "failed at the grip: a lower bound of the strength");
  out.insert(out.begin() + 2, place.begin(), place.end());
  return out;
}

std::vector<Number> disc(const History& history, const std::vector<CrackEvent>& cracks,
                         const AnalysisOptions& options) {
  LoadingBranch branch = loading_branch(history);
  branch.strength = "bts";
  std::vector<Number> out = strength(branch);
  const std::vector<Number> place = place_of_splitting(history, branch, cracks, options.disc_diameter);
  const double y = place[0].value, x = place[1].value;
  if (std::fmax(std::fabs(x), std::fabs(y)) > central_third)
    out.front().note = joined(
        out.front().note, fmt::format("no tensile strength: the first crack came {:.2f} diameters from the "
                                      "centre, outside the central third",
                                      std::hypot(x, y)));
  add(out, place);
  add(out, crack_initiation(branch, cracks, 0.0));
  add_cracks_energies_checks(out, history, branch, cracks,
                             {options.density, options.disc_diameter, disc_approach});
  return out;
}

std::vector<Number> confined(const History& history, const std::vector<CrackEvent>& cracks,
                             const AnalysisOptions& options) {
  const History q = deviatoric(history);
  LoadingBranch branch = loading_branch(q);
  branch.strength = "q_max";
  std::vector<Number> out = press(q, branch, cracks, options);
  const std::vector<Number> own = confined_strength(history, branch, options.confining_stress);
  out.insert(out.begin() + 2, own.begin(), own.end());
  return out;
}

std::vector<Number> shear(const History& history, const std::vector<CrackEvent>& cracks,
                          const AnalysisOptions& options) {
  LoadingBranch branch = loading_branch(history);
  branch.strength = "tau_peak", branch.tool = "box";
  std::vector<Number> out = shear_numbers(history, branch, options.normal_load);
  add(out, crack_initiation(branch, cracks, 0.0));
  add_cracks_energies_checks(out, history, branch, cracks, {});  // the boxes carry no wave
  return out;
}

}  // namespace

const Number* find(const std::vector<Number>& numbers, const std::string& name) {
  for (const Number& n : numbers)
    if (n.name == name) return &n;
  return nullptr;
}

std::vector<Number> analyse(const History& history, const std::vector<CrackEvent>& cracks,
                            const AnalysisOptions& options) {
  std::vector<Number> out;
  switch (history.kind) {
    case TestKind::uniaxial: out = press(history, loading_branch(history), cracks, options); break;
    case TestKind::direct_tension: out = tension(history, cracks, options); break;
    case TestKind::brazilian: out = disc(history, cracks, options); break;
    case TestKind::biaxial: out = confined(history, cracks, options); break;
    case TestKind::direct_shear: out = shear(history, cracks, options); break;
  }
  for (Number& n : out) {
    if (std::isfinite(n.value)) continue;
    n.value = std::numeric_limits<double>::quiet_NaN();
    if (n.note.empty()) n.note = "the history holds no usable values for it";
  }
  return out;
}

}  // namespace phy
