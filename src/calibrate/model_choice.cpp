#include "calibrate/model_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "base/parallel.hpp"
#include "calibrate/elastic_fit.hpp"
#include "calibrate/forecast.hpp"
#include "calibrate/strength_posterior.hpp"
#include "calibrate/strength_stage.hpp"
#include "verdict/judge.hpp"
#include "verdict/margin.hpp"

namespace phy::calibrate {
namespace {

using verdict::modulus_limit;

constexpr std::uint32_t choice_seed = 20261122;
// Of the error of the others, from where on flat joints are taken. Most tables do not tell the two apart: of
// eight rocks of parallel bonds by planes three, by a little, are predicted better by flat joints, and of
// eight of flat joints five by parallel bonds, which know more models of the layers and cost half as much.
constexpr double flat_joint_gain = 0.75;
// Of the error of planes alone, from where on directions between planes, or bridges, are taken, which contain
// them: what has more to fit with is often a little better by chance.
constexpr double nested_gain = 0.9;
// Bridges stiffen planes as much as they strengthen them: joints are fitted anew for each of these shares,
// which no search of strengths could move.
constexpr double persistences[] = {0.8, 0.65, 0.5, 0.35, 0.2};
// Of the error of the best share, up to where another may be that of the rock (docs/calibration.md, "Which
// model of the layers").
constexpr double share_tolerance = 1.2;
// Likewise, up to where a model of another kind is worth a calibration of its own.
constexpr double rival_tolerance = 1.25;
constexpr std::int64_t n_bridged = 3;  // packings for the moduli of these, whose specimens differ more

/// Sum of squared relative errors, and how many.
struct Squares {
  double sum = 0.0;
  int n = 0;
  void add(double error) { sum += error * error, ++n; }
  double root() const { return n > 0 ? std::sqrt(sum / n) : 0.0; }
};

Squares modulus_squares(const ElasticFit& fit) {
  Squares squares;
  for (const Comparison& c : fit.comparisons)
    if (c.target.property == Property::E) squares.add(c.answered() ? c.error() : 1.0);
  return squares;
}

/// Every strength that was mapped predicted from the others by what is expected of this model, before any
/// test.
Squares strength_squares(const Evidence& evidence, const Recipe& recipe, int threads) {
  StrengthPosterior posterior(evidence, recipe);
  posterior.learn();
  std::vector<std::size_t> mapped;
  for (std::size_t i = 0; i < posterior.n_targets(); ++i) {
    const Target& t = posterior.targets()[i];
    if (t.confining == 0.0 && measured(t.property).grain_exponent == 0.0) mapped.push_back(i);
  }
  std::vector<double> errors(mapped.size());
  for_all(mapped.size(), threads, [&] {
    return [&](std::size_t k) {
      const std::size_t i = mapped[k];
      const std::vector<Point> draws = posterior.draws(i, choice_seed + static_cast<std::uint32_t>(i));
      double mean = 0.0;
      for (const Point& x : draws) mean += posterior.predict(x, i).mean / static_cast<double>(draws.size());
      errors[k] = std::log(posterior.targets()[i].mean) - mean;
    };
  });
  Squares squares;
  for (const double error : errors) squares.add(error);
  return squares;
}

ElasticFit moduli_of(const Evidence& evidence, std::int64_t seed, Simulator& simulator) {
  std::vector<std::int64_t> seeds = {seed};
  while (has_bridges(evidence.rock.model) && std::ssize(seeds) < n_bridged) seeds.push_back(seeds.back() + 1);
  return fit_elastic(evidence, seeds, {}, simulator, [](const std::string&) {});
}

Rival rival_of(const Evidence& evidence, const ElasticFit& fit, int threads) {
  const Squares E = modulus_squares(fit);
  const Squares strengths = strength_squares(evidence, with_moduli(evidence.rock.model, fit.recipe), threads);
  return {evidence.rock, E.root(), strengths.root(), std::sqrt((E.sum + strengths.sum) / (E.n + strengths.n)),
          verdict::moduli_out_of_reach(fit.comparisons)};
}

/// What the other matrix does not have falls back to where it says nothing.
void take_matrix(MatrixRecipe& m, MatrixModel model) {
  if (m.model == model) return;
  const MatrixRecipe usual;
  const double modulus = m.modulus();
  m.model = model;
  m.stiffness_convention = usual.stiffness_convention;
  m.E_b = usual.E_b, m.bond_ks_over_kn = usual.bond_ks_over_kn;
  m.moment_contribution = usual.moment_contribution;
  m.elements = usual.elements, m.break_at = usual.break_at;
  m.gapped_fraction = usual.gapped_fraction, m.initial_gap = usual.initial_gap;
  if (model == MatrixModel::flat_joint) {
    m.E_c = modulus / m.radius_multiplier;
  } else {
    m.E_c = m.E_b = modulus / (1.0 + m.radius_multiplier);
    m.bond_ks_over_kn = m.ks_over_kn;
  }
}

/// Four strengths of tests that were mapped, UCS among them.
bool shows_layers(const Evidence& evidence) {
  constexpr std::ptrdiff_t least_strengths = 4;
  return evidence.has(Property::ucs) &&
         std::count_if(evidence.strengths.begin(), evidence.strengths.end(), [](const Target& t) {
           return t.confining == 0.0 && measured(t.property).grain_exponent == 0.0;
         }) >= least_strengths;
}

/// Is a table foretold to be met (forecast.hpp)?
bool foretold(const Rock& rock, const std::vector<Target>& targets) {
  const std::optional<Forecast> forecast = foretell(Evidence(rock, targets));
  return forecast && forecast->meets();
}

bool contains(const Rival& one, const Rival& other) {
  return other.rock.layers == LayerModel::planes && (one.rock.layers == LayerModel::planes_and_directions ||
                                                     one.rock.layers == LayerModel::planes_with_bridges);
}

/// Does a model that contains planes alone, and has E as they have or as they miss it, miss hardly less?
bool is_barred(const Rival& one, const std::vector<Rival>& rivals) {
  const auto planes =
      std::find_if(rivals.begin(), rivals.end(), [&](const Rival& r) { return contains(one, r); });
  return planes != rivals.end() && planes->has_E() == one.has_E() && one.error >= nested_gain * planes->error;
}

/// Flat joints, which stand last, have to meet what no other does, or to be clearly better where nothing
/// does.
bool replaces(const Rival& one, const ModelChoice& so_far, const std::vector<Target>& targets) {
  const Rival& best = so_far.rivals[so_far.best];
  if (one.has_E() != best.has_E()) return one.has_E();
  if (one.rock.model.matrix.model == MatrixModel::parallel_bond)
    return !is_barred(one, so_far.rivals) && one.error < best.error;
  if (std::any_of(so_far.rivals.begin(), so_far.rivals.end(),
                  [&](const Rival& r) { return foretold(r.rock, targets); }))
    return false;
  return foretold(one.rock, targets) || one.error < flat_joint_gain * best.error;
}

/// 1 of whole planes, and where there are none.
double share_of(const Rock& rock) {
  return rock.model.bedding.empty() ? 1.0 : rock.model.bedding.front().persistence;
}
Rock with_share(Rock bridged, double jointed) {
  bridged.model.bedding.front().persistence = jointed;
  return bridged;
}

bool shows_matrix(const Evidence& evidence) {
  const bool bedded = evidence.rock.bedded;
  return !(bedded && of_parallel_bonds(evidence.rock.layers)) && evidence.has(Property::ucs) &&
         (!bedded || shows_layers(evidence)) &&
         std::any_of(evidence.targets.begin(), evidence.targets.end(),
                     [](const Target& t) { return is_tensile(t.property); });
}

}  // namespace

Rock with_model(Rock rock, LayerModel layers, std::optional<MatrixModel> matrix) {
  rock.layers = layers, rock.matrix = matrix;
  MatrixRecipe& m = rock.model.matrix;
  if (matrix) take_matrix(m, *matrix);
  if (layers == LayerModel::planes_with_bridges && !has_bridges(rock.model))
    rock.model.bedding.front().persistence = usual_persistence;
  if (!is_directed(layers) || rock.model.bedding.empty() || m.directional()) return rock;
  if (layers == LayerModel::directions)
    rock.model.bedding.clear();
  else
    m.foliation = rock.model.bedding.front().theta;
  if (m.moment_contribution == MatrixRecipe().moment_contribution) m.moment_contribution = 0.1;
  for (const StrengthParameter* p : {&cohesion_ratio, &cohesion_oblique}) p->set(rock.model, p->range.usual);
  return rock;
}

std::vector<Rock> candidates_of(const Evidence& evidence) {
  const Rock& rock = evidence.rock;
  std::vector<LayerModel> layers = {rock.layers};
  if (!rock.bedded || rock.layers == LayerModel::choose) layers = {LayerModel::planes};
  if (rock.bedded && rock.layers == LayerModel::choose && shows_layers(evidence))
    layers = {LayerModel::planes, LayerModel::directions, LayerModel::planes_and_directions,
              LayerModel::planes_with_bridges};
  const bool parallel = rock.bedded && of_parallel_bonds(rock.layers);
  std::vector<MatrixModel> matrices = {
      rock.matrix.value_or(parallel ? MatrixModel::parallel_bond : rock.model.matrix.model)};
  if (!rock.matrix && shows_matrix(evidence))
    matrices = {MatrixModel::parallel_bond, MatrixModel::flat_joint};
  const bool shares = !has_bridges(rock.model) && shows_layers(evidence);
  std::vector<Rock> all;
  for (const MatrixModel matrix : matrices)
    for (const LayerModel l : layers) {
      if (matrix == MatrixModel::flat_joint && of_parallel_bonds(l)) continue;
      const Rock one = with_model(rock, l, matrix);
      if (l != LayerModel::planes_with_bridges || !shares)
        all.push_back(one);
      else
        for (const double share : persistences) all.push_back(with_share(one, share));
    }
  return all;
}

std::optional<Finding> assumed_share(const Rock& read, const std::vector<Rock>& candidates) {
  if (candidates.size() > 1 || has_bridges(read.model) || !has_bridges(candidates.front().model)) return {};
  return Finding{FindingKind::share_assumed, {}, {{"share", usual_persistence}}};
}

std::string model_in_words(const Rock& rock) {
  const bool flat = rock.model.matrix.model == MatrixModel::flat_joint;
  if (!rock.bedded) return flat ? "flat joints" : "parallel bonds";
  return rock.layers == LayerModel::directions ? "directions of the bonds"
         : rock.layers == LayerModel::planes_and_directions
             ? "joints on planes, directions of the bonds' strength"
         : rock.layers == LayerModel::planes_with_bridges
             ? fmt::format("joints on {:g} of the planes", share_of(rock))
         : flat ? "joints on planes between flat joints"
                : "joints on planes";
}

std::string models_in_words(const std::vector<Rock>& models) {
  std::vector<std::string> words, shares;
  for (const Rock& r : models)
    if (!has_bridges(r.model))
      words.push_back(model_in_words(r));
    else
      shares.push_back(fmt::format("{:g}", share_of(r)));
  if (!shares.empty()) words.push_back(fmt::format("joints on {} of the planes", fmt::join(shares, ", ")));
  return fmt::format("{}", fmt::join(words, "; "));
}

bool Rival::has_E() const { return modulus_error <= modulus_limit; }

std::vector<Finding> ModelChoice::findings() const {
  std::vector<Finding> all = {{FindingKind::model_taken, {}, {}, {model_in_words(rock())}}};
  for (const Rival& r : rivals)
    all.push_back({FindingKind::model_expected,
                   {},
                   {{"E", r.modulus_error}, {"strengths", r.strength_error}},
                   {model_in_words(r.rock)}});
  if (rivals[best].has_E() && !std::all_of(rivals.begin(), rivals.end(), std::mem_fn(&Rival::has_E)))
    all.push_back({FindingKind::models_miss_modulus, {}, {{"limit", modulus_limit}}});
  const auto stays_behind = [&](const Rival& r) {
    return r.has_E() && r.error < rivals[best].error && is_barred(r, rivals);
  };
  if (std::any_of(rivals.begin(), rivals.end(), stays_behind))
    all.push_back({FindingKind::nested_models_stay, {}, {{"gain", nested_gain}}});
  if (rivals.back().rock.model.matrix.model == MatrixModel::flat_joint)
    all.push_back({FindingKind::flat_joints_rule, {}, {{"gain", flat_joint_gain}}});
  return all;
}

std::vector<const Rival*> ModelChoice::near_ones() const {
  const Rival& taken = rivals[best];
  const auto kind = [](const Rival& r) { return std::pair(r.rock.layers, r.rock.matrix); };
  std::map<std::pair<LayerModel, std::optional<MatrixModel>>, const Rival*> best_of_kind;
  for (const Rival& r : rivals) {
    if (kind(r) == kind(taken) || (!r.has_E() && taken.has_E()) || r.error > rival_tolerance * taken.error)
      continue;
    const auto [it, fresh] = best_of_kind.try_emplace(kind(r), &r);
    if (!fresh && r.error < it->second->error) it->second = &r;
  }
  std::vector<const Rival*> near;
  for (const auto& [of, rival] : best_of_kind) near.push_back(rival);
  std::sort(near.begin(), near.end(), [](const Rival* a, const Rival* b) { return a->error < b->error; });
  return near;
}

Finding ModelChoice::asked_for(const Rival& rival) const {
  const Rival& taken = rivals[best];
  const bool several_matrices = std::any_of(
      rivals.begin(), rivals.end(), [&](const Rival& r) { return r.rock.matrix != taken.rock.matrix; });
  const char* const matrix = rival.rock.matrix == MatrixModel::flat_joint ? "flat_joint" : "parallel_bond";
  return {FindingKind::rival_model,
          {},
          {{"error", rival.error}, {"taken_error", taken.error}},
          {model_in_words(rival.rock), model_in_words(taken.rock),
           rival.rock.bedded ? to_string(rival.rock.layers) : "", several_matrices ? matrix : ""},
          Advice::try_rival};
}

std::optional<ParameterEstimate> ModelChoice::share(const Rival& taken) const {
  if (!has_bridges(taken.rock.model)) return std::nullopt;
  std::map<double, bool> possible;  // by share, that of whole planes among them
  for (const Rival& r : rivals)
    if (r.rock.matrix == taken.rock.matrix &&
        (r.rock.layers == LayerModel::planes || r.rock.layers == LayerModel::planes_with_bridges))
      possible[share_of(r.rock)] = (r.has_E() || !taken.has_E()) && r.error <= share_tolerance * taken.error;
  if (possible.size() < 2) return std::nullopt;
  ParameterEstimate e;
  e.key = "bedding[0].persistence", e.symbol = "persistence", e.unit = "1", e.value = share_of(taken.rock);
  e.number = [](const Recipe& r) -> const double& { return r.bedding.front().persistence; };
  e.box_low = possible.begin()->first, e.box_high = 1.0;
  const auto is_possible = [](const auto& of) { return of.second; };
  const auto first = std::find_if(possible.begin(), possible.end(), is_possible);
  const auto last = std::find_if(possible.rbegin(), possible.rend(), is_possible);
  e.low = first == possible.begin() ? e.box_low : std::prev(first)->first;
  e.high = last == possible.rbegin() ? e.box_high : std::prev(last)->first;
  e.determined = std::log(e.high / e.low) < 0.5 * std::log(e.box_high / e.box_low);
  e.rests_on.basis = Basis::values_left_out;
  if (!e.determined) e.next.remedy = Remedy::map_persistence;
  return e;
}

Finding share_interval(const ParameterEstimate& share) {
  return {FindingKind::share_interval,
          {},
          {{"share", share.value}, {"low", share.low}, {"high", share.high}, {"factor", share_tolerance}}};
}

ModelChoice choose_model(const Evidence& evidence, const std::vector<Rock>& candidates, std::int64_t seed,
                         Simulator& simulator, const std::function<void(const std::string&)>& say) {
  say("which model predicts what it has not seen");
  ModelChoice choice;
  // between planes directions are of the strengths alone: the moduli are those of planes
  std::map<std::tuple<MatrixModel, LayerModel, double>, ElasticFit> moduli;
  for (const Rock& rock : candidates) {
    const Evidence one(rock, evidence.targets);
    const LayerModel as = rock.layers == LayerModel::planes_and_directions ? LayerModel::planes : rock.layers;
    const auto [fit, fresh] = moduli.try_emplace({rock.model.matrix.model, as, share_of(rock)});
    if (fresh) fit->second = moduli_of(one, seed, simulator);
    Rival rival = rival_of(one, fit->second, simulator.threads());
    if (choice.rivals.empty() || replaces(rival, choice, evidence.targets))
      choice.best = choice.rivals.size();
    choice.rivals.push_back(std::move(rival));
  }
  return choice;
}

}  // namespace phy::calibrate
