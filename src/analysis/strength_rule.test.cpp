// Made-up histories whose peak, dip or knee is known.
#include "analysis/strength_rule.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace phy::analysis {
namespace {

/// Straight pieces between corners (strain in %, stress in MPa), a row every 0.001 %.
struct Curve {
  std::vector<double> strain, stress;

  explicit Curve(double at = 0.0, double from = 0.0) : strain{at}, stress{from} {}
  Curve& to(double at, double value) {
    const double start = strain.back(), below = stress.back();
    const int n = static_cast<int>((at - start) / 0.001 + 0.5);
    for (int i = 1; i <= n; ++i)
      strain.push_back(start + (at - start) * i / n), stress.push_back(below + (value - below) * i / n);
    return *this;
  }
  /// Uniform in +- `most`, the same every time.
  Curve& noisy(double most, unsigned seed) {
    for (double& s : stress) {
      seed = seed * 1664525u + 1013904223u;
      s += most * (static_cast<double>(seed >> 8) / 8388608.0 - 1.0);
    }
    return *this;
  }
  StrengthPoint point(StopRule stop = {}) const { return strength_point(strain, stress, stop); }
};

/// 50 GPa up to 100 MPa at 0.2 %.
Curve rising() { return Curve().to(0.2, 100.0); }

TEST(StrengthRule, APeakThatTheTestFellFromIsTheLargestStress) {
  const Curve c = rising().to(0.25, 59.0);
  EXPECT_EQ(c.point().rule, StrengthRule::peak);
  EXPECT_EQ(c.point().row, 200u);
}

TEST(StrengthRule, APeakWithoutALargerStressForTwiceItsStrainIsOne) {
  const Curve c = rising().to(0.401, 98.0);
  EXPECT_EQ(c.point().rule, StrengthRule::peak);
  EXPECT_EQ(c.point().row, 200u);
}

// Of a test that ended as its recipe asks for, no dip takes the strength away, however deep.
TEST(StrengthRule, NoDipOnTheRiseCountsBeforeAPeak) {
  for (const double dip : {1.0, 8.0, 20.0, 23.0}) {
    const Curve c = Curve().to(0.12, 60.0).to(0.13, 60.0 - dip).to(0.25, 100.0).to(0.3, 59.0);
    EXPECT_EQ(c.point().rule, StrengthRule::peak) << dip;
    EXPECT_EQ(c.stress[c.point().row], 100.0) << dip;
  }
}

TEST(StrengthRule, ADipOnTheRiseIsNeitherPeakNorKnee) {
  for (const double dip : {1.0, 3.0, 8.0}) {
    const Curve c = Curve().to(0.12, 60.0).to(0.125, 60.0 - dip).to(0.3, 140.0);
    EXPECT_EQ(c.point().rule, StrengthRule::largest) << dip;
    EXPECT_EQ(c.point().row, c.stress.size() - 1) << dip;
  }
}

// Behind the kink the tangent is 4 % of E. It falls below 5 % once nearly all of the window, 10 % of the
// strain, is behind it: at most 5 % of the strain later, in which the stress grows by 4 % of 5 %.
TEST(StrengthRule, AKneeThatHardensIsFoundWhereItBends) {
  const Curve c = rising().to(0.4, 104.0);
  ASSERT_EQ(c.point().rule, StrengthRule::knee);
  EXPECT_GE(c.stress[c.point().row], 100.0);
  EXPECT_LE(c.stress[c.point().row], 100.0 * (1.0 + 0.04 * 0.06));
  EXPECT_LE(c.strain[c.point().row], 0.2 * 1.06);
}

TEST(StrengthRule, AFirstMaximumWithASmallDipThatHardensIsAKnee) {  // 283 MPa, 1 % dip, up to 338 MPa
  const Curve c = Curve().to(0.45, 283.0).to(0.47, 280.0).to(1.23, 338.0);
  ASSERT_EQ(c.point().rule, StrengthRule::knee);
  EXPECT_EQ(c.stress[c.point().row], 283.0);
}

TEST(StrengthRule, AFirstMaximumThatFallsByATenthIsAPeakThoughItHardensLater) {
  const Curve c = rising().to(0.21, 85.0).to(0.6, 120.0);
  ASSERT_EQ(c.point().rule, StrengthRule::peak);
  EXPECT_EQ(c.stress[c.point().row], 100.0);
}

TEST(StrengthRule, AFallByATenthThatMendsAtOnceIsADip) {
  const Curve c = rising().to(0.21, 88.0).to(0.4, 183.0);
  EXPECT_EQ(c.point().rule, StrengthRule::largest);
}

TEST(StrengthRule, WhatRisesToTheEndHasNoStrength) {
  EXPECT_EQ(rising().point().rule, StrengthRule::largest);
  const Curve softer = rising().to(0.6, 120.0);  // 10 % of E behind the kink
  EXPECT_EQ(softer.point().rule, StrengthRule::largest);
  EXPECT_EQ(softer.point().row, softer.stress.size() - 1);
}

TEST(StrengthRule, AKneeNeedsAnotherQuarterOfItsStrain) {
  EXPECT_EQ(rising().to(0.24, 100.5).point().rule, StrengthRule::largest);
  EXPECT_EQ(rising().to(0.27, 100.5).point().rule, StrengthRule::knee);
}

// 1.5 % of the strength: half of a difference of the platens of 3 %, from which on a test carries a warning.
TEST(StrengthRule, NoiseOfTheRowsMakesNoKneeAndMovesNone) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    EXPECT_EQ(rising().noisy(1.5, seed).point().rule, StrengthRule::largest) << seed;
    const Curve c = rising().to(0.4, 102.0).noisy(1.5, seed);
    ASSERT_EQ(c.point().rule, StrengthRule::knee) << seed;
    EXPECT_NEAR(c.stress[c.point().row], 100.0, 1.5 + 0.5) << seed;
  }
}

