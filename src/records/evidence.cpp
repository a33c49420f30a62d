#include "records/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/stats.hpp"

namespace phy {

namespace {

constexpr double z_99 = 2.58;  // standard errors that chance exceeds in 1 % of cases, to both sides
constexpr double growth_under_confinement = 3.7;  // of sigma_1 per stress: a rock of 35 degrees of friction

/// About what is left of a strength under confinement without the stress on the sides, in a rock of 35
/// degrees of friction; no less than a quarter of it.
double unconfined(const Target& t) {
  constexpr double least = 0.25;
  return std::max(t.mean - growth_under_confinement * t.confining, least * t.mean);
}

}  // namespace

Evidence::Evidence(const Rock& of) : Evidence(of, targets_of(of)) {}

Evidence::Evidence(Rock of, std::vector<Target> read) : rock(std::move(of)), targets(std::move(read)) {
  // The recipe may have layers all the same, and would be pressed with them.
  if (!rock.bedded) remove_layers(rock.model);
  double expected = 0.0;  // of strengths under confinement alone
  for (const Target& t : targets) {
    const MeasuredProperty& p = measured(t.property);
    const bool tested = p.test != nullptr;
    if (!p.is_strength()) moduli.push_back(t);
    // Fitted on grains of a size that nobody has stated, K_Ic would drag the strengths along.
    if (p.grain_exponent > 0.0 && !rock.grains_stated)
      compared.push_back(t);
    else if (tested)
      strengths.push_back(t);
    // The largest one: boxes are multiples of it, and must hold the matrix, which is stronger than the
    // planes.
    if (tested && p.is_stress() && t.confining == 0.0) scales.strength = std::max(scales.strength, t.mean);
    if (is_compressive(t.property) && t.confining > 0.0) expected = std::max(expected, unconfined(t));
    if (t.property == Property::E) scales.modulus = std::max(scales.modulus, t.mean);
  }
  // Tension alone would put the box of sigma_c at a tenth of where it belongs.
  if (!has(Property::ucs)) scales.strength = std::max(scales.strength, expected);
  // A joint of this stiffness yields as much as the rock between two of them.
  if (!rock.model.bedding.empty()) scales.stiffness = scales.modulus / rock.model.bedding.front().spacing;
  add_read_only();
}

void Evidence::add_read_only() {
  // Moduli of waves need no test; without strengths no test runs that they could be read in.
  if (rock.E_is == ModulusReading::small_strain || !fits_strength()) return;
  for (const Target& m : moduli) {
    Target test{Property::confined, m.theta, scales.strength};
    test.confining = m.confining;
    const auto is_it = [&](const Target& t) { return same_cell(t, test); };
    if (m.confining == 0.0 || std::any_of(strengths.begin(), strengths.end(), is_it) ||
        std::any_of(read_only.begin(), read_only.end(), is_it))
      continue;
    for (const Target& t : strengths)
      if (t.property == Property::ucs && t.theta == m.theta) test.mean = t.mean;
    // Only speed and end of the test follow from it: a rough strength is enough.
    test.mean += growth_under_confinement * test.confining;
    read_only.push_back(test);
  }
}

bool Evidence::has(Property property, double from, double to) const {
  return std::any_of(targets.begin(), targets.end(), [&](const Target& t) {
    return t.property == property && t.theta >= from && t.theta <= to;
  });
}

std::int64_t Evidence::n_compressive() const {
  return std::count_if(strengths.begin(), strengths.end(),
                       [](const Target& t) { return is_compressive(t.property); });
}

std::int64_t Evidence::n_tests() const {
  return std::count_if(strengths.begin(), strengths.end(),
                       // What is read in the test of another costs no test.
                       [](const Target& t) { return !measured(t.property).read_in; });
}

bool shows_layers(const std::vector<Target>& strengths) {
  constexpr std::ptrdiff_t least_strengths = 4;
  return std::ranges::any_of(strengths, [](const Target& t) { return t.property == Property::ucs; }) &&
         std::ranges::count_if(strengths, is_expected) >= least_strengths;
}

double counted_error(const Target& modulus) {
  // Few specimens may agree by chance. Without a floor one of them would outweigh all others.
  const double least = modulus.property == Property::E ? least_error_E * modulus.mean : least_error_nu;
  return std::max(least, modulus.normal_error());
}

std::optional<double> change_under_confinement(const std::vector<Target>& targets, ModulusReading reading) {
  const std::vector<Target> E = of_property(targets, Property::E);  // by stress
  // A secant to the peak holds what yields on the way there, and changes with the peak.
  if (E.size() < 2 || reading == ModulusReading::secant_at_peak) return std::nullopt;
  const Target &low = E.front(), &high = E.back();
  const double noise = std::hypot(low.normal_error() / low.mean, high.normal_error() / high.mean);
  const double change = high.mean / low.mean - 1.0;
  // Chance in one of a hundred tables, and never less than matters: rock without layers hardly stiffens in
  // the model.
  if (std::fabs(change) <= std::max(2.0 * measured(Property::E).tolerance, z_99 * noise)) return std::nullopt;
  return change;
}

Property compression_of(const Evidence& e, double from, double to) {
  // Where there is neither, UCS is the test to ask for: every laboratory does it.
  const bool ucs = e.has(Property::ucs, from, to) || !e.has(Property::confined, from, to);
  return ucs ? Property::ucs : Property::confined;
}

}  // namespace phy
