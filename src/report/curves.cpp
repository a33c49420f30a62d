#include "report/curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/nan.hpp"
#include "records/jointed.hpp"
#include "records/test_description.hpp"
#include "theory/eq1_fit.hpp"
#include "theory/jaeger_fit.hpp"

namespace phy::report {
namespace {

AngleCurve sampled(std::string note, const std::function<double(double)>& value) {
  AngleCurve curve{std::move(note), {}, {}};
  for (int theta = 0; theta <= 90; ++theta) {  // [deg]
    const double v = value(theta);
    if (!std::isfinite(v)) continue;
    curve.theta.push_back(theta);
    curve.value.push_back(v);
  }
  return curve;
}

/// Of planes over their spacing; `set`: null where it is not known, and dispersed joints have none.
std::string macro_stiffness(const theory::JointedRock& rock, const BeddingRecipe* set) {
  const double K_n = rock.K_n_delta * 1e-9, K_s = rock.K_s_delta * 1e-9;
  if (set == nullptr || !set->has_planes())
    // Eq. 1 holds K times spacing; without a spacing only the product is known.
    return fmt::format("K_n δ = {:.1f} GPa, K_s δ = {:.1f} GPa", K_n, K_s);
  return fmt::format("K_n = {:.0f} GPa/m, K_s = {:.0f} GPa/m", K_n / set->spacing, K_s / set->spacing);
}

// A caption instead of a missing curve: readers of a figure ask why, and have no log.
AngleCurve without(const std::string& reason) { return {"No theory curve: " + reason + ".", {}, {}}; }

AngleCurve goodman_curve(const theory::Eq1Fit& fit, const BeddingRecipe* set) {
  if (!fit.ok()) return without(fit.reason);
  return sampled(fmt::format("Dashed: equivalent continuum (Goodman 1976), least squares in compliance: "
                             "E = {:.1f} GPa, {}, R² = {:.3f}.",
                             fit.rock.E * 1e-9, macro_stiffness(fit.rock, set), fit.R2),
                 [&](double theta) { return theory::goodman_E(fit.rock, theta); });
}

/// `matrix`: where its strength is from.
AngleCurve jaeger_curve(const theory::JaegerFit& fit, const char* matrix) {
  if (const std::string refused = fit.no_plane(); !refused.empty()) return without(refused);
  return sampled(
      fmt::format("Dashed: one plane of weakness (Jaeger 1960), least squares: c = {:.1f} MPa, φ = "
                  "{:.1f}°, rock of {:.1f} MPa ({}), R² = {:.3f}.",
                  fit.plane.cohesion * 1e-6, fit.plane.friction, fit.matrix_ucs * 1e-6, matrix, fit.R2),
      [&](double theta) { return theory::jaeger_sigma_1(fit.plane, fit.matrix_ucs, theta, 0.0); });
}

AngleValue one(double theta, double value) {
  AngleValue v;
  v.theta = theta, v.value.n = 1, v.value.mean = value;
  return v;
}

void add_goodman(const RunRecord& run, TheoryCurves& curves) {
  const Recipe& recipe = run.tests.front().recipe;  // all have the same
  // Goodman's continuum is planes in isotropic rock; of other layers its fit would be a curve without
  // meaning.
  if (!jointed_isotropic(recipe)) {
    curves.E = curves.nu = without(no_weak_planes(recipe));
    return;
  }
  std::vector<AngleValue> moduli;
  double nu_90 = nan, E_intact = nan;
  for (const SpecimenRecord& t : run.tests) {
    const double E = value_of(t, "E_tangent");
    if (t.result.intact && !(E_intact > 0.0)) E_intact = E;
    // NaN compares as false, too.
    if (!t.result.intact && E > 0.0) moduli.push_back(one(t.result.theta, E));
    if (!t.result.intact && t.result.theta == 90.0) nu_90 = value_of(t, "nu");
  }
  const theory::Eq1Fit fit = fit_moduli(moduli, E_intact);
  curves.E = goodman_curve(fit, &recipe.bedding.front());
  // nu follows from the same stiffnesses and has one unknown more, that of the rock between the planes.
  curves.nu = without(fit.ok() ? "it starts from ν at 90°" : fit.reason);
  if (!fit.ok() || !std::isfinite(nu_90)) return;
  theory::JointedRock rock = fit.rock;
  rock.nu = nu_90;
  curves.nu = sampled("Dashed: the same continuum, with ν at 90°; nothing fitted here.",
                      [&](double theta) { return theory::goodman_nu(rock, theta); });
}

void add_jaeger(const RunRecord& run, TheoryCurves& curves) {
  if (!has_weak_planes(run.tests.front().recipe)) {
    curves.ucs = without(no_weak_planes(run.tests.front().recipe));
    return;
  }
  std::vector<theory::StrengthReading> readings;
  double ends = 0.0, n_ends = 0.0, strongest = 0.0;
  for (const SpecimenRecord& t : run.tests) {
    const double ucs = value_of(t, "ucs");
    if (!(ucs > 0.0) || t.result.intact) continue;
    readings.push_back({t.result.theta, ucs});
    strongest = std::max(strongest, ucs);
    // At both ends the plane is not sheared: the strength there is the matrix's. Without ends the strongest
    // is nearest.
    if (t.result.theta == 0.0 || t.result.theta == 90.0) ends += ucs, n_ends += 1.0;
  }
  curves.ucs = jaeger_curve(theory::fit_jaeger(readings, n_ends > 0.0 ? ends / n_ends : strongest),
                            n_ends > 0.0 ? "mean at 0° and 90°" : "the strongest");
}

}  // namespace

double value_of(const SpecimenRecord& test, const std::string& name) {
  // Curves are fitted through these numbers; one that is not to be trusted would bend them all.
  if (test.result.outcome.status == Status::untrusted) return nan;
  for (const Number& n : test.result.numbers)
    if (n.name == name) return n.value;
  return nan;
}

TheoryCurves theory_curves(const RunRecord& run) {
  TheoryCurves curves;
  if (run.tests.empty()) return curves;
  add_goodman(run, curves);
  add_jaeger(run, curves);
  return curves;
}

std::vector<Target> beside(const RunRecord& run, const std::vector<Target>& laboratory) {
  if (run.tests.empty()) return laboratory;
  const TestRecipe& test = run.tests.front().recipe.test;
  const bool kept = test.kind->kept_stress.value == &TestRecipe::confining_stress;
  const double stress = kept ? test.confining_stress : 0.0;
  std::vector<Target> some;
  for (const Target& t : laboratory)
    // A laboratory's confined strengths beside an unconfined run would show a misfit that is none.
    if (same_stress(t.confining, stress)) some.push_back(t);
  return some;
}

TheoryCurves theory_curves(const std::vector<Target>& table) {
  TheoryCurves curves;
  std::vector<AngleValue> moduli;
  std::vector<theory::StrengthReading> strengths;
  for (const Target& t : least_confined(table)) {
    if (t.property == Property::E && t.n > 0) moduli.push_back(one(t.theta, t.mean));
    if (t.property == Property::ucs) strengths.push_back({t.theta, t.mean});
  }
  curves.E = goodman_curve(fit_moduli(moduli, nan), nullptr);
  if (!strengths.empty()) curves.ucs = jaeger_curve(theory::fit_jaeger_and_matrix(strengths), "fitted");
  return curves;
}

Rose crack_rose(const std::vector<CrackEvent>& cracks, std::size_t n_bins) {
  Rose rose{std::vector<double>(n_bins, 0.0), std::vector<double>(n_bins, 0.0)};
  for (const CrackEvent& c : cracks) {
    // The crack lies across its normal, hence x over -y; half turns, as a crack has no front.
    const double turn =
        std::atan2(c.normal.x, -c.normal.y) / std::numbers::pi;  // of the crack, in half turns
    const double n = static_cast<double>(n_bins), place = std::round((turn - std::floor(turn)) * n);
    // Rounding up the last half bin leads to the first: 179 degrees lie beside 0.
    const auto bin = static_cast<std::size_t>(place) % n_bins;
    (c.mode == CrackMode::tension ? rose.tension : rose.shear)[bin] += 1.0;
  }
  return rose;
}

theory::Eq1Fit fit_moduli(const std::vector<AngleValue>& E, double E_intact) {
  std::vector<theory::ModulusReading> readings;
  theory::Eq1Options options;
  options.reference = E_intact > 0.0 ? theory::Eq1Reference::given : theory::Eq1Reference::free;
  options.E = E_intact;
  for (const AngleValue& a : E) {
    if (a.value.n == 0) continue;
    readings.push_back({a.theta, a.value.mean});
    // Along the load planes add no compliance, so E at 90 is the rock's own: one unknown less.
    if (a.theta == 90.0) options.reference = theory::Eq1Reference::measured_90;
  }
  return theory::fit_eq1(readings, options);
}

std::vector<MacroPoint> macro_points(const Variation& v, const VariedParameter& p) {
  std::vector<MacroPoint> points;
  for (const VariedSetting& s : p.settings) {
    if (v.spacing <= 0.0 || !std::isfinite(s.factor)) continue;
    std::vector<double> K_n, K_s;
    // Each replicate is fitted alone, so that the interval shows the scatter of packings.
    for (const auto& E : s.E_each.empty() ? std::vector<std::vector<AngleValue>>{s.E} : s.E_each)
      if (const theory::Eq1Fit fit = fit_moduli(E, v.E_intact); fit.ok())
        K_n.push_back(fit.rock.K_n_delta / v.spacing), K_s.push_back(fit.rock.K_s_delta / v.spacing);
    if (!K_n.empty()) points.push_back({s.factor, summarise(K_n), summarise(K_s)});
  }
  return points;
}

}  // namespace phy::report
