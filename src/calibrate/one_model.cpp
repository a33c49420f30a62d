#include "calibrate/one_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "base/check.hpp"
#include "base/lines.hpp"
#include "base/option.hpp"
#include "base/stats.hpp"
#include "calibrate/elastic_fit.hpp"
#include "calibrate/elastic_response.hpp"
#include "calibrate/eq2.hpp"
#include "calibrate/margin.hpp"
#include "calibrate/posterior_ensemble.hpp"
#include "calibrate/sequence.hpp"
#include "calibrate/strength_stage.hpp"
#include "calibrate/toughness.hpp"
#include "calibrate/verdict.hpp"
#include "survey/identifiability.hpp"

namespace phy::calibrate {
namespace {

constexpr int n_fit = 5;                         // packings of the elastic fit
constexpr int n_unseen = verification_packings;  // at first
constexpr int n_eq2 = 2;                         // packings for Eq. 2
constexpr int n_spare = 15;                      // more for the elastic fit, where packings differ much
constexpr int n_softened = 5;                    // on which softening is measured at the estimate
constexpr int n_search = 60;             // of the search, which hardly takes one twice: fit, spare and more
constexpr double modulus_change = 0.05;  // of E from small strain to half of UCS, which is worth a word

/// Seeds from `first` on.
std::vector<std::int64_t> seeds_from(std::int64_t first, int n) {
  std::vector<std::int64_t> seeds(static_cast<std::size_t>(n));
  std::iota(seeds.begin(), seeds.end(), first);
  return seeds;
}

std::size_t n_angles(const std::vector<Comparison>& rows) {
  std::set<double> angles;
  for (const Comparison& c : rows) angles.insert(c.target.theta);
  return angles.size();
}

bool all_answered(const std::vector<Comparison>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const Comparison& c) { return c.answered(); });
}

/// The estimate of what was sought of a parameter; it stands before that of the strength behind a ratio.
const Estimate* estimate_of(const std::vector<Estimate>& list, const CalibratedParameter* p) {
  const auto it = std::find_if(list.begin(), list.end(), [&](const Estimate& e) { return e.parameter == p; });
  return it == list.end() ? nullptr : &*it;
}

/// A strength follows from a chain of ratios, and what pins the open ones pins it: of an open estimate, the
/// nearest ratio that is open itself.
const CalibratedParameter* open_link(const std::vector<Estimate>& estimates, const Estimate& open) {
  for (const CalibratedParameter* p = open.parameter; p == open.parameter || p->over != nullptr; p = p->over)
    if (const Estimate* e = estimate_of(estimates, p); e != nullptr && !e->determined) return p;
  return open.parameter;
}

/// Which data speak about each parameter, and what would pin the others. `met`: the model meets the table.
void add_identifiability(std::vector<Estimate>& estimates, const Evidence& evidence, bool met) {
  const std::vector<Estimate> identifiable = survey::identifiability(evidence);
  for (Estimate& e : estimates) {
    const Estimate& f = *estimate_of(identifiable, e.determined ? e.parameter : open_link(estimates, e));
    if (e.determined)
      e.rests_on = f.rests_on;
    else if (f.determined)
      e.next = met ? NextStep{Remedy::more_specimens, f.rests_on.tests} : NextStep{Remedy::meet_table};
    else
      e.next = f.next;
  }
}

/// Brazilian tests of the verification that are none by the rule of the ISRM.
void report_validity(Calibration& result) {
  for (const Comparison& c : result.verification)
    if (c.n_invalid > 0)
      add_line(result.notes, cell_name(c.target),
               fmt::format(
                   "in {} of {} tests on unseen packings the first crack came outside the central third of "
                   "the disc; peak loads are compared all the same",
                   c.n_invalid, c.n_packings));
}

/// Warnings about the tests behind the strengths of the verification.
void report_quality(Calibration& result) {
  QualityTally tally;
  for (const Comparison& c : result.verification) tally.add(c.quality);
  if (!tally.text().empty()) result.notes.push_back("on unseen packings " + tally.text());
}

