// Direct shear of bedding, from the table of a laboratory to the test that answers it, to what it determines.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "base/exact_math.hpp"
#include "calibrate/calibration.hpp"
#include "calibrate/paper_press_fixture.hpp"
#include "calibrate/parameters.hpp"
#include "calibrate/strength_tests.hpp"
#include "maps/prior_regression.hpp"
#include "records/reading_fixture.hpp"

namespace phy::calibrate {
namespace {

Target sheared(Property property, double sigma_n, double tau) {
  Target t;
  t.property = property, t.confining = sigma_n, t.mean = tau, t.sd = 0.1 * tau;
  return t;
}
RockReading shear_reading(Property property, double sigma_n, double tau) {
  RockReading r = reading(property, 0.0, tau);
  r.confining = sigma_n;
  return r;
}

// The boxes meet on a plane, and slide until the residual strength shows.
TEST(DirectShearOfBedding, IsTestedOnAPlaneUnderItsStress) {
  Recipe rock;
  rock.bedding.resize(1);
  rock.bedding[0].offset = 1e-3, rock.bedding[0].k_s = 500e9;
  const std::vector<Target> both = {sheared(Property::shear_peak, 5e6, 20e6),
                                    sheared(Property::shear_residual, 5e6, 2e6)};
  const StrengthTests tests(rock, both, std::vector<double>(2, 50e9));
  const Recipe peak = tests.of(rock, 0, 1, search_of_strengths),
               residual = tests.of(rock, 1, 1, search_of_strengths);
  EXPECT_EQ(peak.test.kind, TestKind("direct_shear"));
  EXPECT_EQ(peak.test.normal_stress, 5e6);
  EXPECT_EQ(peak.bedding[0].offset, 0.0);
  EXPECT_EQ(peak.bedding[0].theta, 0.0);
  EXPECT_EQ(peak.test.approach_strain, 0.0);
  EXPECT_GT(peak.test.max_strain * rock.specimen.width, 3.0 * 20e6 / 500e9) << "beyond tau/k_s";
  EXPECT_EQ(residual.test.platen_speed, peak.test.platen_speed) << "one test answers both";
  EXPECT_EQ(residual.test.max_strain, peak.test.max_strain);
}

// Joints without bridges: C + sigma_n tan(phi), then mu sigma_n (V20 of `phyllite verify`).
TEST(DirectShearOfBedding, IsExpectedByTheStrengthOfItsJoints) {
  Rock rock;
  rock.model.bedding.resize(1);
  BeddingRecipe& joint = rock.model.bedding[0];
  joint.rule = BeddingRule::crossing, joint.mu = 0.5, joint.phi = 30.0;
  rock.readings = {reading(Property::ucs, 45.0, 100e6), shear_reading(Property::shear_peak, 10e6, 20e6)};
  const Evidence evidence(rock);
  const std::vector<const Parameter*> ratios = strength_ratios(evidence);
  std::vector<double> z(ratios.size(), 0.0);
  z.push_back(0.0);  // sigma_c in the middle of its box
  Recipe at = rock.model;
  const LogBox sigma = matrix_sigma_c.box(evidence.scales);
  matrix_sigma_c.set(at, std::exp(0.5 * (sigma.low + sigma.high)));
  for (const Parameter* p : ratios) p->set(at, p->from_normalised(0.0));
  const auto expected = [&](Property property, double stress) {
    return std::exp(maps::prior_strength(evidence, rock.model, sheared(property, stress, 20e6)).value(z)) *
           at.matrix.sigma_c;
  };
  const double C = at.bedding[0].cohesion, mu = at.bedding[0].mu;
  EXPECT_NEAR(expected(Property::shear_peak, 10e6) / (C + 10e6 * tan_degrees(30.0)), 1.0, 1e-9);
  EXPECT_NEAR(expected(Property::shear_residual, 10e6) / (mu * 10e6), 1.0, 1e-9);
}

TEST(DirectShearOfBedding, DeterminesWhatBeddingIsMadeOf) {
  Rock rock;
  rock.model.bedding.resize(1);
  rock.readings = {reading(Property::ucs, 0.0, 100e6)};
  const auto held = [&](const Parameter& p) { return p.strength->rule(Evidence(rock)).held; };
  EXPECT_FALSE(held(joint_cohesion) || held(joint_mu) || held(joint_phi));
  rock.readings.push_back(shear_reading(Property::shear_peak, 2e6, 15e6));
  EXPECT_TRUE(held(joint_cohesion));
  EXPECT_FALSE(held(joint_phi)) << "one stress tells no growth";
  rock.readings.push_back(shear_reading(Property::shear_peak, 10e6, 18e6));
  EXPECT_TRUE(held(joint_phi));
  EXPECT_FALSE(held(joint_mu)) << "bonded joints do not slide";
  rock.readings.push_back(shear_reading(Property::shear_residual, 10e6, 4e6));
  EXPECT_TRUE(held(joint_mu));
}

/// A press that shears bedding as its joints do.
class ShearBox : public PaperPress {
 public:
  static double peak(const BeddingRecipe& b, double stress) {
    return 1.2 * (b.cohesion + stress * tan_degrees(b.phi));
  }
  std::vector<TestResult> run(const std::vector<Recipe>& recipes) override {
    std::vector<TestResult> results = PaperPress::run(recipes);
    for (std::size_t i = 0; i < recipes.size(); ++i) {
      const TestRecipe& test = recipes[i].test;
      if (test.kind != TestKind("direct_shear")) continue;
      const BeddingRecipe& b = recipes[i].bedding.front();
      results[i].numbers = {{"tau_peak", peak(b, test.normal_stress), "Pa", "", ""},
                            {"tau_residual", b.mu * test.normal_stress, "Pa", "", ""}};
    }
    return results;
  }
};

std::map<std::string, ParameterEstimate> found(const Rock& rock) {
  ShearBox press;
  CalibrationOptions options;
  options.max_tests = 1000;
  std::map<std::string, ParameterEstimate> by_symbol;
  for (const ParameterEstimate& e : calibrate(Evidence(rock), options, press).parameters)
    by_symbol[e.symbol] = e;
  return by_symbol;
}

// Three UCS leave C and mu_sj wide; with the box both come back, and narrower.
TEST(DirectShearOfBedding, FindsCohesionAndFrictionOfTheJoints) {
  Recipe truth;
  truth.bedding.resize(1);
  truth.matrix.sigma_c = 60e6, truth.matrix.tau_c = 120e6, truth.matrix.mu = 0.6;
  BeddingRecipe& joint = truth.bedding[0];
  joint.cohesion = 15e6, joint.sigma_n = 8e6, joint.mu = 0.6, joint.phi = 25.0;
  Rock rock;
  rock.model.bedding.resize(1);
  for (const double theta : {0.0, 45.0, 90.0}) {
    joint.theta = theta;
    rock.readings.push_back(reading(Property::ucs, theta, PaperPress::ucs(truth)));
  }
  const auto without = found(rock);
  for (const double stress : {2e6, 10e6, 20e6}) {
    rock.readings.push_back(shear_reading(Property::shear_peak, stress, ShearBox::peak(joint, stress)));
    rock.readings.push_back(shear_reading(Property::shear_residual, stress, joint.mu * stress));
  }
  const auto with = found(rock);
  EXPECT_EQ(without.count("phi_sj"), 0U) << "nothing speaks of it";
  for (const char* symbol : {"C_sj", "mu_sj", "phi_sj"}) {
    const ParameterEstimate& e = with.at(symbol);
    const double value = e.number(truth);
    EXPECT_TRUE(e.low <= value && value <= e.high) << symbol << ' ' << e.low << " ... " << e.high;
    EXPECT_TRUE(e.determined) << symbol;
  }
  for (const char* symbol : {"C_sj", "mu_sj"})
    EXPECT_LT(std::log(with.at(symbol).high / with.at(symbol).low),
              0.7 * std::log(without.at(symbol).high / without.at(symbol).low))
        << symbol;
}

}  // namespace
}  // namespace phy::calibrate
