#include "calibrate/calibration.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "base/check.hpp"
#include "calibrate/by_model.hpp"
#include "calibrate/model_trial.hpp"
#include "calibrate/outlook.hpp"
#include "maps/placing.hpp"
#include "survey/cells.hpp"
#include "verdict/causes.hpp"
#include "verdict/cells.hpp"

namespace phy::calibrate {
namespace {

Evidence with_model(const Evidence& evidence, const Rock& rock) {
  Evidence with(rock, evidence.targets);
  // Evidence is made anew from the rock, and would forget that this calibration is to do without maps.
  with.maps = evidence.maps;
  return with;
}

struct Model {
  Evidence evidence;                            ///< the rock with this model
  std::optional<ParameterEstimate> share = {};  ///< of its planes that is jointed
  std::optional<Finding> advice = {};  ///< how a user asks for it; nothing: it would end out of reach
  bool misses_modulus = false;         ///< as expected: it would end out of reach
  std::string name() const { return maps::model_in_words(evidence.rock); }
};

/// The one that is taken, and others that may do as well, the nearest first.
struct Models {
  Model taken;
  std::vector<Model> rivals = {};
  /// What a user is advised of those from the k-th on, which were not tried.
  std::optional<Finding> advice(std::size_t k) const {
    return k < rivals.size() ? rivals[k].advice : std::nullopt;
  }
};

bool is_possible(const Evidence& evidence) {
  try {
    check_model(evidence);
  } catch (const InputError&) {
    return false;
  }
  return true;
}

/// Chosen here where nobody has said it.
Models models_of(const Evidence& evidence, Calibration& result, const CalibrationOptions& options,
                 Simulator& simulator) {
  const std::vector<Rock> candidates = maps::candidates_of(evidence);
  Models models{{with_model(evidence, candidates.front())}};
  if (candidates.size() > 1 && !method_of(options.method).compares_models) {
    result.notes.push_back(
        {FindingKind::model_without_rivals, {}, {}, {maps::model_in_words(candidates.front())}});
  } else if (candidates.size() > 1) {
    const maps::ModelChoice choice = choose_model(evidence, candidates, evidence.rock.model.packing.seed,
                                                  simulator, options.listener.begins);
    const Rock& rock = choice.rock();
    result.model_chosen = std::any_of(candidates.begin(), candidates.end(), [&](const Rock& r) {
      // Shares of jointed planes are candidates too, but of one model: among them alone nothing was chosen.
      return r.layers != rock.layers || r.matrix != rock.matrix;
    });
    for (Finding& f : choice.findings()) result.notes.push_back(std::move(f));
    models.taken = {with_model(evidence, rock), choice.share()};
    for (const maps::Rival* rival : choice.near_ones()) {
      Model other = {with_model(evidence, rival->rock), choice.share(*rival)};
      other.misses_modulus = rival->misses_modulus;
      if (!rival->misses_modulus) other.advice = choice.asked_for(*rival);
      // A rival that would be refused must not end a calibration hours after it began.
      if (is_possible(other.evidence)) models.rivals.push_back(std::move(other));
    }
    result.rival = models.advice(0);
  }
  if (const auto share = maps::assumed_share(evidence.rock, candidates)) result.notes.push_back(*share);
  return models;
}

/// What unseen packings miss of the values that were fitted.
struct Missed {
  std::size_t unanswered;
  double tolerances = 0.0;  ///< root mean square of the others