/// Strengths of which not every unseen packing has one.
void report_missing(Calibration& result, int n_tested) {
  for (const Comparison& c : result.verification)
    if (is_strength(c.target.property) && c.answered() && c.n_packings < n_tested)
      add_line(result.notes, cell_name(c.target),
               fmt::format("{} of {} tests on unseen packings gave no usable peak ({})",
                           n_tested - c.n_packings, n_tested, c.missing));
}

/// Are there strengths to fit? What is not fitted is noted; a table with nothing to fit is an InputError.
bool fits_strength(Calibration& result, const Evidence& evidence, const CalibrationOptions& options) {
  const bool elastic_only = options.elastic_only, sequence = options.method == CalibrationMethod::sequence;
  const bool moduli = evidence.has(Property::E),
             strength = !elastic_only && evidence.fits_strength() &&
                        !(sequence && !evidence.has(Property::ucs));  // which has no other way to sigma_c
  if (!moduli && !strength)
    throw InputError(Problem{result.rock, "table", "",
                             elastic_only ? "values of E" : "values of E, or of a strength in compression",
                             "there is nothing to fit; `phyllite rock check` tells what the table holds"});
  if (!moduli) result.notes.emplace_back("no E in the table: the elastic parameters are those of the recipe");
  if (moduli && !(strength && !tests_to_read(evidence).empty()) &&
      evidence.rock.E_is != ModulusReading::small_strain)
    result.notes.push_back(
        fmt::format("E_is = \"{}\": without {} nothing tells how far a test softens until then; E and nu "
                    "are compared at small strain",
                    to_string(evidence.rock.E_is), strength ? "UCS" : "strengths"));
  if (!strength)
    result.notes.push_back(fmt::format("{}: the strengths are those of the recipe, not calibrated",
                                       elastic_only ? "the elastic part only"
                                       : sequence   ? "no UCS in the table"
                                                    : "no strength in compression in the table"));
  return strength;
}

/// Are the table's moduli those of tests, softened by what breaks and slips until they are read? With neither
/// UCS nor moduli under confinement there is no test to tell it by.
bool softened(const Evidence& evidence, const CalibrationOptions& options) {
  return evidence.rock.E_is != ModulusReading::small_strain && evidence.has(Property::E) &&
         !options.elastic_only && !tests_to_read(evidence).empty();
}

/// Tests in compression on one packing beside the search: some are done to read moduli in alone.
std::int64_t n_at_estimate(const Evidence& evidence, bool softens) {
  return evidence.n_compressive() + (softens ? static_cast<std::int64_t>(evidence.read_only.size()) : 0);
}

/// All of them: on unseen packings, and where softening is measured.
std::int64_t n_beside_search(const Evidence& evidence, bool softens) {
  return n_at_estimate(evidence, softens) * (n_unseen + (softens ? n_softened : 0));
}

/// What stages hand on.
struct Work {
  const Evidence& evidence;
  const CalibrationOptions& options;
  Simulator& simulator;
  std::vector<std::int64_t> fit, spare, search, unseen;  ///< packings
  std::int64_t next_unseen = 0;        ///< of the verification, where it asks for more packings
  std::int64_t first_of_ensemble = 0;  ///< of those that nothing before has seen
  ElasticFit elastic;
  std::vector<Comparison> first_unseen;  ///< moduli, of which the verification has the means
  StrengthFit strength;
  Pictures& pictures;

