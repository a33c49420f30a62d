// Is there a layered body behind E(theta) and nu(theta)? Tables made by rotating a tensor have one; tables
// with one value changed have none.
#include "theory/layered_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace phy::theory {
namespace {

const double pi_ = std::acos(-1.0);

/// E and nu of a uniaxial test by turning the compliance tensor s_ijkl index by index: no formula of the
/// program.
PlaneConstants turned_tensor(const PlaneCompliance& S, double theta) {
  double s[2][2][2][2] = {};
  s[0][0][0][0] = S.S_xx, s[1][1][1][1] = S.S_yy, s[0][0][1][1] = s[1][1][0][0] = S.S_xy;
  for (const auto& [i, j] : {std::pair{0, 1}, std::pair{1, 0}})
    for (const auto& [k, l] : {std::pair{0, 1}, std::pair{1, 0}}) s[i][j][k][l] = 0.25 * S.S_ss;
  const double a = theta * pi_ / 180.0;
  const double R[2][2] = {{std::cos(a), std::sin(a)},
                          {-std::sin(a), std::cos(a)}};  // body axes in fixed ones
  const auto component = [&](int p, int q, int r, int t) {
    double sum = 0.0;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        for (int k = 0; k < 2; ++k)
          for (int l = 0; l < 2; ++l) sum += R[i][p] * R[j][q] * R[k][r] * R[l][t] * s[i][j][k][l];
    return sum;
  };
  return {1.0 / component(1, 1, 1, 1), -component(0, 0, 1, 1) / component(1, 1, 1, 1)};
}

const PlaneCompliance shale{1.0 / 38e9, 1.0 / 19e9, -0.16 / 19e9, 0.0, 0.0, 1.0 / 9e9};
/// Stiffer across its bedding than along it: no planes in isotropic rock do this.
const PlaneCompliance reversed{1.0 / 22e9, 1.0 / 40e9, -0.2 / 40e9, 0.0, 0.0, 1.0 / 11e9};
const std::vector<double> angles = {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0};

std::vector<LayeredReading> table_of(const PlaneCompliance& S, double error) {
  std::vector<LayeredReading> cells;
  for (const double theta : angles) {
    const PlaneConstants seen = turned_tensor(S, theta);
    cells.push_back({theta, true, seen.E, error * seen.E});
    cells.push_back({theta, false, seen.nu, error});
  }
  return cells;
}

TEST(SeenAt, IsTheTensorTurned) {
  for (const PlaneCompliance& S : {shale, reversed})
    for (double theta = 0.0; theta <= 90.0; theta += 7.5) {
      const PlaneConstants closed = seen_at(S, theta), turned = turned_tensor(S, theta);
      EXPECT_NEAR(closed.E / turned.E, 1.0, 1e-12) << theta;
      EXPECT_NEAR(closed.nu, turned.nu, 1e-12) << theta;
    }
}

TEST(SeenAt, TwoTestsAtTheEndsSayWhatNuIsBetween) {
  const PlaneConstants at_0 = turned_tensor(shale, 0.0), at_90 = turned_tensor(shale, 90.0);
  EXPECT_NEAR(at_0.nu / at_0.E * at_90.E / at_90.nu, 1.0, 1e-12);
  for (const double theta : angles) {
    const PlaneConstants seen = turned_tensor(shale, theta);
    const double c2 = std::pow(std::cos(theta * pi_ / 180.0), 2.0);
    const double expected = c2 * (1.0 - at_0.nu) / at_0.E + (1.0 - c2) * (1.0 - at_90.nu) / at_90.E;
    EXPECT_NEAR((1.0 - seen.nu) / seen.E / expected, 1.0, 1e-12) << theta;
  }
}

TEST(LayeredFit, FindsTheTensorBehindATable) {
  const LayeredFit fit = fit_layered(table_of(shale, 0.01), LayeredBody::any);
  EXPECT_EQ(fit.degrees_of_freedom, 10);
  EXPECT_LT(fit.chi_square, 1e-6);
  EXPECT_NEAR(fit.body.S_xx / shale.S_xx, 1.0, 1e-4);
  EXPECT_NEAR(fit.body.S_yy / shale.S_yy, 1.0, 1e-4);
  EXPECT_NEAR(fit.body.S_xy / shale.S_xy, 1.0, 1e-3);
  EXPECT_NEAR(fit.body.S_ss / shale.S_ss, 1.0, 1e-3);
}

TEST(LayeredFit, ARockStifferAcrossItsBeddingIsALayeredBodyWithoutSofteningPlanes) {
  const std::vector<LayeredReading> cells = table_of(reversed, 0.02);
  EXPECT_TRUE(fit_layered(cells, LayeredBody::any).met());
  const LayeredFit planes = fit_layered(cells, LayeredBody::planes_in_isotropic_rock);
  EXPECT_FALSE(planes.met());
  EXPECT_GE(planes.body.S_yy, planes.body.S_xx);
  EXPECT_TRUE(fit_layered(table_of({1.0 / 45e9, 1.0 / 45e9 + 1.0 / 30e9, -0.24 / 45e9, 0.0, 0.0,
                                    2.48 / 45e9 + 1.0 / 8e9},
                                   0.02),
                          LayeredBody::planes_in_isotropic_rock)
                  .met());
}

TEST(LayeredFit, ASingleValueThatBelongsToNoBodyIsSeen) {
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, std::size_t{6}, std::size_t{7}}) {
    std::vector<LayeredReading> cells = table_of(shale, 0.01);
    cells[i].value += cells[i].is_modulus ? 0.15 * cells[i].value : 0.1;
    EXPECT_FALSE(fit_layered(cells, LayeredBody::any).met()) << i;
    cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_TRUE(fit_layered(cells, LayeredBody::any).met()) << i;
  }
}

