#include "study/envelope.hpp"

#include <cmath>
#include <utility>

#include "analysis/analyse.hpp"
#include "records/jointed.hpp"

namespace phy::study {
namespace {

constexpr double across_planes = 15.0;  // [deg] m_i is that of planes within this of across the load

/// Inclination from across the load, 0 ... 90 [deg]: planes at 120 deg are the mirror image of planes at 60
/// deg.
double folded(double theta) { return theta > 90.0 ? 180.0 - theta : theta; }

std::vector<SpecimenEnvelope> collect(const EnvelopeTests& tests) {
  std::vector<SpecimenEnvelope> all(tests.results.empty() ? 0 : tests.results.front().size());
  // From one list of specimens per stress to one list of stresses per specimen.
  for (std::size_t i = 0; i < tests.confining.size(); ++i) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      const TestResult& r = tests.results[i][k];
      all[k].name = r.name, all[k].intact = r.intact, all[k].theta = r.theta;
      const Number* sigma_1 = analysis::find(r.numbers, "sigma_1");
      // Only peaks and knees are strengths.
      if (!has_strength(r.outcome.status) || sigma_1 == nullptr || !std::isfinite(sigma_1->value)) continue;
      all[k].readings.push_back({tests.confining[i], sigma_1->value});
      if (rule_of(r) == analysis::StrengthRule::knee) all[k].knees.push_back(tests.confining[i]);
    }
  }
  return all;
}

/// k = m(theta) / m_i, errors of both taken as independent.
void fit_anisotropy(Envelope& envelope) {
  const SpecimenEnvelope* across = nullptr;
  for (const SpecimenEnvelope& s : envelope.specimens)
    // The reference is the specimen whose planes lie nearest to across the load: there k is 1 by definition.
    if (!s.intact && s.hoek_brown.ok && (across == nullptr || folded(s.theta) < folded(across->theta)))
      across = &s;
  if (across == nullptr || folded(across->theta) > across_planes) return;
  const theory::Estimate m_i = across->hoek_brown.m_i;
  envelope.m_i = m_i.value;
  for (SpecimenEnvelope& s : envelope.specimens) {
    if (s.intact || !s.hoek_brown.ok) continue;
    const theory::Estimate m = s.hoek_brown.m_i;
    s.k.value = m.value / m_i.value;
    // The reference over itself has no error.
    s.k.se = &s == across ? 0.0 : s.k.value * std::hypot(m.se / m.value, m_i.se / m_i.value);
  }
}

void fit_plane(Envelope& envelope) {
  const SpecimenEnvelope* matrix = nullptr;
  std::vector<theory::StrengthReading> readings;
  for (const SpecimenEnvelope& s : envelope.specimens) {
    if (!s.intact)
      for (const theory::EnvelopeReading& r : s.readings) readings.push_back({s.theta, r.sigma_1, r.sigma_3});
    if (!s.mohr_coulomb.ok) continue;
    // The rock between the planes is taken as the strongest specimen: no plane has weakened it.
    if (matrix == nullptr || s.mohr_coulomb.ucs.value > matrix->mohr_coulomb.ucs.value) matrix = &s;
  }
  if (matrix == nullptr) {
    envelope.plane.reason = "no specimen has a Mohr-Coulomb envelope";
    return;
  }
  envelope.matrix = matrix->name;
  const theory::Coulomb rock{matrix->mohr_coulomb.cohesion.value, matrix->mohr_coulomb.friction.value};
  envelope.plane =
      theory::fit_jaeger(readings, [rock](double sigma_3) { return theory::coulomb_sigma_1(rock, sigma_3); });
}

}  // namespace

std::optional<analysis::StrengthRule> rule_of(const TestResult& result) {
  const Number* rule = analysis::find(result.numbers, "strength_rule");
  for (const auto known :
       {analysis::StrengthRule::peak, analysis::StrengthRule::knee, analysis::StrengthRule::largest})
    if (rule != nullptr && rule->value == static_cast<double>(known)) return known;
  return std::nullopt;
}

Recipe confined_recipe(Recipe recipe, double confining_stress) {
  recipe.test.kind = TestKind("biaxial");
  recipe.test.confining_stress = confining_stress;
  // Only the uniaxial press can start loaded (records/recipe_checks.cpp).
  recipe.test.pre_strain = 0.0;
  return recipe;
}

EnvelopeTests with_untrusted(EnvelopeTests tests) {
  for (auto& of_stress : tests.results)
    for (TestResult& r : of_stress)
      // As if it had been good: what follows knows strengths by their status alone.
      if (r.outcome.status == Status::untrusted) r.outcome.status = Status::peaked;
  return tests;
}

Envelope fit_envelope(const EnvelopeTests& tests, const Recipe& recipe) {
  Envelope envelope;
  envelope.specimens = collect(tests);
  for (SpecimenEnvelope& s : envelope.specimens) {
    s.mohr_coulomb = theory::fit_mohr_coulomb(s.readings);
    s.hoek_brown = theory::fit_hoek_brown(s.readings);
  }
  fit_anisotropy(envelope);
  if (has_weak_planes(recipe))
    fit_plane(envelope);
  else
    envelope.plane.reason = no_weak_planes(recipe);
  return envelope;
}

}  // namespace phy::study
