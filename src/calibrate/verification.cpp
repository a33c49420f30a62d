#include "calibrate/verification.hpp"

#include <algorithm>
#include <cmath>

#include "base/stats.hpp"
#include "calibrate/elastic_response.hpp"
#include "calibrate/search_plan.hpp"
#include "calibrate/softening.hpp"
#include "calibrate/strength_tests.hpp"
#include "calibrate/toughness.hpp"
#include "verdict/cells.hpp"

namespace phy::calibrate {
namespace {

constexpr double modulus_change = 0.05;  // of E from small strain to half of UCS, that is reported

/// A modulus at small strain as the laboratory would read it.
void soften(Comparison& c, const Softening& s) {
  const bool modulus = c.target.property == Property::E;
  for (double* v : {&c.mean, &c.low, &c.high}) *v = modulus ? *v * s.factor : *v + s.addition;
  // Packings scatter in E by the same share before and after; to nu only an addition comes.
  if (modulus) c.sd *= s.factor;
}

/// E and nu of the press beside those at small strain, of which the table holds values: what tests make of
/// the solutions on their packings is made of the means over all. Where they differ much, the user must know
/// which of the two the laboratory means.
void add_tangents(Verified& v, const Moduli& moduli, const std::vector<Comparison>& from_test) {
  std::vector<Comparison> read;  // 50 % of UCS
  for (const Comparison& p : from_test)
    if (p.target.confining == 0.0 && row_of(v.rows, p.target) != nullptr) read.push_back(p);
  if (read.empty()) return;
  const auto on_several = [](const Comparison& c) { return c.n_packings > 1; };
  // Tests and solutions of the same specimens: between packings E may differ by more than tests change it.
  const std::vector<Comparison>& solved =
      std::any_of(read.begin(), read.end(), on_several) ? v.rows : moduli.first;
  std::vector<double> changes;  // of E, logarithms
  for (Comparison& c : read) {
    const Comparison &small_strain = *row_of(v.rows, c.target), &same = *row_of(solved, c.target);
    const bool modulus = c.target.property == Property::E;
    if (modulus && c.answered()) changes.push_back(std::log(c.mean / same.mean));
    c.target = small_strain.target;
    c.mean = modulus ? small_strain.mean * c.mean / same.mean : small_strain.mean + c.mean - same.mean;
  }
  v.tangents = read;
  const double change = std::expm1(summarise(changes).mean);
  if (std::fabs(change) > modulus_change)
    v.notes.push_back({FindingKind::tests_change_modulus, {}, {{"change", change}}});
}

/// Moduli as the laboratory reads them, fitted and on unseen packings, in place of those at small strain.
void take_as_measured(Verified& v, const StageTask& task, const Strengths& strengths,
                      const std::vector<Comparison>& from_test) {
  const Softenings& softenings = strengths.fit.softenings;
  v.fitted_moduli = strengths.moduli.comparisons;
  for (std::size_t i = 0; i < v.fitted_moduli.size(); ++i) {
    Comparison& c = v.fitted_moduli[i];
    c.target = task.evidence.moduli[i];
    soften(c, softening_at(softenings, test_of_cell(c.target)));
  }
  for (Comparison& c : v.rows) {
    const Target target = c.target;
    const Comparison* p = row_of(from_test, target);
    if (p == nullptr || !p->answered()) {  // no test of its own
      soften(c, softening_at(softenings, test_of_cell(target)));
      v.notes.push_back({FindingKind::modulus_without_test, {cell_of(target)}});
    } else {
      c = *p, c.target = target;
    }
  }
}

/// Would more unseen packings tell more, and may they be had? Specimens so large that the search takes coarse
/// grains keep to the first: theirs are most of what a calibration costs.
bool takes_more_packings(const StageTask& task, const Recipe& recipe, const std::vector<Comparison>& rows,
                         Verified& v) {
  if (v.n_packings >= static_cast<int>(verdict::most_packings) || !verdict::wants_packings(rows) ||
      has_coarse(recipe))
    return false;
  const std::int64_t n = tests_per_packing(task.evidence, task.scope.read_in_tests) * verification_packings;
  // Said only where more were wanted: whoever lets it run longer gains something then.
  if (task.spent() + n <= task.options.max_tests) return true;
  v.notes.push_back({FindingKind::packings_wanted, {}, {}, {}, Advice::more_tests});
  return false;
}

std::vector<double> means_of(const std::vector<Comparison>& rows) {
  std::vector<double> means;
  for (const Comparison& c : rows) means.push_back(c.mean);
  return means;
}

/// The tests of a verification, on more packings where strengths differ much between them.
struct UnseenTests {
  std::vector<Comparison> strengths, moduli;
  std::vector<std::int64_t> packings;
};
UnseenTests run_unseen(const StageTask& task, const StrengthFit& fit, const Pictures& pictures, Verified& v) {
  const Evidence& evidence = task.evidence;
  const bool read = task.scope.read_in_tests;
  TestSeries series(pictures.at_once ? pictures.recipe : fit.recipe, pictures.tests, pictures.packing,
                    of_verification(read, means_of(fit.fitted)), task.simulator);
  UnseenTests unseen;
  std::vector<std::int64_t> next = task.packings.unseen;
  for (std::int64_t more = task.packings.next_unseen;; more += verification_packings) {
    unseen.packings.insert(unseen.packings.end(), next.begin(), next.end());
    v.n_packings = static_cast<int>(unseen.packings.size());
    task.options.listener.begins(
        {FindingKind::course_unseen, {}, {{"packings", static_cast<double>(v.n_packings)}}});
    series.take(next);
    unseen.strengths = series.strengths();
    // Behind the table's strengths stand tests that moduli alone are read in.
    unseen.strengths.resize(evidence.strengths.size());
    if (!takes_more_packings(task, fit.recipe, unseen.strengths, v)) break;
    next = seeds_from(more, verification_packings);
  }
  unseen.moduli = series.moduli(read ? evidence.rock.E_is : ModulusReading::tangent_50);
  if (v.n_packings > verification_packings)
    v.notes.push_back({FindingKind::packings_added,
                       {},
                       {{"packings", static_cast<double>(v.n_packings)}, {"usual", verification_packings}}});
  return unseen;
}

/// K_Ic of a rock whose grain size nobody has stated.
void compare_toughness(Verified& v, const StageTask& task, const Recipe& recipe,
                       const std::vector<std::int64_t>& packings) {
  const std::vector<Target>& compared = task.evidence.compared;
  if (compared.empty()) return;
  task.options.listener.begins(
      {FindingKind::course_toughness, {}, {{"packings", static_cast<double>(packings.size())}}});
  v.compared = strength_response(recipe, compared, packings, as_measured, task.simulator);
  const std::vector<Finding> notes = toughness_findings(v.compared, recipe);
  v.notes.insert(v.notes.begin(), notes.begin(), notes.end());
}

}  // namespace

Recipe with_pictures(Recipe recipe) {
  const TestRecipe usual;
  recipe.test.n_snapshots = usual.n_snapshots, recipe.test.n_frames = usual.n_frames;
  return recipe;
}

Verified verified(const Moduli& moduli) {
  Verified v;
  v.rows = moduli.unseen, v.fitted_moduli = moduli.fit.comparisons;
  return v;
}

Verified verified(const StageTask& task, const Moduli& moduli, const Strengths& strengths,
                  Pictures& pictures) {
  Verified v = verified(moduli);
  const Recipe& recipe = strengths.fit.recipe;
  const bool read = task.scope.read_in_tests;
  // The moduli were fitted anew since the elastic stage looked at these packings.
  if (read)
    v.rows = elastic_response(as_for_moduli(recipe, task.evidence.rock.model), task.evidence.moduli,
                              task.packings.unseen, task.simulator);
  std::vector<Target> tests = task.evidence.strengths;
  if (read) tests.insert(tests.end(), task.evidence.read_only.begin(), task.evidence.read_only.end());
  pictures = {pictures.at_once, with_pictures(recipe), tests, task.packings.unseen.front()};
  pictures.recipe.name = task.evidence.rock.name + ", on a packing that the fit has not seen";
  const UnseenTests unseen = run_unseen(task, strengths.fit, pictures, v);
  if (read) {
    take_as_measured(v, task, strengths, unseen.moduli);
  } else {
    Moduli as_tested = moduli;  // on as many packings
    if (v.n_packings > verification_packings)
      as_tested = on_packings(task, moduli.fit, recipe, unseen.packings), v.rows = as_tested.unseen;
    add_tangents(v, as_tested, unseen.moduli);
  }
  v.rows.insert(v.rows.end(), unseen.strengths.begin(), unseen.strengths.end());
  compare_toughness(v, task, recipe, unseen.packings);
  return v;
}

void run_for_pictures(const Pictures& pictures, const Listener& listener, Simulator& simulator) {
  if (pictures.at_once || pictures.tests.empty()) return;
  listener.begins({FindingKind::course_pictures});
  strength_response(pictures.recipe, pictures.tests, {pictures.packing}, as_measured, simulator);
}

}  // namespace phy::calibrate
