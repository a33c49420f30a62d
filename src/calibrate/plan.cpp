#include "calibrate/plan.hpp"

#include <fmt/format.h>

#include <numeric>

#include "base/check.hpp"
#include "base/option.hpp"
#include "calibrate/method.hpp"
#include "calibrate/posterior_ensemble.hpp"
#include "calibrate/search_plan.hpp"
#include "calibrate/softening.hpp"
#include "maps/forecast.hpp"
#include "verdict/cells.hpp"

namespace phy::calibrate {
namespace {

// Five packings give the effect of one-sided contacts to 0.2 %, twenty mean E to 1 % where joints are soft. A
// usual search takes 22 to 46, and hardly one of sixty twice (docs/decisions/0020).
constexpr int n_fit = 5, n_spare = 15, n_search = 60;

bool read_in_tests(const Evidence& evidence, const CalibrationOptions& options) {
  return evidence.rock.E_is != ModulusReading::small_strain && evidence.has(Property::E) &&
         !options.elastic_only && !tests_to_read(evidence).empty();
}

/// What is left as the recipe has it, or compared otherwise than the table has it.
std::vector<Finding> notes_on(const Scope& scope, const Evidence& evidence,
                              const CalibrationOptions& options) {
  std::vector<Finding> notes;
  const bool is_read = scope.strengths && !tests_to_read(evidence).empty();
  if (!scope.moduli) notes.push_back({FindingKind::no_modulus});
  if (scope.moduli && !is_read && evidence.rock.E_is != ModulusReading::small_strain)
    notes.push_back({FindingKind::moduli_at_small_strain,
                     {},
                     {},
                     {to_string(evidence.rock.E_is), scope.strengths ? "UCS" : "strengths"}});
  if (!scope.strengths)
    notes.push_back({options.elastic_only                  ? FindingKind::elastic_only
                     : method_of(options.method).needs_ucs ? FindingKind::no_ucs
                                                           : FindingKind::no_compression});
  return notes;
}

}  // namespace

std::vector<std::int64_t> seeds_from(std::int64_t first, int n) {
  std::vector<std::int64_t> seeds(static_cast<std::size_t>(n));
  std::iota(seeds.begin(), seeds.end(), first);
  return seeds;
}

Packings packings_from(std::int64_t first) {
  Packings p{};
  std::int64_t next = first;
  const auto take = [&](int n) {
    next += n;
    return seeds_from(next - n, n);
  };
  p.fit = take(n_fit), p.unseen = take(verification_packings), p.spare = take(n_spare);
  p.next_unseen = next;
  // Kept free even if the verification stops early: draws of the ensemble must not get other packings by
  // that.
  next += static_cast<std::int64_t>(verdict::most_packings - verdict::first_packings);
  p.first_of_ensemble = next;
  next += static_cast<std::int64_t>(ensemble_size);
  // The fit's packings come first: their genesis is paid already. What search and fit share is not what the
  // verification sees.
  p.search = p.fit;
  for (const auto& more : {p.spare, take(n_search - n_fit - n_spare)})
    p.search.insert(p.search.end(), more.begin(), more.end());
  return p;
}

CalibrationOptions settled(CalibrationOptions options, const Evidence& evidence) {
  if (options.effort.name != auto_effort.name) return options;
  const auto forecast = options.elastic_only ? std::nullopt : maps::forecast_of(evidence);
  options.effort = normal_effort;
  if (forecast && forecast->status == VerdictStatus::out_of_reach)
    // A long search would find the same miss, only more exactly.
    options.effort = quick_effort, options.effort.foreseen = true;
  return options;
}

Scope scope_of(const Evidence& evidence, const CalibrationOptions& options) {
  Scope scope;
  scope.moduli = evidence.has(Property::E);
  scope.strengths = !options.elastic_only && evidence.fits_strength() &&
                    (evidence.has(Property::ucs) || !method_of(options.method).needs_ucs);
  if (!scope.moduli && !scope.strengths)
    throw InputError(
        Problem{evidence.rock.name, "table", "",
                options.elastic_only ? "values of E" : "values of E, or of a strength in compression",
                "there is nothing to fit; `phyllite rock check` shows what the table holds"});
  scope.read_in_tests = read_in_tests(evidence, options);
  scope.notes = notes_on(scope, evidence, options);
  return scope;
}

std::int64_t tests_per_packing(const Evidence& evidence, bool read_in_tests) {
  return evidence.n_compressive() +
         (read_in_tests ? static_cast<std::int64_t>(evidence.read_only.size()) : 0);
}

std::int64_t tests_beside_search(const Evidence& evidence, bool read_in_tests) {
  return tests_per_packing(evidence, read_in_tests) *
         (verification_packings + (read_in_tests ? n_softened : 0));
}

std::int64_t least_tests(const Evidence& evidence, const CalibrationOptions& options) {
  if (options.elastic_only || !evidence.fits_strength()) return 0;
  return evidence.n_compressive() * least_points +
         tests_beside_search(evidence, read_in_tests(evidence, options));
}

void check_budget(const Evidence& evidence, const CalibrationOptions& options) {
  if (!scope_of(evidence, options).strengths) return;
  const std::int64_t least = least_tests(evidence, options), n = evidence.n_compressive();
  if (options.max_tests < least)
    throw InputError(
        option_problem("max-tests", fmt::format("{}", options.max_tests), fmt::format("at least {}", least),
                       fmt::format("{} strengths in compression, each with {} tests of the search, and {} "
                                   "tests at the estimate",
                                   n, least_points, least - n * least_points)));
}

}  // namespace phy::calibrate
