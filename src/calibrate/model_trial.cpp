#include "calibrate/model_trial.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/parallel.hpp"
#include "calibrate/elastic_fit.hpp"
#include "calibrate/parameters.hpp"
#include "calibrate/strength_posterior.hpp"
#include "maps/forecast.hpp"
#include "verdict/judge.hpp"

namespace phy::calibrate {
namespace {

constexpr std::uint32_t choice_seed = 20261122;

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
    // No answer counts as off by all of it. Passed over, it would favour the model that has none.
    if (c.target.property == Property::E) squares.add(c.answered() ? c.error() : 1.0);
  return squares;
}

/// Every strength that was mapped predicted from the others by what is expected of this model, before any
/// test.
Squares strength_squares(const Evidence& evidence, const Recipe& recipe, int threads) {
  StrengthPosterior posterior(evidence, recipe);
  // Without a run: what the maps expect is all that is known of a model here.
  posterior.learn();
  std::vector<std::size_t> mapped;
  for (std::size_t i = 0; i < posterior.n_targets(); ++i) {
    if (is_expected(posterior.targets()[i])) mapped.push_back(i);
  }
  std::vector<double> errors(mapped.size());
  for_all(mapped.size(), threads, [&] {
    return [&](std::size_t k) {
      const std::size_t i = mapped[k];
      // A stream of its own per target: the threads may take them in any order.
      const std::vector<Point> draws = posterior.draws(i, choice_seed + static_cast<std::uint32_t>(i));
      double mean = 0.0;
      // The mean over the draws and no best point: with more parameters than the values hold, a point is one
      // of many.
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
  while (has_bridges(evidence.rock.model) && std::ssize(seeds) < bridged_packings)
    seeds.push_back(seeds.back() + 1);
  return fit_elastic(evidence, seeds, {}, simulator, [](const Finding&) {});
}

maps::Rival rival_of(const Evidence& evidence, const ElasticFit& fit, int threads) {
  const Squares E = modulus_squares(fit);
  const Squares strengths = strength_squares(evidence, with_moduli(evidence.rock.model, fit.recipe), threads);
  return {evidence.rock, E.root(), strengths.root(), std::sqrt((E.sum + strengths.sum) / (E.n + strengths.n)),
          verdict::moduli_out_of_reach(fit.comparisons)};
}

}  // namespace

maps::ModelChoice choose_model(const Evidence& evidence, const std::vector<Rock>& candidates,
                               std::int64_t seed, Simulator& simulator,
                               const std::function<void(const Finding&)>& begins) {
  begins({FindingKind::course_models});
  maps::ModelChoice choice;
  const auto meets = [&](const Rock& rock) {
    const auto forecast = maps::forecast_of(Evidence(rock, evidence.targets));
    return forecast && forecast->meets();
  };
  // between planes directions are of the strengths alone: the moduli are those of planes
  std::map<std::tuple<MatrixModel, LayerModel, double>, ElasticFit> moduli;
  for (const Rock& rock : candidates) {
    const Evidence one(rock, evidence.targets);
    const LayerModel as = rock.layers == LayerModel::planes_and_directions ? LayerModel::planes : rock.layers;
    // A fit takes longer than all predictions of a candidate, and many candidates share it.
    const auto [fit, fresh] = moduli.try_emplace({rock.model.matrix.model, as, jointed_share(rock.model)});
    if (fresh) fit->second = moduli_of(one, seed, simulator);
    choice.add(rival_of(one, fit->second, simulator.threads()), meets);
  }
  return choice;
}

}  // namespace phy::calibrate
