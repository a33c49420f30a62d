#include "calibrate/by_model.hpp"

#include <algorithm>
#include <set>

#include "calibrate/elastic_response.hpp"
#include "calibrate/eq2.hpp"
#include "calibrate/finer_grains.hpp"
#include "calibrate/posterior_ensemble.hpp"
#include "maps/reach.hpp"
#include "survey/elastic_limits.hpp"
#include "survey/identifiability.hpp"
#include "verdict/cells.hpp"
#include "verdict/judge.hpp"

namespace phy::calibrate {
namespace {

// Thirty-five solutions a packing and setting, of up to six settings: two packings make 420.
constexpr std::size_t n_eq2 = 2;  // packings for Eq. 2

/// What the stages have found so far.
struct Found {
  Moduli moduli;
  std::optional<Strengths> strengths;
  std::optional<Verified> verified;
  std::vector<PlaneStiffness> eq2;
  bool finished = false;

  const ElasticFit& elastic() const { return strengths ? strengths->moduli : moduli.fit; }
  Softenings softenings() const { return strengths ? strengths->fit.softenings : Softenings(); }
  const Recipe& recipe() const { return strengths ? strengths->fit.recipe : moduli.fit.recipe; }
};

bool all_answered(const std::vector<Comparison>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const Comparison& c) { return c.answered(); });
}

/// A recipe for `phyllite run`: all angles of the table, pictures and curve beyond the peak.
Recipe ready_to_run(Recipe recipe, const Evidence& evidence) {
  const TestRecipe usual;
  recipe = with_pictures(std::move(recipe));
  // A draw of bridges and strengths follows the packing's seed in all tests, so it has to in the recipe.
  take_packing(recipe, recipe.packing.seed);
  TestRecipe& test = recipe.test;
  test.kind = usual.kind;  // which keeps no stress
  test.confining_stress = test.normal_stress = test.normal_stiffness = 0.0;
  test.stop_at = usual.stop_at, test.post_peak = usual.post_peak;
  std::set<double> angles;
  // Without layers all angles are one specimen; a recipe that names them would be refused.
  if (evidence.rock.bedded)
    for (const Target& t : evidence.targets) angles.insert(t.theta);
  test.angles.assign(angles.begin(), angles.end());
  return recipe;
}

void run_stages(const StageTask& task, Found& found, Pictures& pictures) {
  found.moduli = fit_moduli(task);
  // Speed and length of every test follow from the moduli: where one has no answer, nothing can be loaded.
  if (task.scope.strengths && all_answered(found.moduli.fit.comparisons)) {
    found.strengths.emplace();
    fit_strengths(task, found.moduli.fit, *found.strengths);
    if (found.strengths->answered()) {
      if (task.scope.read_in_tests) found.strengths = with_measured_softening(task, *found.strengths);
      found.verified = verified(task, found.moduli, *found.strengths, pictures);
    }
  }
  // Strengths without an answer do not take the moduli with them.
  if (!found.verified) found.verified = verified(found.moduli);
  const Recipe recipe = ready_to_run(found.recipe(), task.evidence);
  if (task.method().has_posterior && has_eq2(recipe)) {  // a sequence has lines of its own on the way
    task.options.listener.begins({FindingKind::course_eq2});
    found.eq2 =
        eq2_band(recipe, {task.packings.fit.begin(), task.packings.fit.begin() + n_eq2}, task.simulator);
  }
  found.finished = true;
}

/// The estimate of what was sought of a parameter; it stands before that of the strength behind a ratio.
const Estimate* estimate_of(const std::vector<Estimate>& list, const Parameter* p) {
  const auto it = std::find_if(list.begin(), list.end(), [&](const Estimate& e) { return e.parameter == p; });
  return it == list.end() ? nullptr : &*it;
}

/// A strength follows from a chain of ratios, and what pins the open ones pins it: of an open estimate, the
/// nearest ratio that is open itself.
const Parameter* open_link(const std::vector<Estimate>& estimates, const Estimate& open) {
  for (const Parameter* p = open.parameter; p == open.parameter || p->over != nullptr; p = p->over)
    if (const Estimate* e = estimate_of(estimates, p); e != nullptr && !e->determined) return p;
  return open.parameter;
}