  Work(const Evidence& of, const CalibrationOptions& with, Simulator& by, Pictures& shown)
      : evidence(of), options(with), simulator(by), pictures(shown) {
    const std::int64_t first = evidence.rock.model.packing.seed;
    fit = seeds_from(first, n_fit), unseen = seeds_from(first + n_fit, n_unseen);
    spare = seeds_from(first + n_fit + n_unseen, n_spare);
    next_unseen = first + n_fit + n_unseen + n_spare;
    first_of_ensemble = next_unseen + static_cast<std::int64_t>(most_packings - first_packings);
    search = fit;
    const std::int64_t first_beyond = first_of_ensemble + static_cast<std::int64_t>(ensemble_size);
    for (const auto& more : {spare, seeds_from(first_beyond, n_search - n_fit - n_spare)})
      search.insert(search.end(), more.begin(), more.end());
  }
  bool softens() const { return softened(evidence, options); }
  bool by_sequence() const { return options.method == CalibrationMethod::sequence; }
  void fit_moduli(const Evidence& table) {
    elastic = by_sequence() ? moduli_by_sequence(table, fit, simulator, options.listener.say)
                            : fit_elastic(table, fit, spare, simulator, options.listener.say);
    options.listener.estimates({elastic.parameters.begin(), elastic.parameters.end()});
  }
  StrengthFit fit_strengths(const Recipe& recipe, std::int64_t max_tests, const Remodel& remodel) {
    return by_sequence() ? strengths_by_sequence(evidence, recipe, search.front(), max_tests, simulator,
                                                 options.listener.say, remodel)
                         : fit_strength(evidence, recipe, search, {max_tests, options.effort}, simulator,
                                        options.listener, remodel);
  }
};

/// Moduli of small strain on the unseen packings.
void verify_moduli(Calibration& result, Work& work) {
  const std::vector<Target>& moduli = work.evidence.moduli;
  Solutions solutions = solve_angles(result.recipe, moduli, work.unseen, Statics::one_sided, work.simulator);
  result.verification = over_packings(solutions, moduli);
  for (auto& [theta, on_packings] : solutions) on_packings.resize(1);
  work.first_unseen = over_packings(solutions, moduli);
}

/// A modulus at small strain as the laboratory would read it.
void soften(Comparison& c, const Softening& s) {
  const bool modulus = c.target.property == Property::E;
  for (double* v : {&c.mean, &c.low, &c.high}) *v = modulus ? *v * s.factor : *v + s.addition;
  if (modulus) c.sd *= s.factor;
}

/// E and nu of the press beside those at small strain, of which the table holds values: what tests make of
/// the solutions on their packings is made of the means over all. Where they differ much, the user must know
/// which of the two the laboratory means.
void add_tangents_from_test(Calibration& result, const Work& work, const std::vector<Comparison>& from_test) {
  std::vector<Comparison> read;  // 50 % of UCS
  for (const Comparison& p : from_test)
    if (p.target.confining == 0.0 && row_of(result.verification, p.target) != nullptr) read.push_back(p);
  if (read.empty()) return;
  const auto on_several = [](const Comparison& c) { return c.n_packings > 1; };
  const std::vector<Comparison>& solved =  // on the packings of these tests
      std::any_of(read.begin(), read.end(), on_several) ? result.verification : work.first_unseen;
  std::vector<double> changes;  // of E, logarithms
  for (Comparison& c : read) {
    const Comparison &small_strain = *row_of(result.verification, c.target),
                     &same = *row_of(solved, c.target);
    const bool modulus = c.target.property == Property::E;
    if (modulus && c.answered()) changes.push_back(std::log(c.mean / same.mean));
    c.target = small_strain.target;
    c.mean = modulus ? small_strain.mean * c.mean / same.mean : small_strain.mean + c.mean - same.mean;
  }
  result.tangent_from_test = read;
  const double change = std::expm1(summarise(changes).mean);
  if (std::fabs(change) > modulus_change)
    result.notes.push_back(fmt::format(
        "E and nu of the table are read as those at small strain (E_is). At 40 - 60 % of UCS the press "
        "measures other ones (column \"at 50 % UCS\"): E {:+.0f} % in the mean over the angles",
        100.0 * change));
}

/// Moduli as the laboratory reads them, fitted and on unseen packings, in place of those at small strain.
void take_as_measured(Calibration& result, const Work& work, const std::vector<Comparison>& from_test) {
  result.E_is = work.evidence.rock.E_is;
  for (std::size_t i = 0; i < work.elastic.comparisons.size(); ++i) {
    Comparison& c = result.fitted[i];
    c = work.elastic.comparisons[i], c.target = work.evidence.moduli[i];
    soften(c, softening_at(work.strength.softenings, test_of_cell(c.target)));
  }
  std::vector<std::string> without;  // a test of their own
  for (Comparison& c : result.verification) {
    const Target target = c.target;
    const Comparison* p = row_of(from_test, target);
    if (p == nullptr || !p->answered())
      soften(c, softening_at(work.strength.softenings, test_of_cell(target))),
          without.push_back(cell_name(target));
    else
      c = *p, c.target = target;
  }
  if (!without.empty())
    result.notes.push_back(fmt::format(
        "{}: no strength of the same test to read them with; the direct solution with what the nearest tests "
        "of the table have shown",
        fmt::join(without, ", ")));
}

