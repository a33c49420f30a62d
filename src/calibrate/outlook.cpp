#include "calibrate/outlook.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "calibrate/method.hpp"
#include "calibrate/model_trial.hpp"
#include "calibrate/plan.hpp"
#include "calibrate/search_plan.hpp"
#include "calibrate/sequence.hpp"
#include "calibrate/softening.hpp"
#include "calibrate/stages.hpp"
#include "calibrate/strength_tests.hpp"
#include "maps/candidates.hpp"
#include "study/expected.hpp"
#include "verdict/cells.hpp"

namespace phy::calibrate {
namespace {

using Kind = FindingKind;

// Direct solutions of one inclination by stage, in those of contacts that also pull; one-sided ones take five
// times as long. One costs a share of what expected_direct_cost() says of both presses. Measured on twenty
// calibrations (measured/time.csv).
constexpr double of_presses = 0.05, one_sided = 5.0, of_first_fit = 12.0, of_packing = 10.0,
                 of_packing_anew = 17.0, of_eq2 = 30.0;
// What draws and surrogates take beside the tests, per strength and batch, in the same unit as these; and
// where models are compared, per pair of strengths.
constexpr double of_learning = 4e6, of_comparing = 1.2e6;
// A test goes on until it has lost a fifth or has twice the strain of its peak, which expected_cost() does
// not count.
constexpr double beyond_expected = 1.75;
constexpr double least_packings = 5.0, most_packings = 20.0;  // of a fit of the moduli
constexpr double flat_joint_cost = 2.0;                       // of a contact and cycle, over parallel bonds
constexpr int sequence_tests = 8;                             // of a step of the sequence

/// E of the table nearest to an inclination [Pa]; without any that of the recipe.
double modulus_at(const Evidence& evidence, double theta) {
  const Target* nearest = nullptr;
  for (const Target& t : evidence.moduli)
    if (t.property == Property::E &&
        (nearest == nullptr || std::fabs(t.theta - theta) < std::fabs(nearest->theta - theta)))
      nearest = &t;
  return nearest != nullptr ? nearest->mean : evidence.rock.model.matrix.modulus();
}

/// As stiff as the table: stiffness decides the time step.
Recipe scaled(Recipe recipe, double largest_modulus) {
  if (!(largest_modulus > 0.0)) return recipe;
  const double factor = largest_modulus / recipe.matrix.modulus();
  recipe.matrix.E_c *= factor, recipe.matrix.E_b *= factor;
  return recipe;
}

/// Tests of some targets on one packing.
struct PointCost {
  double cost = 0.0;
  std::int64_t tests = 0, compression = 0;
  /// Fewer tests than lanes leave some of these empty, though a test alone takes several (decision 0013).
  PlannedStage stage(Kind kind, bool certain, std::int64_t times) const {
    constexpr double lanes = 16.0;
    const auto n = static_cast<double>(times);
    const double share = static_cast<double>(tests) * n / lanes;
    return {kind, certain, cost * n / std::sqrt(std::clamp(share, 1.0 / lanes, 1.0)), tests * times,
            compression * times};
  }
};

class CostOfTests {
 public:
  CostOfTests(const Evidence& evidence, const std::vector<Target>& targets)
      : evidence_(evidence),
        targets_(targets),
        settings_(test_settings(scaled(evidence.rock.model, evidence.scales.modulus), compressed(),
                                moduli_of(compressed()))),
        tests_(settings_, targets, moduli_of(targets)) {}

  PointCost on(Grains grains, const Loading& loading) const {
    const Recipe recipe = grains == Grains::coarse ? coarse(settings_) : settings_;
    PointCost point;
    const double of_contact = recipe.matrix.model == MatrixModel::flat_joint ? flat_joint_cost : 1.0;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      if (measured(targets_[i].property).read_in) continue;  // in a test of another
      const Recipe one = tests_.of(recipe, i, recipe.packing.seed, loading);
      point.cost += beyond_expected * of_contact * study::expected_cost(one, tests_.peak_strain(i));
      ++point.tests;
      point.compression += is_compressive(targets_[i].property) ? 1 : 0;
    }
    return point;
  }
  Recipe const& settings() const { return settings_; }

 private:
  const Evidence& evidence_;
  const std::vector<Target>& targets_;
  Recipe settings_;
  StrengthTests tests_;

