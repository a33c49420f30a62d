// A smooth function of the inclination: closed forms, symmetry, and what few cells leave open.
#include "base/angle_process.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace phy {
namespace {

std::vector<AngleCell> cells_of(double (*f)(double), double noise) {
  std::vector<AngleCell> cells;
  for (const double theta : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0})
    cells.push_back({{theta, 0.0}, f(theta), noise, 0.0});
  return cells;
}

double wave(double theta) { return 0.2 * std::cos(theta * std::acos(-1.0) / 90.0); }

TEST(AngleProcess, WithoutCellsItIsItsPrior) {
  const AngleProcess nothing({}, 0.1);
  const AngleProcess::Prediction p = nothing.at({30.0, 0.0});
  EXPECT_EQ(p.mean, 0.0);
  EXPECT_EQ(p.weights.size(), 0);
  EXPECT_GT(p.variance, 0.1 * 0.1) << "the mean of squares is above the square of the mean";
  EXPECT_NEAR(nothing.size(), 0.1, 0.01) << "exponential: its mean is the usual size";
}

// Rasmussen & Williams, (2.25), (2.26) for one cell: every node has the mean v s^2/(s^2 + noise).
TEST(AngleProcess, OneCellAtItsOwnPlaceIsDrawnTowardsNothing) {
  const AngleProcess one({{{20.0, 0.0}, 0.3, 1e-4, 0.0}}, 0.1);
  const AngleProcess::Prediction here = one.at({20.0, 0.0});
  EXPECT_LT(here.mean, 0.3);
  EXPECT_GT(here.mean, 0.29) << "no size that explains 0.3 shrinks it by much";
  EXPECT_NEAR(here.weights[0] * 0.3, here.mean, 1e-12);
}

// A stress that no cell has: the level stays, and the doubt is that of a slope of which nothing is known.
TEST(AngleProcess, CellsOfOneStressLeaveTheSlopeOpen) {
  const AngleProcess p(cells_of(wave, 1e-4), 0.1);
  const double known = p.at({40.0, 0.0}).variance, slope = AngleProcess({}, 0.1).at({40.0, 0.2}).variance -
                                                           AngleProcess({}, 0.1).at({40.0, 0.0}).variance;
  EXPECT_GT(slope, 0.1 * 0.1);
  for (const double stress : {0.1, 0.4}) {
    EXPECT_NEAR(p.at({40.0, stress}).mean, p.at({40.0, 0.0}).mean, 1e-12);
    EXPECT_NEAR(p.at({40.0, stress}).variance, known + slope * std::pow(stress / 0.2, 2), 1e-9);
  }
}

TEST(AngleProcess, TwoStressesSettleTheSlope) {
  std::vector<AngleCell> cells = cells_of(wave, 1e-4);
  for (AngleCell c : cells_of(wave, 1e-4)) c.place.stress = 0.1, c.value += 0.1, cells.push_back(c);
  const AngleProcess p(cells, 0.1);
  const AngleProcess::Prediction beyond = p.at({40.0, 0.2}),
                                 one = AngleProcess(cells_of(wave, 1e-4), 0.1).at({40.0, 0.2});
  EXPECT_NEAR(beyond.mean, wave(40.0) + 0.2, 0.03);
  EXPECT_LT(beyond.variance, 0.1 * one.variance);
}

TEST(AngleProcess, WhatACellHasOfItsOwnIsWantedThereAlone) {
  // a function of no size that matters: v own/(own + noise)
  const AngleProcess one({{{20.0, 0.0}, 0.01, 0.03, 0.01}}, 1e-6);
  EXPECT_NEAR(one.of_cell(0).mean, 0.01 * 0.25, 1e-6);
  EXPECT_NEAR(one.of_cell(0).variance, 0.03 * 0.25, 1e-6);
  EXPECT_NEAR(one.at({20.0, 0.0}).mean, 0.0, 1e-6);
}

TEST(AngleProcess, MirroredInclinationsAreOne) {
  const AngleProcess p({{{20.0, 0.0}, 0.3, 1e-4, 0.0}, {{70.0, 0.0}, -0.1, 1e-4, 0.0}}, 0.1);
  const double at_30 = p.at({30.0, 0.0}).mean;
  EXPECT_NEAR(p.at({-30.0, 0.0}).mean, at_30, 1e-12);
  EXPECT_NEAR(p.at({150.0, 0.0}).mean, at_30, 1e-12);
  EXPECT_GT(std::fabs(p.at({60.0, 0.0}).mean - at_30), 0.05);
}

TEST(AngleProcess, ASmoothFunctionIsFoundBetweenItsCells) {
  const AngleProcess p(cells_of(wave, 1e-4), 0.1);
  for (const double theta : {7.0, 40.0, 52.0, 83.0}) {
    const AngleProcess::Prediction at = p.at({theta, 0.0});
    EXPECT_NEAR(at.mean, wave(theta), 0.01) << theta;
    EXPECT_LT(std::fabs(at.mean - wave(theta)), 3.0 * std::sqrt(at.variance)) << theta;
  }
}

TEST(AngleProcess, ValuesWithinTheirNoiseMakeAlmostNothing) {
  const AngleProcess p(cells_of([](double t) { return std::fmod(t, 30.0) > 0.0 ? 0.02 : -0.02; }, 9e-4), 0.1);
  EXPECT_LT(std::fabs(p.at({15.0, 0.0}).mean), 0.01);
  EXPECT_LT(p.size(), 0.05);
}

}  // namespace
}  // namespace phy