/// Root mean square error of E as the laboratory reads it, of a model whose softenings were measured.
double misfit_as_read(const Work& work, const Softenings& measured) {
  double squares = 0.0;
  int n = 0;
  for (std::size_t i = 0; i < work.elastic.comparisons.size(); ++i) {
    const Target& t = work.evidence.moduli[i];
    if (t.property != Property::E) continue;
    const double E = work.elastic.comparisons[i].mean * softening_at(measured, test_of_cell(t)).factor;
    squares += std::pow(E / t.mean - 1.0, 2), ++n;
  }
  return std::sqrt(squares / n);
}

/// Moduli, what tests make of them, and how far that is off the table.
struct Pass {
  Recipe recipe;
  ElasticFit elastic;
  Softenings softenings;
  double misfit = std::numeric_limits<double>::infinity();
};

/// What tests make of the moduli, measured at the estimate, and the moduli that follow from it, in turn until
/// E as it is read is settled. The last may not be the nearest: how far a test softens depends on the moduli,
/// so that the steps are damped, and the best of them is taken. Where one measurement is all that can be paid
/// (or the specimens are so large that the search takes coarse grains) the moduli follow it once, unmeasured.
/// False: stopped.
bool measure_softening(Calibration& result, Work& work, const Remodel& remodel) {
  constexpr int most_passes = 4;
  const std::vector<std::int64_t> some(work.fit.begin(), work.fit.begin() + n_softened);
  const std::vector<Target> tests = tests_to_read(work.evidence);
  const auto n = static_cast<std::int64_t>(tests.size() * some.size());
  const std::int64_t reserved = n_at_estimate(work.evidence, true) * n_unseen;
  Pass nearest;
  for (int pass = 1; pass <= most_passes; ++pass) {
    work.options.listener.say("moduli as the laboratory reads them, at the estimate");
    const Softenings measured = softenings_of(result.recipe, work.evidence.rock.model, tests, some,
                                              work.evidence.rock.E_is, work.simulator);
    if (work.simulator.stopped()) return false;
    result.n_strength_tests += n, result.n_elastic += n;
    if (measured.empty()) break;
    if (const double misfit = misfit_as_read(work, measured); misfit < nearest.misfit)
      nearest = {result.recipe, work.elastic, measured, misfit};
    if (settled(work.strength.softenings, measured)) break;
    const std::int64_t spent = result.n_strength_tests - result.n_tension_tests;
    const bool again = spent + n + reserved <= work.options.max_tests && !has_coarse(result.recipe);
    if (!again && pass > 1) break;
    work.strength.softenings = stepped(work.strength.softenings, measured);
    result.recipe = with_moduli(result.recipe, remodel(work.strength.softenings).recipe);
    if (!again) {
      nearest = {result.recipe, work.elastic, measured, nearest.misfit};
      break;
    }
  }
  if (!nearest.softenings.empty())
    result.recipe = nearest.recipe, work.elastic = nearest.elastic,
    work.strength.softenings = nearest.softenings;
  result.verification = elastic_response(as_for_moduli(result.recipe, work.evidence.rock.model),
                                         work.evidence.moduli, work.unseen, work.simulator);
  result.n_elastic += static_cast<std::int64_t>(n_angles(result.verification) * work.unseen.size());
  return true;
}

