#include "calibrate/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "base/check.hpp"
#include "calibrate/cause.hpp"
#include "calibrate/margin.hpp"
#include "calibrate/model_choice.hpp"
#include "calibrate/one_model.hpp"
#include "calibrate/reach_check.hpp"
#include "calibrate/sequence.hpp"

namespace phy::calibrate {
namespace {

Evidence with_model(const Evidence& evidence, const Rock& rock) {
  Evidence with(rock, evidence.targets);
  with.maps = evidence.maps;
  return with;
}

struct Model {
  Evidence evidence;                            ///< the rock with this model
  std::optional<ParameterEstimate> share = {};  ///< of its planes that is jointed
  std::string advice = {};                      ///< how a user asks for it; empty: it would end out of reach
  bool lacks_E = false;                         ///< as expected: it would end out of reach
  std::string words() const { return model_in_words(evidence.rock); }
};

/// The one that is taken, and others that may do as well, the nearest first.
struct Models {
  Model taken;
  std::vector<Model> rivals = {};
  /// What a user is told of those from the k-th on, which were not tried.
  std::string advice(std::size_t k) const { return k < rivals.size() ? rivals[k].advice : ""; }
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
  const std::vector<Rock> candidates = candidates_of(evidence);
  Models models{{with_model(evidence, candidates.front())}};
  if (candidates.size() > 1 && options.method == CalibrationMethod::sequence) {
    result.notes.push_back(
        fmt::format("the model is {}: a sequence compares no rivals", model_in_words(candidates.front())));
  } else if (candidates.size() > 1) {
    const ModelChoice choice =
        choose_model(evidence, candidates, evidence.rock.model.packing.seed, simulator, options.listener.say);
    const Rock& rock = choice.rock();
    result.model_chosen = std::any_of(candidates.begin(), candidates.end(), [&](const Rock& r) {
      return r.layers != rock.layers || r.matrix != rock.matrix;
    });
    result.notes.push_back(choice.text()), result.n_elastic += choice.n_solutions;
    models.taken = {with_model(evidence, rock), choice.share()};
    for (const Rival* rival : choice.near_ones())
      if (Model other = {with_model(evidence, rival->rock), choice.share(*rival),
                         rival->lacks_E ? "" : choice.asked_for(*rival), rival->lacks_E};
          is_possible(other.evidence))
        models.rivals.push_back(std::move(other));
    result.rival = models.advice(0);
  }
  if (const std::string text = assumed_share(evidence.rock, candidates); !text.empty())
    result.notes.push_back(text);
  return models;
}

/// What unseen packings miss of the values that were fitted.
struct Missed {
  std::size_t unanswered;
  double tolerances = 0.0;  ///< root mean square of the others