  Missed(const Calibration& c, std::size_t n_values) : unanswered(n_values) {
    double squares = 0.0;
    for (const Comparison& row : c.verification)
      if (row.answered()) {
        // In tolerances: 3 % of E weigh what 10 % of a tensile strength do.
        squares += std::pow(verdict::miss_of(row) / verdict::tolerance(row.target.property), 2.0);
        --unanswered;
      }
    if (unanswered < n_values) tolerances = std::sqrt(squares / static_cast<double>(n_values - unanswered));
  }
  bool operator<(const Missed& other) const {
    // The root mean square passes over values without an answer. Alone it would favour the model that answers
    // least.
    return std::pair(unanswered, tolerances) < std::pair(other.unanswered, other.tolerances);
  }
};

/// A calibration and by which model.
struct Tried {
  Attempt attempt;
  const Model* by;
  VerdictStatus status() const { return attempt.calibration.verdict.status; }
};

/// Calibrates by one model after the other and keeps the nearest.
class Trial {
 public:
  Trial(const Models& models, const Calibration& choice, const CalibrationOptions& options,
        Simulator& simulator, std::int64_t first_test)
      : models_(models), choice_(choice), options_(options), simulator_(simulator), first_test_(first_test) {
    const Evidence& e = models.taken.evidence;
    const bool strengths = e.fits_strength() && !options.elastic_only;
    n_values_ = e.moduli.size() + (strengths ? e.strengths.size() : 0);
  }

  /// By the model that was taken and, as long as what was found is out of reach, by its rivals.
  Attempt run() {
    say_outlook(models_.taken, 0);
    // Pictures at once only where no rival may follow: else they might be of a model that is given up.
    Tried found = by(models_.taken, models_.rivals.empty());
    for (std::size_t k = 0; k < models_.rivals.size() && tries(models_.rivals[k], found); ++k) {
      const Model& rival = models_.rivals[k];
      options_.listener.begins({FindingKind::course_model, {}, {}, {rival.name(), tried_.back()->name()}});
      say_outlook(rival, k + 1);
      // The numbers on the screen are those of the model that was given up.
      options_.listener.estimates({});
      found = nearer_of(std::move(found), by(rival, false));
      // Whoever is advised to try another model should not be sent to one that was tried here.
      found.attempt.calibration.rival = models_.advice(k + 1);
    }
    report_others(found);
    return std::move(found.attempt);
  }

 private:
  const Models& models_;
  const Calibration& choice_;
  const CalibrationOptions& options_;
  Simulator& simulator_;
  std::int64_t first_test_;  // in compression
  std::size_t n_values_;     // that are fitted
  std::int64_t n_one_ = 0;   // tests that the most expensive of the models took
  std::vector<const Model*> tried_;
  std::vector<Finding> results_;  // of each

  std::int64_t left() const { return options_.max_tests - (simulator_.count().compression() - first_test_); }

  bool may_be_tried(const Model& rival) const { return !rival.misses_modulus || options_.elastic_only; }

  /// Before the model begins behind which the rivals from the k-th on may be tried.
  void say_outlook(const Model& model, std::size_t k) const {
    std::vector<Evidence> rivals;
    for (std::size_t r = k; r < models_.rivals.size() && may_be_tried(models_.rivals[r]); ++r)
      rivals.push_back(models_.rivals[r].evidence);
    CalibrationOptions rest = options_;
    rest.max_tests = left();
    options_.listener.outlook(outlook_of(model.evidence, static_cast<int>(k) + 1, rivals, rest));
  }

  /// What is known of the share of its planes is noted with the rest.
  Tried by(const Model& model, bool pictures_at_once) {
    Calibration known = choice_;
    if (model.share) {
      known.parameters.push_back(*model.share);
      known.notes.push_back(maps::share_interval(*model.share));
    }
    CalibrationOptions rest = options_;
    rest.max_tests = left();
    Tried one = {calibrate_by(model.evidence, known, rest, simulator_, pictures_at_once), &model};
    // What a rival will cost shows only at its end: the costliest so far stands for it.
    n_one_ = std::max(n_one_, one.attempt.n_tests);
    tried_.push_back(&model), results_.push_back(result_of(one));
    return one;
  }

  Finding result_of(const Tried& one) const {
    if (one.status() == VerdictStatus::interrupted)
      return {FindingKind::model_interrupted, {}, {}, {one.by->name()}};
    const Missed missed(one.attempt.calibration, n_values_);
    return {FindingKind::model_tried,
            {},
            {{"unanswered", static_cast<double>(missed.unanswered)},
             {"tolerances", missed.tolerances},
             {"reached", misses_table(one.status()) ? 0.0 : 1.0}},
            {one.by->name()}};
  }