/// Would more unseen packings tell more, and may they be had? Specimens so large that the search takes coarse
/// grains keep to the first: theirs are most of what a calibration costs.
bool takes_more_packings(Calibration& result, const Work& work, const std::vector<Comparison>& rows) {
  if (work.simulator.stopped() || work.unseen.size() >= most_packings || !wants_packings(rows)) return false;
  if (has_coarse(result.recipe)) return false;
  const std::int64_t spent = result.n_strength_tests - result.n_tension_tests;
  if (spent + n_at_estimate(work.evidence, work.softens()) * n_unseen <= work.options.max_tests) return true;
  result.notes.emplace_back(
      "strengths of packings of this size differ much: more unseen ones would tell more, and a larger "
      "--max-tests takes them");
  return false;
}

Recipe with_pictures(Recipe recipe) {
  const TestRecipe usual;
  recipe.test.n_snapshots = usual.n_snapshots, recipe.test.n_frames = usual.n_frames;
  return recipe;
}

std::vector<double> means_of(const std::vector<Comparison>& rows) {
  std::vector<double> means;
  for (const Comparison& c : rows) means.push_back(c.mean);
  return means;
}

/// Strengths on unseen packings, and on more of them where they differ much; the moduli on as many.
std::vector<Comparison> verify_strength(Calibration& result, Work& work, std::vector<Comparison>& from_test) {
  const Evidence& evidence = work.evidence;
  const ModulusReading reading = work.softens() ? evidence.rock.E_is : ModulusReading::tangent_50;
  std::vector<Target> tests = evidence.strengths;
  if (work.softens()) tests.insert(tests.end(), evidence.read_only.begin(), evidence.read_only.end());
  const std::int64_t n_tension = evidence.n_tests() - evidence.n_compressive(),
                     n = n_tension + n_at_estimate(evidence, work.softens());
  work.pictures = {work.pictures.at_once, with_pictures(result.recipe), tests, work.unseen.front()};
  work.pictures.recipe.name = result.rock + ", on a packing that the fit has not seen";
  const Recipe& pressed = work.pictures.at_once ? work.pictures.recipe : result.recipe;
  const Loadings loadings = of_verification(work.softens(), means_of(work.strength.fitted));
  std::vector<Comparison> rows;
  for (;;) {
    work.options.listener.say(
        fmt::format("verification of the strengths on {} unseen packings", work.unseen.size()));
    from_test.clear();
    rows = strength_response(pressed, tests, work.unseen, loadings, work.simulator, reading, &from_test);
    rows.resize(evidence.strengths.size());
    result.n_strength_tests += n * n_unseen,
        result.n_tension_tests += n_tension * n_unseen;  // the others are known
    if (!takes_more_packings(result, work, rows)) break;
    const std::vector<std::int64_t> next = seeds_from(work.next_unseen, n_unseen);
    work.unseen.insert(work.unseen.end(), next.begin(), next.end()), work.next_unseen += n_unseen;
  }
  if (work.unseen.size() == first_packings) return rows;
  result.notes.push_back(fmt::format(
      "strengths of packings of this size differ so much that {} unseen ones were taken instead of {}",
      work.unseen.size(), n_unseen));
  if (work.softens()) return rows;
  result.n_elastic +=
      static_cast<std::int64_t>(n_angles(result.verification) * (work.unseen.size() - n_unseen));
  verify_moduli(result, work);
  return rows;
}

/// K_Ic of a rock whose grain size nobody has stated, on the packings of the verification.
void compare_toughness(Calibration& result, const Work& work) {
  const std::vector<Target>& compared = work.evidence.compared;
  if (compared.empty() || work.simulator.stopped()) return;
  work.options.listener.say(fmt::format("K_Ic on {} unseen packings, to compare", work.unseen.size()));
  result.compared = strength_response(result.recipe, compared, work.unseen, as_measured, work.simulator);
  const auto n = static_cast<std::int64_t>(compared.size() * work.unseen.size());
  result.n_strength_tests += n, result.n_tension_tests += n;
  result.notes.insert(result.notes.begin(), compared_in_words(result.compared, result.recipe));
}