// nu(0)/E(0) = nu(90)/E(90) is all that four cells at the ends can contradict.
TEST(LayeredFit, TheEndsAloneContradictEachOtherByTheirNu) {
  const auto ends = [](double nu_90) {
    return std::vector<LayeredReading>{{0.0, true, 20e9, 0.4e9},
                                       {90.0, true, 40e9, 0.8e9},
                                       {0.0, false, 0.15, 0.01},
                                       {90.0, false, nu_90, 0.01}};
  };
  EXPECT_EQ(fit_layered(ends(0.30), LayeredBody::any).degrees_of_freedom, 1);
  EXPECT_TRUE(fit_layered(ends(0.31), LayeredBody::any).met());
  EXPECT_FALSE(fit_layered(ends(0.15), LayeredBody::any).met());
  std::vector<LayeredReading> moduli = ends(0.15);
  moduli.resize(2);
  EXPECT_EQ(fit_layered(moduli, LayeredBody::any).degrees_of_freedom, 0);
  EXPECT_TRUE(fit_layered(moduli, LayeredBody::any).met());
}

// Energy must be positive: two directions cannot each take up all of what the other gives.
TEST(LayeredFit, ATableThatWouldGiveEnergyForNothingHasNoBody) {
  const std::vector<LayeredReading> cells = {{0.0, true, 20e9, 0.4e9},
                                             {45.0, true, 15e9, 0.3e9},
                                             {90.0, true, 20e9, 0.4e9},
                                             {0.0, false, 1.3, 0.02},
                                             {90.0, false, 1.3, 0.02}};
  const LayeredFit fit = fit_layered(cells, LayeredBody::any);
  EXPECT_FALSE(fit.met());
  EXPECT_LT(fit.body.S_xy * fit.body.S_xy, fit.body.S_xx * fit.body.S_yy * (1.0 + 1e-9));
}

// The limit is the 99 % quantile of chi-square: 6.6349, 11.3449, 23.2093 for 1, 3, 10 degrees of freedom
// (tables).
TEST(LayeredFit, TheLimitIsWhatChanceExceedsOnceInAHundred) {
  LayeredFit fit;
  for (const auto& [n, quantile] : {std::pair{1, 6.6349}, std::pair{3, 11.3449}, std::pair{10, 23.2093}}) {
    fit.degrees_of_freedom = n;
    EXPECT_NEAR(fit.limit() / quantile, 1.0, 1e-5) << n;
  }
}

}  // namespace
}  // namespace phy::theory