/// Which data speak about each parameter, and what would pin the others. `met`: the model meets the table.
void add_identifiability(std::vector<Estimate>& estimates, const Evidence& evidence, bool met) {
  const std::vector<Estimate> identifiable = survey::identifiability(evidence);
  for (Estimate& e : estimates) {
    // The rule speaks of ratios. Of an open strength it is the open ratio of its chain that says what is
    // missing.
    const Estimate& f = *estimate_of(identifiable, e.determined ? e.parameter : open_link(estimates, e));
    if (e.determined)
      e.rests_on = f.rests_on;
    else if (f.determined)
      // The table names the parameter and the interval is wide all the same. A model that misses has its
      // intervals widened by the misfit, and more specimens would not narrow them.
      e.next = met ? NextStep{Remedy::more_specimens, f.rests_on.tests} : NextStep{Remedy::meet_table};
    else
      e.next = f.next;
  }
}

/// Warnings about the tests of the verification: discs that are no Brazilian tests by the rule of the ISRM,
/// marks of quality, packings without a peak.
void report_tests(const Verified& v, std::vector<Finding>& notes) {
  QualityTally tally;
  const auto of = [](FindingKind kind, std::vector<Cell> cells, double n, double all) {
    return Finding{kind, std::move(cells), {{"tests", n}, {"of", all}}};
  };
  for (const Comparison& c : v.rows) {
    if (c.n_invalid > 0)
      notes.push_back(of(FindingKind::cracks_off_centre, {cell_of(c.target)}, c.n_invalid, c.n_packings));
    tally.add(c.quality);
  }
  for (const auto& [measure, n] : tally.measures) {
    notes.push_back(
        of(FindingKind::tests_marked, {}, static_cast<double>(n), static_cast<double>(tally.n_results)));
    notes.back().names = {measure};
  }
  if (tally.n_unknown > 0)
    notes.push_back(of(FindingKind::tests_unmarked, {}, static_cast<double>(tally.n_unknown),
                       static_cast<double>(tally.n_results)));
  for (const Comparison& c : v.rows)
    // A row without any answer is left to the verdict, which says more of it.
    if (is_strength(c.target.property) && c.answered() && c.n_packings < v.n_packings) {
      notes.push_back(
          of(FindingKind::peaks_missing, {cell_of(c.target)}, v.n_packings - c.n_packings, v.n_packings));
      notes.back().names = {c.missing};
    }
}

/// Why no model has the table's moduli: of a rock with layers, what no layered elastic body can have.
std::vector<Finding> limits_of(const Evidence& evidence, const Found& found) {
  if (!evidence.rock.bedded) return {};
  std::vector<Finding> limits = survey::elastic_limits(at_small_strain(evidence, found.softenings()).moduli);
  if (!found.softenings().empty())
    for (Finding& f : limits) f.numbers.push_back({"at_small_strain", 1.0});
  return limits;
}

/// Where nu is missed and an elastic body has the table: what smaller grains make of it.
std::optional<Finding> finer_grains(const StageTask& task, const Found& found) {
  std::vector<Cell> missed;
  for (const verdict::JudgedCell& c : verdict::judge_cells(found.verified->rows))
    if (c.outcome == verdict::Outcome::missed && c.row.target.property == Property::nu)
      missed.push_back(cell_of(c.row.target));
  // What no layered elastic body has, no size of grains has either.
  if (missed.empty() || !limits_of(task.evidence, found).empty()) return {};
  const std::vector<std::int64_t> two(task.packings.fit.begin(), task.packings.fit.begin() + 2);
  return grains_for_nu(at_small_strain(task.evidence, found.softenings()), found.elastic(), missed, two,
                       task.simulator);
}

Verdict judged(const Calibration& c, const Evidence& evidence, const Found& found) {
  const ElasticFit& fit = found.elastic();
  verdict::Results r;
  // Moduli come first in the list of fitted values; strengths stand behind them.
  r.moduli.assign(c.fitted.begin(), c.fitted.begin() + std::ssize(fit.comparisons));
  r.parameters.assign(fit.parameters.begin(), fit.parameters.end());
  if (fit.nu_gave_way) r.E_before_nu_gave_way = fit.E_before;
  r.limits_of_table = limits_of(evidence, found);
  if (found.strengths) {
    r.of_search = found.strengths->fit.findings, r.search_settled = found.strengths->fit.shortage.settled;
    for (const Estimate& e : found.strengths->fit.parameters)  // an open one lies anywhere
      if (e.determined) r.parameters.push_back(e);
  }
  r.verification = c.verification, r.reach = c.reach;
  return verdict::judge(r);
}

