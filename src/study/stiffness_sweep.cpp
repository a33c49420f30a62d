#include "study/stiffness_sweep.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/parallel.hpp"
#include "genesis/cache.hpp"
#include "genesis/specimen.hpp"
#include "statics/uniaxial.hpp"

namespace phy::study {
namespace {

double mean_of(const std::vector<Specimen>& specimens, double BeddingReport::*number) {
  double sum = 0.0;
  for (const Specimen& s : specimens) sum += s.bedding_report[0].*number;
  return sum / static_cast<double>(specimens.size());
}

/// Pairs (k_n, k_s), and which of them belong to the sweep of k_n and of k_s.
void lay_out(SweptPacking& swept, const BeddingRecipe& base, std::vector<double> factors) {
  std::sort(factors.begin(), factors.end());
  const auto number = [&](double k_n, double k_s) {
    for (std::size_t i = 0; i < swept.sets.size(); ++i)
      if (swept.sets[i].k_n == k_n && swept.sets[i].k_s == k_s) return i;
    swept.sets.push_back({k_n, k_s, {}});
    return swept.sets.size() - 1;
  };
  for (const double f : factors) swept.swept[0].push_back(number(f * base.k_n, base.k_s));
  for (const double f : factors) swept.swept[1].push_back(number(base.k_n, f * base.k_s));
}

double K_of(const theory::Eq1Fit& fit, SweptStiffness what, double spacing) {
  return (what == SweptStiffness::normal ? fit.rock.K_n_delta : fit.rock.K_s_delta) / spacing;
}

}  // namespace

std::vector<std::shared_ptr<const Packing>> sweep_packings(const Recipe& recipe, int threads) {
  std::vector<std::shared_ptr<const Packing>> packings(static_cast<std::size_t>(recipe.sweep.n_packings));
  for_all(packings.size(), threads, [&] {
    return [&](std::size_t i) {
      Recipe r = recipe;
      r.packing.seed += static_cast<std::int64_t>(i);
      packings[i] = genesis::packing_of(r, genesis::default_cache_folder());
    };
  });
  return packings;
}

SweptPacking sweep_stiffness(const std::shared_ptr<const Packing>& packing, std::int64_t seed,
                             const Recipe& recipe, BeddingRule rule, int threads) {
  SweptPacking swept;
  swept.packing = packing, swept.seed = seed, swept.rule = rule;
  swept.spacing = recipe.bedding[0].spacing, swept.angles = recipe.test.angles;
  Recipe base = recipe;
  base.test.intact = false;
  for (BeddingRecipe& set : base.bedding) set.rule = rule;
  const std::vector<Specimen> angles = genesis::make_specimens(packing, base);
  swept.bedding = {mean_of(angles, &BeddingReport::overlap_ratio),
                   mean_of(angles, &BeddingReport::bridge_fraction),
                   mean_of(angles, &BeddingReport::non_crossing_fraction)};
  lay_out(swept, recipe.bedding[0], recipe.sweep.factors);
  std::vector<Specimen> all;
  for (const SweptSet& set : swept.sets)
    for (const Specimen& s : angles) {
      all.push_back(s);
      all.back().bedding[0].k_n = set.k_n, all.back().bedding[0].k_s = set.k_s;
    }
  all.push_back(genesis::make_specimen(packing, recipe.matrix, {}, "intact"));
  for (const std::size_t contacts : {0U, 1U}) {
    statics::ElasticOptions options;
    options.bilateral = contacts == 1;
    options.sensitivities = false;
    std::vector<ElasticResult> results = statics::solve_all(all, options, threads);
    auto next = results.begin();
    for (SweptSet& set : swept.sets)
      for (std::size_t i = 0; i < angles.size(); ++i) set.results[contacts].push_back(std::move(*next++));
    swept.intact[contacts] = std::move(*next);
  }
  return swept;
}

theory::Eq1Fit fit_macro(const SweptPacking& swept, const SweptSet& set, const MacroReading& reading) {
  const auto E_of = [&](const ElasticResult& r) {
    return reading.strain == StrainReading::gauge ? r.E_gauge : r.E_platen;
  };
  const auto contacts = static_cast<std::size_t>(reading.contacts);
  std::vector<theory::ModulusReading> moduli;
  for (std::size_t i = 0; i < swept.angles.size(); ++i)
    moduli.push_back({swept.angles[i], E_of(set.results[contacts][i])});
  return theory::fit_eq1(moduli, {reading.loss, reading.reference, E_of(swept.intact[contacts])});
}

MacroLine fit_macro_line(std::span<const SweptPacking> packings, SweptStiffness what,
                         const MacroReading& reading) {
  const bool normal = what == SweptStiffness::normal;
  const SweptStiffness other = normal ? SweptStiffness::shear : SweptStiffness::normal;
  MacroLine line;
  std::vector<double> slope, intercept, R2, cross;
  for (const SweptPacking& p : packings) {
    std::vector<double> k, K, K_other;
    const std::vector<std::size_t>& sweep = p.swept[static_cast<std::size_t>(what)];
    for (const std::size_t i : sweep) {
      const theory::Eq1Fit fit = fit_macro(p, p.sets[i], reading);
      if (!fit.ok()) {
        line.refused = fit.reason;
        break;
      }
      k.push_back(normal ? p.sets[i].k_n : p.sets[i].k_s);
      K.push_back(K_of(fit, what, p.spacing)), K_other.push_back(K_of(fit, other, p.spacing));
    }
    if (k.size() < sweep.size()) continue;
    const LineFit fit = fit_line(k, K);
    slope.push_back(fit.slope), intercept.push_back(fit.intercept), R2.push_back(fit.R2);
    cross.push_back(K_other.back() / K_other.front() - 1.0);
  }
  line.slope = summarise(slope), line.intercept = summarise(intercept);
  line.R2 = summarise(R2), line.cross = summarise(cross);
  return line;
}

}  // namespace phy::study
