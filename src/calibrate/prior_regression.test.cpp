// The prior regression against what it must know whatever was learnt, and against the paper's specimen at
// full size, which it has never seen.
#include "calibrate/prior_regression.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace phy::calibrate {
namespace {

Recipe paper_rock() {
  Recipe r;
  r.bedding.resize(1);
  return r;
}

/// Place of a recipe in the box of strength ratios.
std::vector<double> place_of(const Recipe& r) {
  std::vector<double> z;
  for (const StrengthParameter* p : strength_ratios(!r.bedding.empty())) z.push_back(p->place_of(p->get(r)));
  return z;
}

double prior(const Recipe& r, double theta) {
  return r.matrix.sigma_c * std::exp(PriorRegression(r, theta).at(place_of(r)));
}

TEST(PriorRegression, PredictsThePapersSpecimenThatItHasNotSeen) {
  // three packings of 7,481 discs (docs/status.md), which scatter by up to 9 %
  const std::map<double, double> measured = {{0, 105.2e6}, {15, 100.4e6}, {30, 67.1e6}, {45, 52.8e6},
                                             {60, 49.8e6}, {75, 71.9e6},  {90, 138.3e6}};
  double squares = 0.0;
  for (const auto& [theta, ucs] : measured) {
    const double error = std::log(prior(paper_rock(), theta) / ucs);
    EXPECT_LT(std::fabs(error), 0.35) << theta;
    squares += error * error / 7.0;
  }
  EXPECT_LT(std::sqrt(squares), 0.2);  // of rocks of its own kind it misses 10 to 18 %
  Recipe intact = paper_rock();
  intact.bedding.clear();
  EXPECT_NEAR(prior(intact, 0.0) / 179.5e6, 1.0, 0.2);
}

TEST(PriorRegression, IsTheSameAtMirroredAnglesAndLinearBetweenThoseItKnows) {
  const std::vector<double> z = place_of(paper_rock());
  const auto at = [&](double theta) { return PriorRegression(paper_rock(), theta).at(z); };
  EXPECT_DOUBLE_EQ(at(30.0), at(150.0));
  EXPECT_NEAR(at(37.5), 0.5 * (at(30.0) + at(45.0)), 1e-12);
}

TEST(PriorRegression, DependsOnNoUnitAndNoSizeOfGrains) {
  Recipe other = paper_rock();
  MatrixRecipe& m = other.matrix;
  BeddingRecipe& b = other.bedding[0];
  for (double* stress : {&m.E_c, &m.E_b, &m.sigma_c, &m.tau_c, &b.cohesion, &b.sigma_n}) *stress *= 3.0;
  b.spacing *= 2.0, b.k_n *= 1.5, b.k_s *= 1.5;
  EXPECT_NEAR(prior(other, 45.0) / prior(paper_rock(), 45.0), 3.0, 1e-9);
}

TEST(PriorRegression, HoldsModuliItHasNotSeenAtTheEdgeOfWhatItHas) {
  Recipe soft = paper_rock(), softer = paper_rock();
  soft.bedding[0].k_s *= 1e-3, softer.bedding[0].k_s *= 1e-5;
  EXPECT_DOUBLE_EQ(prior(soft, 45.0), prior(softer, 45.0));
}

double tension(const Recipe& r, Property property, double theta) {
  return r.matrix.sigma_c * std::exp(prior_strength(r, property, theta).value(place_of(r)));
}

TEST(PriorRegression, TensionAcrossThePlanesIsThatOfThePlanesAlongThemThatOfTheMatrix) {
  const Recipe r = paper_rock();  // sigma_n = 10 MPa, C = 30, sigma_c = 65
  EXPECT_NEAR(tension(r, Property::direct_tension, 0.0) / r.bedding[0].sigma_n, 1.0, 0.01);
  EXPECT_NEAR(tension(r, Property::direct_tension, 90.0) / (0.55 * r.matrix.sigma_c), 1.0, 1e-9);
  EXPECT_NEAR(tension(r, Property::brazilian, 90.0), tension(r, Property::direct_tension, 0.0), 1.0);
  for (double theta = 0.0; theta < 90.0; theta += 5.0)
    EXPECT_LT(tension(r, Property::direct_tension, theta), tension(r, Property::direct_tension, theta + 5.0));
}

}  // namespace
}  // namespace phy::calibrate