TEST(StrengthRule, AHistoryThatStartsLoadedHasItsKneeToo) {
  const Curve c = Curve(0.08, 40.0).to(0.2, 100.0).to(0.4, 102.0);
  ASSERT_EQ(c.point().rule, StrengthRule::knee);
  EXPECT_NEAR(c.stress[c.point().row], 100.0, 0.1);
}

TEST(StrengthRule, TheStepsOfTheFirstWavesAreNoKnee) {  // treads of a stair, up to a tenth of the strength
  Curve c;
  for (int i = 1; i <= 5; ++i) c.to(0.004 * i - 0.001, 2.0 * i - 1.9).to(0.004 * i, 2.0 * i);
  EXPECT_EQ(c.to(0.2, 100.0).point().rule, StrengthRule::largest);
}

TEST(StrengthRule, AHistoryThatUnloadsHasNoKnee) {
  Curve c = rising();
  for (int i = 0; i < 100; ++i) c.strain.push_back(c.strain.back() - 0.0005), c.stress.push_back(99.0);
  EXPECT_EQ(c.to(0.4, 101.0).point().rule, StrengthRule::largest);
}

TEST(StrengthRule, TheRecipeSaysWhatIsOver) {
  const Curve c = Curve().to(0.2, 100.0).to(0.22, 94.0);
  EXPECT_EQ(c.point().rule, StrengthRule::largest);
  EXPECT_EQ(c.point({.stop_at = 0.95}).rule, StrengthRule::peak);
  EXPECT_EQ(c.point({.post_peak = 0.05}).rule, StrengthRule::peak);
  EXPECT_EQ(c.point({.post_peak = 0.0}).rule, StrengthRule::largest);
}

// A few rows of a specimen in motion: the wave in the first ones is no peak.
TEST(StrengthRule, AWaveBetweenRowsFarApartIsADip) {
  const std::vector<double> strain = {6e-5, 1.4e-4, 2.2e-4, 3.0e-4, 3.8e-4, 4.6e-4, 5.4e-4};
  const std::vector<double> stress = {2.2e6, 1.6e6, 1.9e6, 2.9e6, 3.8e6, 4.6e6, 5.3e6};
  EXPECT_EQ(strength_point(strain, stress, {}).rule, StrengthRule::largest);
}

}  // namespace
}  // namespace phy::analysis