  std::vector<Target> compressed() const {
    std::vector<Target> of;
    for (const Target& t : targets_)
      if (is_compressive(t.property) && !measured(t.property).read_in) of.push_back(t);
    return of;
  }
  std::vector<double> moduli_of(const std::vector<Target>& targets) const {
    std::vector<double> moduli;
    for (const Target& t : targets) moduli.push_back(modulus_at(evidence_, t.theta));
    return moduli;
  }
};

/// A direct solution at every inclination of the moduli, contacts that also pull.
double cost_of_solutions(const Evidence& evidence) {
  std::set<double> angles;
  for (const Target& t : evidence.moduli) angles.insert(t.theta);
  return static_cast<double>(angles.size()) * of_presses * study::expected_direct_cost(evidence.rock.model);
}

/// Packings that a fit of the moduli takes until their scatter is averaged out (elastic_fit.cpp): of layers
/// thirty of 1,200 grains would do so, the finer the fewer.
double packings_of_fit(const Evidence& evidence) {
  constexpr double of_grains = 30.0 * 1200.0;
  if (!evidence.rock.bedded) return least_packings;
  return std::clamp(of_grains / study::expected_grains(evidence.rock.model), least_packings, most_packings);
}

class ModelCourse {
 public:
  ModelCourse(const Evidence& evidence, const CalibrationOptions& options)
      : evidence_(evidence),
        options_(options),
        scope_(scope_of(evidence, options)),
        solutions_(cost_of_solutions(evidence)),
        packings_(packings_of_fit(evidence)) {}

  std::vector<PlannedStage> stages() {
    if (scope_.moduli) add_moduli();
    if (scope_.strengths) add_strengths();
    if (evidence_.rock.bedded && method().has_posterior) add(Kind::course_eq2, false, of_eq2 * solutions_);
    drop_beyond_budget();
    return stages_;
  }

 private:
  const Evidence& evidence_;
  const CalibrationOptions& options_;
  Scope scope_;
  double solutions_;  ///< cost of one at every inclination
  double packings_;
  std::vector<PlannedStage> stages_;

  const Method& method() const { return method_of(options_.method); }
  void add(Kind kind, bool certain, double cost) { stages_.push_back({kind, certain, cost}); }

  void add_moduli() {
    add(Kind::course_moduli, true, of_first_fit * solutions_);
    if (method().has_posterior) {
      add(Kind::course_moduli_packings, true, of_packing * packings_ * solutions_);
      add(Kind::course_moduli_packings, false,
          of_packing * std::min(packings_, most_packings - packings_) * solutions_);
    }
    add(Kind::course_moduli_unseen, true, one_sided * verification_packings * solutions_);
  }

  void add_strengths() {
    const CostOfTests strengths(evidence_, evidence_.strengths);
    const bool read = scope_.read_in_tests;
    if (method().has_posterior)
      add_search(strengths);
    else
      for (int k = 0; k < most_sequence_rounds; ++k)
        stages_.push_back(
            strengths.on(Grains::own, as_measured).stage(Kind::course_step, k == 0, sequence_tests));
    std::vector<Target> tests = evidence_.strengths;
    if (read) tests.insert(tests.end(), evidence_.read_only.begin(), evidence_.read_only.end());
    const PointCost whole = CostOfTests(evidence_, tests).on(Grains::own, as_measured);
    if (read)
      for (int k = 0; k < (has_coarse(strengths.settings()) ? 1 : most_softenings); ++k)
        stages_.push_back(whole.stage(Kind::course_softening, k == 0, n_softened)), add_refit();
    // As verification.cpp decides it: specimens with a coarse stage keep to five packings.
    const bool may_grow = !has_coarse(strengths.settings());
    const auto most = static_cast<int>(may_grow ? verdict::most_packings : verification_packings);
    for (int n = verification_packings; n <= most; n += verification_packings)
      stages_.push_back(whole.stage(Kind::course_unseen, n == verification_packings, verification_packings));
    if (!evidence_.compared.empty())
      stages_.push_back(CostOfTests(evidence_, evidence_.compared)
                            .on(Grains::own, as_measured)
                            .stage(Kind::course_toughness, true, verification_packings));
  }

  void add_search(const CostOfTests& strengths) {
    const std::size_t n_ratios = strength_ratios(evidence_).size();
    const Budget budget = {options_.max_tests - tests_beside_search(evidence_, scope_.read_in_tests),
                           options_.effort};
    const SearchPlan plan = plan_search(budget, n_ratios, evidence_.n_compressive(),
                                        course_of(strengths.settings(), evidence_.strengths));
    const Loading& loading = scope_.read_in_tests ? search_with_moduli : search_of_strengths;
    const auto batch = [&](Grains grains, std::size_t n, bool certain) {
      PlannedStage s =
          strengths.on(grains, loading).stage(Kind::course_batch, certain, static_cast<std::int64_t>(n));
      s.cost += of_learning * static_cast<double>(evidence_.strengths.size());
      stages_.push_back(s);
      if (scope_.read_in_tests) add_refit();
    };
    for (const Batch& b : plan.batches) batch(b.grains, b.n_points, true);
    for (std::size_t k = plan.batches.size(); k < plan.most_batches; ++k)
      batch(Grains::own, packings_per_round, false);
  }

  /// The moduli anew behind the last stage: it has no beginning of its own.
  void add_refit() { stages_.back().cost += of_packing_anew * packings_ * solutions_; }