  /// Is what was found out of reach, may a rival not be, and do the tests that are left pay for it?
  bool tries(const Model& rival, const Tried& found) const {
    return found.status() == VerdictStatus::out_of_reach && may_be_tried(rival) &&
           left() >= std::max(n_one_, least_tests(rival.evidence, options_));
  }

  /// The second where it meets the table, or else the nearer one.
  Tried nearer_of(Tried first, Tried second) const {
    // Half a calibration cannot be compared. The whole one is kept, and says that it was stopped.
    if (second.status() == VerdictStatus::interrupted) {
      first.attempt.calibration.verdict = second.attempt.calibration.verdict;
      return first;
    }
    const bool taken = !misses_table(second.status()) || Missed(second.attempt.calibration, n_values_) <
                                                             Missed(first.attempt.calibration, n_values_);
    return taken ? std::move(second) : std::move(first);
  }

  /// What the other models of a calibration came to, and how near the maps are to a table that is missed.
  void report_others(Tried& found) const {
    Calibration& c = found.attempt.calibration;
    std::vector<Recipe> recipes = {found.by->evidence.rock.model};
    for (const Model* m : tried_)
      if (m != found.by) c.discarded.push_back(m->name()), recipes.push_back(m->evidence.rock.model);
    if (tried_.size() > 1) {
      c.notes.insert(c.notes.end(), results_.begin(), results_.end());
      c.notes.push_back({FindingKind::model_kept, {}, {}, {found.by->name()}});
    }
    // The sequence takes whichever model it is given, so that another one is no advice there.
    if (!misses_table(c.verdict.status) || !method_of(c.method).compares_models) return;
    if (const auto nearest = maps::against_maps(found.by->evidence, recipes, c.verification))
      c.verdict.findings.insert(c.verdict.findings.begin(), *nearest);
  }
};

SimulatorCount operator-(const SimulatorCount& a, const SimulatorCount& b) {
  return {a.tests - b.tests, a.tension - b.tension, a.coarse - b.coarse, a.solutions - b.solutions};
}

}  // namespace

Calibration calibrate(const Evidence& evidence, const CalibrationOptions& asked, Simulator& simulator) {
  const CalibrationOptions options = settled(asked, evidence);
  // Refusals come first: none after the first solution, which may take minutes.
  check_budget(evidence, options);
  const auto start = std::chrono::steady_clock::now();
  const SimulatorCount before = simulator.count();
  Calibration result;
  result.rock = evidence.rock.name, result.E_is = evidence.rock.E_is, result.method = options.method;
  result.counts_from_load = evidence.rock.counts_from_load;
  method_of(options.method).check(evidence);
  options.listener.outlook(outlook_of(evidence, options));
  try {
    const Models models = models_of(evidence, result, options, simulator);
    Attempt attempt = Trial(models, result, options, simulator, before.compression()).run();
    result = std::move(attempt.calibration);
    // A simulator may serve several calibrations, one after the other.
    result.counts = simulator.count() - before;
    if (result.verdict.status != VerdictStatus::interrupted)
      run_for_pictures(attempt.pictures, options.listener, simulator);  // which count for nothing
  } catch (const Stopped&) {  // while the models were compared, or at the pictures
    result.verdict = {VerdictStatus::interrupted, {{FindingKind::stopped}}};
  }
  // Causes need the whole result: which models were tried, what was spent, what the maps say.
  verdict::explain(result);
  if (result.verdict.status == VerdictStatus::out_of_reach && result.rival &&
      result.verdict.next.advice != Advice::try_rival)  // something better was advised
    result.notes.push_back(*result.rival);
  Verdict& v = result.verdict;
  // Rock without layers has no angles. The rooms that made these findings do not know the rock.
  for (auto* list : {&v.findings, &v.good_for, &v.not_good_for, &v.causes, &result.notes, &result.reach})
    *list = survey::cells_in(evidence.rock, std::move(*list));
  v.next = survey::cells_in(evidence.rock, {v.next}).front();
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace phy::calibrate
