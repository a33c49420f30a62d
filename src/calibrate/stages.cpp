#include "calibrate/stages.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "calibrate/elastic_response.hpp"
#include "calibrate/search_plan.hpp"
#include "calibrate/softening.hpp"
#include "calibrate/strength_tests.hpp"

namespace phy::calibrate {
namespace {

ElasticFit moduli_of(const StageTask& task, const Evidence& table) {
  const Listener& listener = task.options.listener;
  ElasticFit fit =
      task.method().fit_moduli({table, task.packings.fit, task.packings.spare, task.simulator, listener});
  listener.estimates({fit.parameters.begin(), fit.parameters.end()});
  return fit;
}

/// The moduli anew for tests that soften so far; `moduli` takes them.
RefittedModuli refitted(const StageTask& task, const Softenings& softenings, ElasticFit& moduli) {
  moduli = moduli_of(task, at_small_strain(task.evidence, softenings));
  return {moduli.recipe, moduli.comparisons};
}

/// Root mean square error of E as the laboratory reads it, of a model whose softenings were measured.
double misfit_as_read(const StageTask& task, const ElasticFit& moduli, const Softenings& measured) {
  double squares = 0.0;
  int n = 0;
  for (std::size_t i = 0; i < moduli.comparisons.size(); ++i) {
    const Target& t = task.evidence.moduli[i];
    // nu may have given way for E, so that E alone says which pass is nearest.
    if (t.property != Property::E) continue;
    const double E = moduli.comparisons[i].mean * softening_at(measured, test_of_cell(t)).factor;
    squares += std::pow(E / t.mean - 1.0, 2), ++n;
  }
  return std::sqrt(squares / n);
}

}  // namespace

Moduli on_packings(const StageTask& task, ElasticFit fit, const Recipe& recipe,
                   const std::vector<std::int64_t>& unseen) {
  const std::vector<Target>& moduli = task.evidence.moduli;
  Solutions solutions = solve_angles(recipe, moduli, unseen, Statics::one_sided, task.simulator);
  Moduli found{std::move(fit), over_packings(solutions, moduli), {}};
  for (auto& [theta, on_packings] : solutions) on_packings.resize(1);
  found.first = over_packings(solutions, moduli);
  return found;
}

Moduli fit_moduli(const StageTask& task) {
  ElasticFit fit = moduli_of(task, task.evidence);
  const Recipe recipe = fit.recipe;
  task.options.listener.begins({FindingKind::course_moduli_unseen});
  return on_packings(task, std::move(fit), recipe, task.packings.unseen);
}

void fit_strengths(const StageTask& task, const ElasticFit& moduli, Strengths& found) {
  found.moduli = moduli;
  const bool read = task.scope.read_in_tests;
  SearchTask search{task.evidence,
                    moduli.recipe,
                    task.packings.search,
                    {task.options.max_tests - tests_beside_search(task.evidence, read), task.options.effort},
                    task.simulator,
                    task.options.listener};
  // Without a modulus to be read in tests the moduli stay, and rounds cost no solutions.
  if (read) search.refit = [&](const Softenings& s) { return refitted(task, s, found.moduli); };
  task.method().fit_strengths(search, found.fit);
}

/// The last pass may not be the nearest: how far a test softens depends on the moduli, so that the steps are
/// damped, and the best of them is taken. Where one measurement is all that can be paid (or the specimens are
/// so large that the search takes coarse grains) the moduli follow it once, unmeasured.
Strengths with_measured_softening(const StageTask& task, Strengths found) {
  const Evidence& evidence = task.evidence;
  const std::vector<std::int64_t> packings(task.packings.fit.begin(), task.packings.fit.begin() + n_softened);
  const std::vector<Target> tests = tests_to_read(evidence);
  const auto n = static_cast<std::int64_t>(tests.size() * packings.size()),
             reserved = tests_per_packing(evidence, true) * verification_packings;
  Strengths nearest;
  double least_misfit = std::numeric_limits<double>::infinity();
  for (int pass = 1; pass <= most_softenings; ++pass) {
    task.options.listener.begins({FindingKind::course_softening});
    const Softenings measured = softenings_of(
        {found.fit.recipe, evidence.rock.model, tests, packings, evidence.rock.E_is}, task.simulator);
    if (measured.empty()) break;
    const Softenings used = std::exchange(found.fit.softenings, measured);
    if (const double misfit = misfit_as_read(task, found.moduli, measured); misfit < least_misfit)
      // Kept with the softening that was measured on these very moduli: only then E as read is known.
      nearest = found, least_misfit = misfit;
    if (settled(used, measured)) break;
    const bool again = task.spent() + n + reserved <= task.options.max_tests && !has_coarse(found.fit.recipe);
    if (!again && pass > 1) break;
    found.fit.softenings = stepped(used, measured);
    found.fit.recipe =
        with_moduli(found.fit.recipe, refitted(task, found.fit.softenings, found.moduli).recipe);
    if (!again) {
      found.fit.softenings = measured;
      return found;
    }
  }
  return nearest.fit.softenings.empty() ? found : nearest;
}

}  // namespace phy::calibrate