/// Strengths against the table, then on unseen packings. False: stopped by the user.
bool calibrate_strength(Calibration& result, Work& work) {
  const Evidence& evidence = work.evidence;
  const std::int64_t reserved = n_beside_search(evidence, work.softens());
  Remodel remodel;
  if (work.softens())
    remodel = [&](const Softenings& s) {
      work.fit_moduli(at_small_strain(evidence, s));
      result.n_elastic += work.elastic.n_solutions;
      return Remodelled{work.elastic.recipe, work.elastic.comparisons};
    };
  StrengthFit& fit = work.strength;
  fit = work.fit_strengths(result.recipe, work.options.max_tests - reserved, remodel);
  result.recipe = fit.recipe;
  result.n_strength_tests = fit.n_tests, result.n_coarse_tests = fit.n_coarse;
  result.n_tension_tests = fit.n_tension, result.n_elastic += fit.n_solutions;
  result.fitted.insert(result.fitted.end(), fit.fitted.begin(), fit.fitted.end());
  result.left_out = fit.left_out, result.mixing = fit.mixing;
  result.verdict.findings = fit.findings;
  result.notes.insert(result.notes.end(), fit.notes.begin(), fit.notes.end());
  if (fit.interrupted) return false;
  const auto is_silent = [](const Comparison& c) { return !c.answered(); };
  if (std::any_of(fit.fitted.begin(), fit.fitted.end(), is_silent))
    return result.verdict.status = VerdictStatus::out_of_reach, true;
  if (work.softens() && !measure_softening(result, work, remodel)) return false;
  std::vector<Comparison> from_test;
  const std::vector<Comparison> rows = verify_strength(result, work, from_test);
  if (work.softens())
    take_as_measured(result, work, from_test);
  else
    add_tangents_from_test(result, work, from_test);
  result.verification.insert(result.verification.end(), rows.begin(), rows.end());
  compare_toughness(result, work);
  return !work.simulator.stopped();
}

/// A recipe for `phyllite run`: all angles of the table, pictures and curve beyond the peak.
void make_ready(Recipe& recipe, const Evidence& evidence) {
  const TestRecipe usual;
  recipe = with_pictures(std::move(recipe));
  take_packing(recipe, recipe.packing.seed);
  TestRecipe& test = recipe.test;
  test.kind = usual.kind;  // which keeps no stress
  test.confining_stress = test.normal_stress = test.normal_stiffness = 0.0;
  test.stop_at = usual.stop_at, test.post_peak = usual.post_peak;
  std::set<double> angles;
  if (evidence.rock.bedded)
    for (const Target& t : evidence.targets) angles.insert(t.theta);
  test.angles.assign(angles.begin(), angles.end());
}

/// "shale, calibrated", or what else stands in the recipe: the name goes into every file that holds it.
std::string name_of(const Calibration& result, bool moduli, bool strength) {
  if (result.verdict.status == VerdictStatus::out_of_reach)
    return result.rock + ", the nearest model (out of reach)";
  const bool open = result.verdict.status == VerdictStatus::not_resolved;
  return result.rock +
         (!strength ? ", moduli calibrated, strengths given"
          : moduli  ? ", calibrated"
                    : ", strengths calibrated, moduli given") +
         (open ? " (not resolved by the table)" : "");
}

