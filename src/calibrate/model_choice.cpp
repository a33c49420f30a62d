#include "calibrate/model_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "calibrate/elastic_fit.hpp"
#include "calibrate/strength_posterior.hpp"
#include "calibrate/strength_stage.hpp"

namespace phy::calibrate {
namespace {

constexpr std::uint32_t sampler_seed = 20261122;

const char* in_words(LayerModel layers) {
  return layers == LayerModel::directions              ? "directions of the bonds"
         : layers == LayerModel::planes_and_directions ? "joints on planes, directions of the bonds' strength"
                                                       : "joints on planes";
}

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
Squares strength_squares(const Evidence& evidence, const Recipe& recipe) {
  StrengthPosterior posterior(evidence, recipe);
  posterior.learn();
  Squares squares;
  for (std::size_t i = 0; i < posterior.n_targets(); ++i) {
    if (posterior.targets()[i].confining > 0.0) continue;
    const std::vector<Point> draws = posterior.draws(i, sampler_seed + static_cast<std::uint32_t>(i));
    double mean = 0.0;
    for (const Point& x : draws) mean += posterior.predict(x, i).mean / static_cast<double>(draws.size());
    squares.add(std::log(posterior.targets()[i].mean) - mean);
  }
  return squares;
}

Evidence with(const Evidence& evidence, LayerModel layers) {
  return Evidence(with_layers(evidence.rock, layers), evidence.targets);
}

ElasticFit moduli_of(const Evidence& evidence, std::int64_t seed, Simulator& simulator) {
  return fit_elastic(evidence, {seed}, {}, simulator, [](const std::string&) {});
}

Rival rival_of(const Evidence& evidence, const ElasticFit& fit) {
  const Squares E = modulus_squares(fit);
  const Squares strengths = strength_squares(evidence, with_moduli(evidence.rock.model, fit.recipe));
  return {evidence.rock.layers, E.root(), strengths.root(),
          std::sqrt((E.sum + strengths.sum) / (E.n + strengths.n))};
}

}  // namespace

Rock with_layers(Rock rock, LayerModel layers) {
  rock.layers = layers;
  MatrixRecipe& m = rock.model.matrix;
  const bool directed = layers == LayerModel::directions || layers == LayerModel::planes_and_directions;
  if (!directed || rock.model.bedding.empty() || m.directional()) return rock;
  if (layers == LayerModel::directions)
    rock.model.bedding.clear();
  else
    m.foliation = rock.model.bedding.front().theta;
  if (m.moment_contribution == MatrixRecipe().moment_contribution) m.moment_contribution = 0.1;
  for (const StrengthParameter* p : {&cohesion_ratio, &cohesion_oblique}) p->set(rock.model, p->range.usual);
  return rock;
}

std::string ModelChoice::text() const {
  if (rivals.empty()) return "";
  std::string text = fmt::format("layers are modelled by {}", in_words(layers));
  for (const Rival& r : rivals)
    text += fmt::format("; {}: E fitted to {:.1f} %, strengths left out predicted to {:.0f} %",
                        in_words(r.layers), 100.0 * r.modulus_error, 100.0 * r.strength_error);
  return text + " (before any test, from the maps of what models reach)";
}

bool can_choose(const Evidence& evidence) {
  constexpr std::ptrdiff_t least_strengths = 4;
  return evidence.has(Property::ucs) &&
         std::count_if(evidence.strengths.begin(), evidence.strengths.end(),
                       [](const Target& t) { return t.confining == 0.0; }) >= least_strengths;
}

ModelChoice choose_layers(const Evidence& evidence, std::int64_t seed, Simulator& simulator,
                          const std::function<void(const std::string&)>& say) {
  ModelChoice choice;
  if (!can_choose(evidence)) return choice;
  say("which model of the layers predicts what it has not seen");
  const Evidence planes = with(evidence, LayerModel::planes),
                 directions = with(evidence, LayerModel::directions);
  const ElasticFit jointed = moduli_of(planes, seed, simulator),
                   turned = moduli_of(directions, seed, simulator);
  choice.n_solutions = jointed.n_solutions + turned.n_solutions;
  // between planes directions are of the strengths alone: the moduli are those of planes
  choice.rivals = {rival_of(planes, jointed), rival_of(directions, turned),
                   rival_of(with(evidence, LayerModel::planes_and_directions), jointed)};
  choice.layers =
      std::min_element(choice.rivals.begin(), choice.rivals.end(), [](const Rival& a, const Rival& b) {
        return a.error < b.error;
      })->layers;
  return choice;
}

}  // namespace phy::calibrate