  Missed(const Calibration& c, std::size_t n_values) : unanswered(n_values) {
    double squares = 0.0;
    for (const Comparison& row : c.verification)
      if (row.answered())
        squares += std::pow(miss_of(row) / tolerance(row.target.property), 2.0), --unanswered;
    if (unanswered < n_values) tolerances = std::sqrt(squares / static_cast<double>(n_values - unanswered));
  }
  bool operator<(const Missed& other) const {
    return std::pair(unanswered, tolerances) < std::pair(other.unanswered, other.tolerances);
  }
  std::string text() const {
    return unanswered > 0
               ? fmt::format("{} values without an answer", unanswered)
               : fmt::format("{:.2g} tolerances off on unseen packings, root mean square", tolerances);
  }
};

std::int64_t n_compressive_tests(const Calibration& c) { return c.n_strength_tests - c.n_tension_tests; }

/// Is what was found out of reach, may a rival not be, and do the tests that are left pay for it? `n_one`:
/// what the dearest of the models before took.
bool tries(const Model& rival, const Calibration& c, std::int64_t n_one, const CalibrationOptions& options) {
  return c.verdict.status == VerdictStatus::out_of_reach && (!rival.lacks_E || options.elastic_only) &&
         options.max_tests - n_compressive_tests(c) >= std::max(n_one, least_tests(rival.evidence, options));
}

/// A calibration and by which model.
struct Tried {
  Attempt attempt;
  const Model* by;
};

/// The one that is not out of reach, or else the nearer one, with the numbers of tests of both.
/// `n_solutions`: of the choice, which both count. `n_values`: that were fitted. `told` gains what they came
/// to.
Tried nearer_of(Tried first, Tried second, std::int64_t n_solutions, std::size_t n_values,
                std::vector<std::string>& told) {
  const Missed by_first(first.attempt.calibration, n_values), by_second(second.attempt.calibration, n_values);
  const VerdictStatus status = second.attempt.calibration.verdict.status;
  const bool stopped = status == VerdictStatus::interrupted,
             reached = !stopped && status != VerdictStatus::out_of_reach,
             taken = reached || (!stopped && by_second < by_first);
  const std::string a = first.by->words(), b = second.by->words();
  told.push_back(
      stopped ? fmt::format("{} ended out of reach ({}); {} were being calibrated", a, by_first.text(), b)
              : fmt::format("{} ended out of reach ({}), so {} were calibrated too ({}): the {} taken", a,
                            by_first.text(), b, by_second.text(),
                            reached ? "latter, which did not, are"
                            : taken ? "latter are"
                                    : "former stay"));
  Tried& kept = taken ? second : first;
  const Calibration& other = (taken ? first : second).attempt.calibration;
  Calibration& c = kept.attempt.calibration;
  c.n_strength_tests += other.n_strength_tests, c.n_tension_tests += other.n_tension_tests;
  c.n_coarse_tests += other.n_coarse_tests, c.n_elastic += other.n_elastic - n_solutions;
  if (stopped) c.verdict = other.verdict;
  return std::move(kept);
}

/// What the other models of a calibration came to, and, out of reach, what the maps say of the one that was
/// taken. `tried`: all, that one among them.
void report_others(Calibration& c, const Model& taken, const std::vector<const Model*>& tried,
                   const std::vector<std::string>& told) {
  c.notes.insert(c.notes.end(), told.begin(), told.end());
  std::vector<Recipe> recipes = {taken.evidence.rock.model};
  for (const Model* m : tried)
    if (m != &taken) c.discarded.push_back(m->words()), recipes.push_back(m->evidence.rock.model);
  if (c.verdict.status != VerdictStatus::out_of_reach || c.method == CalibrationMethod::sequence) return;
  if (const std::string text = against_maps(taken.evidence, recipes, c.verification); !text.empty())
    c.verdict.findings.insert(c.verdict.findings.begin(), text);
}

/// By one model; what is known of the share of its planes is told with the rest.
Attempt calibrate_by(const Model& model, const Calibration& choice, const CalibrationOptions& options,
                     Simulator& simulator, bool pictures_at_once) {
  Calibration told = choice;
  if (model.share)
    told.parameters.push_back(*model.share), told.notes.push_back(share_in_words(*model.share));
  return calibrate_by(model.evidence, told, options, simulator, pictures_at_once);
}

/// By the model that was taken and, as long as what was found is out of reach, by its rivals.
Attempt calibrate_by_models(const Models& models, const Calibration& choice,
                            const CalibrationOptions& options, Simulator& simulator) {
  const Model& taken = models.taken;
  const bool alone = models.rivals.empty(),
             strengths = taken.evidence.fits_strength() && !options.elastic_only;
  const std::size_t n_values =
      taken.evidence.moduli.size() + (strengths ? taken.evidence.strengths.size() : 0);
  Tried found = {calibrate_by(taken, choice, options, simulator, alone), &taken};
  std::vector<const Model*> tried = {&taken};
  std::vector<std::string> told;
  std::int64_t n_one = n_compressive_tests(found.attempt.calibration);
  for (std::size_t k = 0; k < models.rivals.size(); ++k) {
    const Model& rival = models.rivals[k];
    if (!tries(rival, found.attempt.calibration, n_one, options)) break;
    options.listener.say(fmt::format("{}: out of reach; now {}", found.by->words(), rival.words()));
    options.listener.estimates({});
    CalibrationOptions rest = options;
    rest.max_tests -= n_compressive_tests(found.attempt.calibration);
    Tried other = {calibrate_by(rival, choice, rest, simulator, false), &rival};
    n_one = std::max(n_one, n_compressive_tests(other.attempt.calibration));
    found = nearer_of(std::move(found), std::move(other), choice.n_elastic, n_values, told);
    found.attempt.calibration.rival = models.advice(k + 1);
    tried.push_back(&rival);
  }
  report_others(found.attempt.calibration, *found.by, tried, told);
  return std::move(found.attempt);
}

}  // namespace

void check_possible(const Evidence& evidence, const CalibrationOptions& options) {
  check_budget(evidence, options);
}

Calibration calibrate(const Evidence& evidence, const CalibrationOptions& options, Simulator& simulator) {
  check_possible(evidence, options);
  const auto start = std::chrono::steady_clock::now();
  Calibration result;
  result.rock = evidence.rock.name, result.E_is = evidence.rock.E_is, result.method = options.method;
  if (options.method == CalibrationMethod::sequence) check_sequence(evidence);
  try {
    const Models models = models_of(evidence, result, options, simulator);
    Attempt attempt = calibrate_by_models(models, result, options, simulator);
    press_pictures(attempt.pictures, attempt.calibration, simulator);
    result = std::move(attempt.calibration);
  } catch (const Stopped&) {  // while the models were compared
    result.verdict = stopped_by_user();
  }
  result.verdict.sentence = verdict_sentence(result);
  if (result.verdict.status == VerdictStatus::out_of_reach &&
      result.verdict.sentence.find(result.rival) == std::string::npos)  // something better was advised
    result.notes.push_back(result.rival);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace phy::calibrate