/// All stages one after the other. False: stopped by the user.
bool run_stages(Calibration& result, std::vector<Estimate>& estimates, const Evidence& evidence,
                const CalibrationOptions& options, Simulator& simulator, Pictures& pictures) {
  bool strength = fits_strength(result, evidence, options);
  Work work(evidence, options, simulator, pictures);
  result.E_is = ModulusReading::small_strain;  // until tests have been read as the laboratory reads its own
  if (strength) check_model(evidence);
  work.fit_moduli(evidence);
  estimates = work.elastic.parameters;
  result.recipe = work.elastic.recipe;
  result.fitted = work.elastic.comparisons;
  result.n_elastic += work.elastic.n_solutions;
  options.listener.say("verification of the moduli on unseen packings");
  verify_moduli(result, work);
  result.n_elastic += static_cast<std::int64_t>(n_angles(result.verification) * work.unseen.size());
  strength = strength && all_answered(work.elastic.comparisons);
  bool finished = true;
  try {
    finished = !strength || calibrate_strength(result, work);
  } catch (const Stopped&) {  // in the middle of elastic solutions
    finished = false;
  }
  estimates = work.elastic.parameters;  // what is known, also where it ends here
  estimates.insert(estimates.end(), work.strength.parameters.begin(), work.strength.parameters.end());
  if (!finished) return false;
  make_ready(result.recipe, evidence);
  report_validity(result), report_quality(result),
      report_missing(result, static_cast<int>(work.unseen.size()));
  judge(result, work.elastic, at_small_strain(evidence, work.strength.softenings),
        !work.strength.softenings.empty());
  if (strength && !work.by_sequence()) result.effort = options.effort.name;
  result.longer_by = work.strength.longer_by;
  if (!result.longer_by.empty())
    result.notes.push_back(
        fmt::format("the search was short: {} may come nearer and know more", result.longer_by));
  result.notes.insert(result.notes.end(), work.elastic.notes.begin(), work.elastic.notes.end());
  if (!work.by_sequence())
    add_identifiability(estimates, evidence, result.verdict.status != VerdictStatus::out_of_reach);
  result.recipe.name = name_of(result, !work.elastic.parameters.empty(), strength);
  if (!work.by_sequence() && has_eq2(result.recipe)) {  // a sequence has lines of its own on the way
    options.listener.say(
        "Eq. 2 on packings of the fit, and what spacing and rule of the planes change in it");
    const std::vector<std::int64_t> some(work.fit.begin(), work.fit.begin() + n_eq2);
    result.eq2 = eq2_band(result.recipe, some, simulator);
    result.n_elastic += n_solutions_of(result.eq2, some.size());
  }
  if (!work.by_sequence())
    result.ensemble =
        posterior_ensemble(result.recipe, work.elastic.draws, work.strength.draws, work.first_of_ensemble);
  return true;
}

}  // namespace

Verdict stopped_by_user() {
  return {VerdictStatus::interrupted, {"stopped by the user; finished tests are in the store"}};
}

std::int64_t least_tests(const Evidence& evidence, const CalibrationOptions& options) {
  if (options.elastic_only || !evidence.fits_strength()) return 0;
  return evidence.n_compressive() * least_points + n_beside_search(evidence, softened(evidence, options));
}

void check_budget(const Evidence& evidence, const CalibrationOptions& options) {
  Calibration without_notes;
  without_notes.rock = evidence.rock.name;
  if (!fits_strength(without_notes, evidence, options)) return;
  const std::int64_t least = least_tests(evidence, options), n = evidence.n_compressive();
  if (options.max_tests < least)
    throw InputError(
        option_problem("max-tests", fmt::format("{}", options.max_tests), fmt::format("at least {}", least),
                       fmt::format("{} strengths in compression, each with {} tests of the search, and {} "
                                   "tests at the estimate",
                                   n, least_points, least - n * least_points)));
}

void check_model(const Evidence& evidence) {
  if (!evidence.fits_strength()) return;
  for (const StrengthParameter* p : strength_parameters(evidence))
    if (p->check != nullptr) p->check(evidence.rock);
}

Attempt calibrate_by(const Evidence& model, const Calibration& choice, const CalibrationOptions& options,
                     Simulator& simulator, bool pictures_at_once) {
  Attempt attempt{choice, {pictures_at_once, {}, {}, 0}};
  Calibration& result = attempt.calibration;
  std::vector<Estimate> estimates;
  bool done = false;
  result.layers = model.rock.layers;
  try {
    done = run_stages(result, estimates, model, options, simulator, attempt.pictures);
  } catch (const Stopped&) {  // in the middle of elastic solutions
  }
  result.parameters.insert(result.parameters.begin(), estimates.begin(), estimates.end());
  if (!done) result.verdict = stopped_by_user();
  return attempt;
}

void press_pictures(const Pictures& pictures, Calibration& result, Simulator& simulator) {
  if (pictures.at_once || pictures.tests.empty() || simulator.stopped()) return;
  strength_response(pictures.recipe, pictures.tests, {pictures.packing}, as_measured, simulator);
  if (simulator.stopped()) result.verdict = stopped_by_user();
}

}  // namespace phy::calibrate
