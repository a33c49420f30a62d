// How often the elastic stage's 95 % intervals hold parameters that are known: a rock's own moduli, mean over
// four hundred packings, are its table, with specimens of 1 %, so that packings make most of the error;
// twenty fits see up to twenty packings each, none of them twice. docs/theory/inference.md, "Moduli".
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "../calibration/twin_trial.hpp"
#include "calibrate/elastic_fit.hpp"
#include "calibrate/elastic_response.hpp"
#include "setting.hpp"

namespace phy::calibrate {
namespace {

struct Case {
  const char* name;
  BeddingRule rule;
};

class ElasticIntervals : public testing::TestWithParam<Case> {};

TEST_P(ElasticIntervals, HoldTheParametersOfTheRock) {
  const auto simulator =
      make_simulator({static_cast<int>(setting("PHY_TWIN_THREADS", 2)), "", nullptr, nullptr});
  Rock rock;
  rock.model = magnified_model(5.0);
  rock.model.bedding[0].rule = GetParam().rule;
  Recipe truth = rock.model;
  truth.matrix.E_c = truth.matrix.E_b = 21e9;
  truth.matrix.ks_over_kn = truth.matrix.bond_ks_over_kn = 0.42;
  truth.bedding[0].k_n *= 0.7, truth.bedding[0].k_s *= 1.4;
  std::vector<Target> targets;
  for (const Property p : {Property::E, Property::nu})
    for (const double theta : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0})
      targets.push_back({p, theta, 1.0, 1.0});
  const std::vector<Comparison> own = elastic_response(truth, targets, packings_from(1000, 400), *simulator);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    Target& t = targets[i];
    t.mean = own[i].mean, t.n = 10;
    t.sd = 0.01 * (t.property == Property::E ? t.mean : 1.0);
  }
  const int n_fits = 20;
  std::map<std::string, int> held;
  std::map<std::string, double> width, miss;
  int all = 0;
  for (int k = 0; k < n_fits; ++k) {
    const ElasticFit fit = fit_elastic(Evidence(rock, targets), packings_from(3000 + 20 * k, 5),
                                       packings_from(3005 + 20 * k, 15), *simulator, [](const Finding&) {});
    for (const Estimate& e : fit.parameters) {
      const double value =
          elastic_parameters(truth)[static_cast<std::size_t>(&e - fit.parameters.data())]->get(truth);
      const bool holds = e.low <= value && value <= e.high;
      held[e.symbol] += holds, all += holds;
      width[e.symbol] += std::log(e.high / e.low) / n_fits,
          miss[e.symbol] += std::pow(std::log(e.value / value), 2.0) / n_fits;
    }
  }
  for (const auto& [symbol, n] : held)
    std::printf("%s: %s held by %d of %d, error %.1f %%, intervals +-%.1f %%\n", GetParam().name,
                symbol.c_str(), n, n_fits, 100.0 * std::sqrt(miss[symbol]), 50.0 * width[symbol]);
  EXPECT_GE(all, 4 * n_fits * 88 / 100);
}

INSTANTIATE_TEST_SUITE_P(Rules, ElasticIntervals,
                         testing::Values(Case{"zone", BeddingRule::zone},
                                         Case{"crossing", BeddingRule::crossing}),
                         [](const auto& c) { return std::string(c.param.name); });

}  // namespace
}  // namespace phy::calibrate
