// The elastic stage on small packings: it must find parameters that it is not told, and say what cannot be
// met.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/stats.hpp"
#include "calibrate/elastic_fit.hpp"
#include "calibrate/elastic_response.hpp"
#include "verdict/cells.hpp"
#include "verdict/judge.hpp"

namespace phy::calibrate {
namespace {

using verdict::tolerance;

const std::vector<std::int64_t> seeds = {1, 2};
const std::vector<double> angles = {0.0, 30.0, 45.0, 60.0, 90.0};

/// A rock on a specimen of some 900 grains whose parameters differ from the recipe that the fit starts from.
Rock small_rock() {
  Rock rock;
  rock.model.packing.n_grains = 935;
  rock.model.packing.radius_min *= std::sqrt(8.0), rock.model.packing.radius_max *= std::sqrt(8.0);
  rock.model.bedding.resize(1);
  rock.model.bedding[0].spacing = 0.01;
  rock.model.bedding[0].zone_thickness *= std::sqrt(8.0);
  return rock;
}

Recipe truth_of(const Rock& rock) {
  Recipe truth = rock.model;
  truth.matrix.E_c = truth.matrix.E_b = 21e9;
  truth.matrix.ks_over_kn = truth.matrix.bond_ks_over_kn = 0.42;
  truth.bedding[0].k_n = 900e9, truth.bedding[0].k_s = 500e9;
  return truth;
}

std::vector<Target> exact_targets(const Recipe& truth, Simulator& simulator, bool nu) {
  std::vector<Target> targets;
  for (const Property p : {Property::E, Property::nu})
    for (const double theta : angles)
      if (p == Property::E || nu)
        targets.push_back({p, theta, 1.0, p == Property::E ? 1e8 : 0.005, 3, false});
  const std::vector<Comparison> values = elastic_response(truth, targets, seeds, simulator);
  for (std::size_t i = 0; i < targets.size(); ++i) targets[i].mean = values[i].mean;
  return targets;
}

class ElasticStage : public testing::Test {
 protected:
  std::unique_ptr<Simulator> simulator = make_simulator({2, "", nullptr, nullptr});
  Rock rock = small_rock();
  ElasticFit fit(const std::vector<Target>& targets) {
    return fit_elastic(Evidence(rock, targets), seeds, {}, *simulator, [](const Finding&) {});
  }
  /// With the unseen packings those of the fit.
  static Verdict judged(const ElasticFit& f) {
    verdict::Results r;
    r.moduli = r.verification = f.comparisons;
    r.parameters.assign(f.parameters.begin(), f.parameters.end());
    if (f.nu_gave_way) r.E_before_nu_gave_way = f.E_before;
    Verdict v = verdict::judge(r);
    std::erase_if(v.findings, [](const Finding& one) { return one.kind == FindingKind::value_open; });
    return v;
  }
};

TEST_F(ElasticStage, FindsTheFourParametersOfExactData) {
  const ElasticFit f = fit(exact_targets(truth_of(rock), *simulator, true));
  ASSERT_EQ(f.parameters.size(), 4U);
  EXPECT_NEAR(f.parameters[0].value / 21e9, 1.0, 0.01);
  EXPECT_NEAR(f.parameters[1].value / 0.42, 1.0, 0.03);
  EXPECT_NEAR(f.parameters[2].value / 900e9, 1.0, 0.02);
  EXPECT_NEAR(f.parameters[3].value / 500e9, 1.0, 0.02);
  for (const ParameterEstimate& e : f.parameters) {
    EXPECT_TRUE(e.determined) << e.symbol;
    EXPECT_LT(e.low, e.value);
    EXPECT_GT(e.high, e.value);
  }
  EXPECT_TRUE(judged(f).findings.empty());
  EXPECT_EQ(f.recipe.matrix.E_b, f.recipe.matrix.E_c);
}

// A packing serves every angle, so that its errors at all of them move E_c together. Five fits, each on one
// packing alone, tell how far; the fit on all five has to know it from its own least squares.
TEST_F(ElasticStage, IntervalsKnowThatOnePackingServesAllAngles) {
  rock.model.bedding[0].rule = BeddingRule::crossing;
  const std::vector<std::int64_t> five = {1, 2, 3, 4, 5};
  std::vector<Target> targets = exact_targets(truth_of(rock), *simulator, true);
  const auto values = elastic_response(truth_of(rock), targets, five, *simulator);
  for (std::size_t i = 0; i < targets.size(); ++i)
    targets[i].mean = values[i].mean, targets[i].sd = 1e-6, targets[i].n = 100;
  const auto fit_on = [&](const std::vector<std::int64_t>& packings) {
    return fit_elastic(Evidence(rock, targets), packings, {}, *simulator, [](const Finding&) {});
  };
  std::vector<double> alone;
  for (const std::int64_t seed : five) alone.push_back(std::log(fit_on({seed}).parameters[0].value));
  const Estimate together = fit_on(five).parameters[0];
  const double half = 0.5 * std::log(together.high / together.low);
  EXPECT_NEAR(half / summarise(alone).half_width, 1.0, 0.2);
}

TEST_F(ElasticStage, WithoutPoissonsRatioTheStiffnessRatioStaysOpen) {
  const ElasticFit f = fit(exact_targets(truth_of(rock), *simulator, false));
  for (const Comparison& c : f.comparisons) EXPECT_NEAR(c.error(), 0.0, 0.01);
  EXPECT_LT(f.parameters[2].high / f.parameters[2].low, f.parameters[1].high / f.parameters[1].low);
}

TEST_F(ElasticStage, AConflictOfModuliAndPoissonsRatioIsSaidAndNuGivesWay) {
  std::vector<Target> targets = exact_targets(truth_of(rock), *simulator, true);
  for (Target& t : targets)  // nu'/E' of a table that no joints can make: halved at 0 degrees
    if (t.property == Property::nu && t.theta < 45.0) t.mean *= 0.4;
  const ElasticFit f = fit(targets);
  const Verdict v = judged(f);
  const Finding* gave_way = first_of(v.findings, FindingKind::nu_gave_way);
  ASSERT_NE(gave_way, nullptr);
  EXPECT_GT(gave_way->number("E_before"), tolerance(Property::E));
  for (const Comparison& c : f.comparisons)
    if (c.target.property == Property::E) {
      EXPECT_NEAR(c.error(), 0.0, 0.03) << c.target.theta;
    }
}

TEST_F(ElasticStage, NuKeepsItsWeightWhereModuliMissByNoMoreThanTheirScatter) {
  std::vector<Target> targets = exact_targets(truth_of(rock), *simulator, true);
  double sign = 1.0;
  for (Target& t : targets) {  // three specimens of 7 % scatter: every mean is off by one standard error
    if (t.property != Property::E) continue;
    t.sd = 0.07 * t.mean, t.mean *= 1.0 + sign * 0.040, sign = -sign;
  }
  const ElasticFit f = fit(targets);
  double worst = 0.0;
  for (const Comparison& c : f.comparisons)
    if (c.target.property == Property::E) worst = std::max(worst, std::fabs(c.error()));
  EXPECT_GT(worst, tolerance(Property::E));  // so that the rule is asked
  EXPECT_FALSE(f.nu_gave_way);
  EXPECT_TRUE(judged(f).findings.empty());
}

TEST_F(ElasticStage, ARockStifferAcrossItsBeddingIsOutOfReach) {
  std::vector<Target> targets;
  for (const double theta : angles)
    targets.push_back({Property::E, theta, (40.0 - 0.2 * theta) * 1e9, 0.2e9, 3, false});
  // two packings would tell nothing of their own scatter
  const ElasticFit f =
      fit_elastic(Evidence(rock, targets), {1, 2, 3, 4, 5}, {}, *simulator, [](const Finding&) {});
  EXPECT_EQ(judged(f).status, VerdictStatus::out_of_reach);
}

// Joints that take the place of softer bonds stiffen the rock across its bedding.
TEST_F(ElasticStage, JointsStifferThanTheirBondsAreFittedWithoutAWord) {
  Recipe truth = truth_of(rock);
  truth.bedding[0].k_n = 20.0 * truth.matrix.E_c / truth.bedding[0].spacing;
  truth.bedding[0].k_s = 5.0 * truth.matrix.E_c / truth.bedding[0].spacing;
  const std::vector<Target> targets = exact_targets(truth, *simulator, false);
  ASSERT_GT(targets.front().mean, 1.1 * targets.back().mean);
  const ElasticFit f = fit(targets);
  for (const Comparison& c : f.comparisons) EXPECT_NEAR(c.error(), 0.0, 0.02) << c.target.theta;
  EXPECT_FALSE(verdict::moduli_out_of_reach(f.comparisons));
}

TEST_F(ElasticStage, AnIsotropicRockHasTwoParameters) {
  rock.bedded = false, rock.model.bedding.clear();
  Recipe truth = rock.model;
  truth.matrix.E_c = truth.matrix.E_b = 50e9;
  std::vector<Target> targets = {{Property::E, 0.0, 1.0, 1e8, 3, false},
                                 {Property::nu, 0.0, 1.0, 0.005, 3, false}};
  const auto values = elastic_response(truth, targets, seeds, *simulator);
  for (std::size_t i = 0; i < 2; ++i) targets[i].mean = values[i].mean;
  const ElasticFit f = fit(targets);
  ASSERT_EQ(f.parameters.size(), 2U);
  EXPECT_NEAR(f.parameters[0].value / 50e9, 1.0, 0.01);
  EXPECT_NEAR(f.parameters[1].value / 0.3, 1.0, 0.03);
}

}  // namespace
}  // namespace phy::calibrate