/// "shale, calibrated", or what else stands in the recipe: the name goes into every file that holds it.
std::string name_of(const Calibration& result, bool moduli, bool strength) {
  if (misses_table(result.verdict.status))
    return result.rock + ", the nearest model (" + to_string(result.verdict.status) + ")";
  const bool open = result.verdict.status == VerdictStatus::not_decided;
  return result.rock +
         (!strength ? ", moduli calibrated, strengths given"
          : moduli  ? ", calibrated"
                    : ", strengths calibrated, moduli given") +
         (open ? " (not decided by the table)" : "");
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

/// Everything that the stages have found, finished or not.
void take(Calibration& c, const Found& found, const StageTask& task) {
  // Also of a calibration that was stopped: what it had come to is shown, and nothing of it is judged.
  c.recipe = found.recipe();
  c.fitted = found.verified ? found.verified->fitted_moduli : found.moduli.fit.comparisons;
  c.verification = found.verified ? found.verified->rows : found.moduli.unseen;
  c.E_is = ModulusReading::small_strain;  // until tests have been read as the laboratory reads its own
  if (found.strengths) {
    const StrengthFit& fit = found.strengths->fit;
    append(c.fitted, fit.fitted), append(c.notes, fit.notes);
    c.left_out = fit.left_out, c.discrepancy = fit.discrepancy, c.residuals = fit.residuals;
    c.mixing = fit.mixing, c.shortage = fit.shortage;
    if (found.verified && found.strengths->answered() && task.scope.read_in_tests)
      c.E_is = task.evidence.rock.E_is;
  }
  if (!found.verified) return;
  append(c.notes, found.verified->notes);
  c.tangent_from_test = found.verified->tangents, c.compared = found.verified->compared;
}

/// Verdict, name and draws of a calibration that is finished.
void conclude(Calibration& c, std::vector<Estimate>& estimates, const Found& found, const StageTask& task) {
  const bool posterior = task.method().has_posterior, strength = found.strengths.has_value();
  c.recipe = ready_to_run(c.recipe, task.evidence);
  report_tests(*found.verified, c.notes);
  c.reach = maps::reach_of(task.evidence, task.options.effort.name == quick_effort.name);
  c.verdict = judged(c, task.evidence, found);
  if (posterior)
    if (const auto finer = finer_grains(task, found)) c.reach.push_back(*finer);
  // An interval of the rock that leaves out what was measured on the rock contradicts itself.
  if (misses_table(c.verdict.status) && verdict::withdraw_intervals(c.fitted))
    c.notes.push_back({FindingKind::intervals_withdrawn});
  append(c.notes, found.elastic().notes);
  c.recipe.name = name_of(c, !found.elastic().parameters.empty(), strength);
  c.eq2 = found.eq2;
  if (!posterior) return;
  // An effort is one of the search: moduli alone have none.
  if (strength) c.effort = task.options.effort.name;
  add_identifiability(estimates, task.evidence, !misses_table(c.verdict.status));
  // Packings that neither fit nor verification has seen: else the band of the draws would lack the scatter of
  // specimens.
  c.ensemble = posterior_ensemble(c.recipe, found.elastic().draws,
                                  strength ? found.strengths->fit.draws : std::vector<Recipe>(),
                                  task.packings.first_of_ensemble);
}

}  // namespace

void check_model(const Evidence& evidence) {
  if (!evidence.fits_strength()) return;
  for (const Parameter* p : strength_parameters(evidence))
    // Before any test, since a box without a value shows only when the search begins, after hours perhaps.
    if (p->strength->check != nullptr) p->strength->check(evidence.rock);
}

Attempt calibrate_by(const Evidence& model, const Calibration& choice, const CalibrationOptions& options,
                     Simulator& simulator, bool pictures_at_once) {
  Attempt attempt{choice, {pictures_at_once, {}, {}, 0}};
  Calibration& c = attempt.calibration;
  c.layers = model.rock.layers;
  const Scope scope = scope_of(model, options);
  append(c.notes, scope.notes);
  if (scope.strengths) check_model(model);
  const Packings packings = packings_from(model.rock.model.packing.seed);
  const StageTask task{model, options, scope, packings, simulator, simulator.count().compression()};
  Found found;
  try {
    run_stages(task, found, attempt.pictures);
  } catch (const Stopped&) {
    c.verdict = {VerdictStatus::interrupted, {{FindingKind::stopped}}};
  }
  take(c, found, task);
  std::vector<Estimate> estimates = found.elastic().parameters;
  if (found.strengths) append(estimates, found.strengths->fit.parameters);
  if (found.finished) conclude(c, estimates, found, task);
  // In front: the share of the planes that is jointed stands there already, from the choice of the model.
  c.parameters.insert(c.parameters.begin(), estimates.begin(), estimates.end());
  attempt.n_tests = task.spent();
  return attempt;
}

}  // namespace phy::calibrate