  /// What may come, but would go beyond the tests that are allowed.
  void drop_beyond_budget() {
    std::int64_t left = options_.max_tests;
    // What is certain is paid first; only the rest competes for what is left.
    for (const PlannedStage& s : stages_) left -= s.certain ? s.compression : 0;
    std::erase_if(stages_, [&](const PlannedStage& s) {
      if (s.certain || s.compression == 0) return false;
      left -= s.compression;
      return left < 0;
    });
  }
};

Ahead ahead_of(const std::vector<PlannedStage>& stages) {
  Ahead a;
  for (const PlannedStage& s : stages) {
    a.most_cost += s.cost, a.most_tests += s.tests;
    if (s.certain) a.least_cost += s.cost, a.least_tests += s.tests;
  }
  return a;
}

std::int64_t compression_of(const std::vector<PlannedStage>& stages, bool certain_alone) {
  std::int64_t n = 0;
  for (const PlannedStage& s : stages) n += s.certain || !certain_alone ? s.compression : 0;
  return n;
}

/// What may follow a model: others, as far as the tests that are allowed go.
Ahead behind(const std::vector<PlannedStage>& first, const std::vector<Evidence>& rivals,
             const CalibrationOptions& options) {
  Ahead later;
  std::int64_t left = options.max_tests - compression_of(first, true);
  for (const Evidence& rival : rivals) {
    const std::vector<PlannedStage> stages = ModelCourse(rival, options).stages();
    // Such a trial would not begin: its certain tests are not paid for.
    if (left < compression_of(stages, true)) break;
    const auto n = static_cast<double>(std::max<std::int64_t>(1, compression_of(stages, false)));
    // A rival may be cut short by the budget: then it costs the part that is paid.
    const double paid = std::min(1.0, static_cast<double>(left) / n);
    const Ahead one = ahead_of(stages);
    later.most_cost += paid * one.most_cost;
    later.most_tests += std::llround(paid * static_cast<double>(one.most_tests));
    left -= std::llround(paid * n);
  }
  return later;
}

/// The models that are compared, one of each kind.
std::vector<Evidence> kinds_of(const Evidence& evidence, const std::vector<Rock>& candidates) {
  std::map<const RockModel*, const Rock*> kinds;
  for (const Rock& rock : candidates) kinds.try_emplace(&maps::model_of(rock), &rock);
  std::vector<Evidence> one_of_each;
  for (const auto& [model, rock] : kinds) one_of_each.emplace_back(*rock, evidence.targets);
  return one_of_each;
}

}  // namespace

Ahead Outlook::ahead() const {
  const Ahead own = ahead_of(stages);
  return {own.least_cost + later.least_cost, own.most_cost + later.most_cost,
          own.least_tests + later.least_tests, own.most_tests + later.most_tests};
}

Outlook outlook_of(const Evidence& begins, int model, const std::vector<Evidence>& rivals,
                   const CalibrationOptions& options) {
  Outlook course{
      model, model + static_cast<int>(rivals.size()), ModelCourse(begins, options).stages(), {}, {}};
  course.first = ahead_of(course.stages);
  course.later = behind(course.stages, rivals, options);
  // of the model that is taken in the end, where another one may have followed
  if (course.models > 1 && !begins.strengths.empty() && !options.elastic_only)
    course.stages.push_back(CostOfTests(begins, begins.strengths)
                                .on(Grains::own, as_measured)
                                .stage(Kind::course_pictures, true, 1));
  return course;
}

Outlook outlook_of(const Evidence& evidence, const CalibrationOptions& asked) {
  const CalibrationOptions options = settled(asked, evidence);
  const std::vector<Rock> candidates = maps::candidates_of(evidence);
  std::vector<Evidence> kinds = kinds_of(evidence, candidates);
  if (candidates.size() == 1 || !method_of(options.method).compares_models)
    return outlook_of(Evidence(candidates.front(), evidence.targets), 1, {}, options);
  Outlook course{0, static_cast<int>(kinds.size()), {}, {}, {}};
  double cost = 0.0;
  for (const Rock& rock : candidates)
    cost += of_comparing * static_cast<double>(evidence.strengths.size() * evidence.strengths.size()) +
            static_cast<double>(has_bridges(rock.model) ? bridged_packings : 1) * of_first_fit *
                cost_of_solutions(evidence);
  course.stages.push_back({Kind::course_models, true, cost});
  // whichever is taken: the quickest and nothing behind it, or one after the other
  course.later.least_cost = HUGE_VAL, course.later.least_tests = INT64_MAX;
  for (const Evidence& kind : kinds) {
    const Ahead one = ahead_of(ModelCourse(kind, options).stages());
    course.later.least_cost = std::min(course.later.least_cost, one.least_cost);
    course.later.least_tests = std::min(course.later.least_tests, one.least_tests);
    course.first.most_cost = std::max(course.first.most_cost, cost + one.most_cost);
    course.first.most_tests = std::max(course.first.most_tests, one.most_tests);
  }
  course.first.least_cost = cost + course.later.least_cost;
  course.first.least_tests = course.later.least_tests;
  const Ahead all = behind({}, kinds, options);
  course.later.most_cost = all.most_cost, course.later.most_tests = all.most_tests;
  return course;
}

}  // namespace phy::calibrate
