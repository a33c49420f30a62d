#include "theory/jaeger_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace phy::theory {
namespace {

std::vector<StrengthReading> rock_of(double cohesion, double tan_friction, double matrix) {
  // Coulomb on a plane, unconfined: slip when sin cos s >= c + tan s cos^2.
  std::vector<StrengthReading> all;
  for (const double theta : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0}) {
    const double a = theta * std::acos(-1.0) / 180.0;
    const double drive = std::sin(a) * std::cos(a) - tan_friction * std::cos(a) * std::cos(a);
    all.push_back({theta, drive > 1e-9 ? std::min(matrix, cohesion / drive) : matrix});
  }
  return all;
}

TEST(JaegerFit, FindsThePlaneThatMadeTheReadings) {
  for (const double c : {5e6, 18e6, 35e6})
    for (const double mu : {0.1, 0.4, 0.8}) {
      const JaegerFit fit = fit_jaeger(rock_of(c, mu, 300e6), 300e6);
      ASSERT_TRUE(fit.ok) << fit.reason;
      EXPECT_NEAR(fit.plane.cohesion, c, 1e-3 * c) << mu;
      EXPECT_NEAR(std::tan(fit.plane.friction * std::acos(-1.0) / 180.0), mu, 2e-3) << c;
      EXPECT_GT(fit.R2, 0.99999);
    }
}

TEST(JaegerFit, NoOtherPlaneNearbyFitsScatteredReadingsBetter) {
  auto readings = rock_of(20e6, 0.5, 140e6);
  for (std::size_t i = 0; i < readings.size(); ++i)
    readings[i].ucs *= 1.0 + 0.06 * std::sin(2.3 * static_cast<double>(i));
  const JaegerFit fit = fit_jaeger(readings, 140e6);
  const auto sum = [&](double c, double phi) {
    double s = 0.0;
    for (const auto& r : readings) s += std::pow(r.ucs - jaeger_sigma_1({c, phi}, 140e6, r.theta, 0.0), 2);
    return s;
  };
  const double least = sum(fit.plane.cohesion, fit.plane.friction);
  for (double c = 10e6; c < 30e6; c += 0.31e6)
    for (double phi = 15.0; phi < 40.0; phi += 0.37)
      EXPECT_GE(sum(c, phi), least * (1.0 - 1e-9)) << c << " " << phi;
}

TEST(JaegerFit, RefusesWhatHoldsNoPlane) {
  EXPECT_FALSE(fit_jaeger({{0.0, 1e8}, {90.0, 1e8}}, 1e8).ok);
  EXPECT_FALSE(fit_jaeger({{0.0, 1e8}, {10.0, 1e8}, {90.0, 1e8}}, 1e8).ok);
  EXPECT_FALSE(fit_jaeger({{0.0, 1e8}, {45.0, -1.0}, {90.0, 1e8}}, 1e8).ok);
  EXPECT_FALSE(fit_jaeger(rock_of(20e6, 0.5, 140e6), 0.0).ok);
  EXPECT_NE(fit_jaeger({}, 1e8).reason, "");
  EXPECT_FALSE(fit_jaeger({{0.0, 1e8}, {45.0, 1e8}, {90.0, 1e8}}, 1e8).ok);  // no plane shows
}

TEST(JaegerFit, FindsPlaneAndMatrixThatMadeTheReadings) {
  for (const double c : {15e6, 25e6})
    for (const double mu : {0.1, 0.4, 0.8}) {
      const JaegerFit fit = fit_jaeger_and_matrix(rock_of(c, mu, 140e6));
      ASSERT_TRUE(fit.ok) << fit.reason;
      EXPECT_NEAR(fit.matrix_ucs, 140e6, 1e5) << c << " " << mu;
      EXPECT_NEAR(fit.plane.cohesion, c, 2e-3 * c) << mu;
      EXPECT_GT(fit.R2, 0.99999);
    }
}

TEST(JaegerFit, NoOtherPlaneAndMatrixFitScatteredReadingsBetter) {
  auto readings = rock_of(20e6, 0.5, 140e6);
  for (std::size_t i = 0; i < readings.size(); ++i)
    readings[i].ucs *= 1.0 + 0.06 * std::sin(2.3 * static_cast<double>(i));
  const JaegerFit fit = fit_jaeger_and_matrix(readings);
  ASSERT_TRUE(fit.ok) << fit.reason;
  const auto sum = [&](double c, double phi, double matrix) {
    double s = 0.0;
    for (const auto& r : readings) s += std::pow(r.ucs - jaeger_sigma_1({c, phi}, matrix, r.theta, 0.0), 2);
    return s;
  };
  const double least = sum(fit.plane.cohesion, fit.plane.friction, fit.matrix_ucs);
  for (double c = 10e6; c < 30e6; c += 0.53e6)
    for (double phi = 5.0; phi < 50.0; phi += 0.97)
      for (double matrix = 110e6; matrix < 170e6; matrix += 2.3e6)
        EXPECT_GE(sum(c, phi, matrix), least * (1.0 - 1e-4)) << c << " " << phi << " " << matrix;
}

TEST(JaegerFit, PlaneAndMatrixWantFourInclinations) {
  EXPECT_FALSE(fit_jaeger_and_matrix({{0.0, 1e8}, {45.0, 5e7}, {90.0, 1e8}}).ok);
  EXPECT_TRUE(fit_jaeger_and_matrix({{0.0, 1e8}, {45.0, 5e7}, {60.0, 4e7}, {90.0, 1e8}}).ok);
  EXPECT_FALSE(fit_jaeger_and_matrix({}).ok);
}

// Weakest at 30 degrees: the fit runs to a plane without friction, which no rock has.
TEST(JaegerFit, AFitAtTheEndOfItsRangeIsNoPlane) {
  std::vector<StrengthReading> weakest_at_30;
  const double ucs[] = {57, 50, 42, 48, 52, 61, 67};
  for (int i = 0; i < 7; ++i) weakest_at_30.push_back({15.0 * i, 1e6 * ucs[i], 0.0});
  for (const JaegerFit& fit : {fit_jaeger_and_matrix(weakest_at_30), fit_jaeger(weakest_at_30, 62e6)}) {
    ASSERT_TRUE(fit.ok);
    EXPECT_NE(fit.no_plane().find("phi_w = 0 degrees, the end of its range"), std::string::npos);
  }
  // weaker at 80 degrees than at 75: friction would have to be above 60
  const std::vector<StrengthReading> one_weak = {{0.0, 1e8, 0.0},  {30.0, 1e8, 0.0}, {60.0, 1e8, 0.0},
                                                 {70.0, 1e8, 0.0}, {75.0, 8e7, 0.0}, {80.0, 5e7, 0.0},
                                                 {90.0, 1e8, 0.0}};
  EXPECT_NE(fit_jaeger_and_matrix(one_weak).no_plane().find("phi_w = 60"), std::string::npos);
  EXPECT_EQ(fit_jaeger_and_matrix(rock_of(20e6, 0.5, 140e6)).no_plane(), "");
  EXPECT_EQ(fit_jaeger({}, 1e8).no_plane(), fit_jaeger({}, 1e8).reason);
}

// Over confining stresses too: a plane of 8 MPa and 25 degrees in Coulomb rock of 30 MPa and 40 degrees.
TEST(JaegerFit, FindsThePlaneOverConfiningStresses) {
  const Coulomb plane{8e6, 25.0};
  const auto matrix = [](double sigma_3) { return coulomb_sigma_1({30e6, 40.0}, sigma_3); };
  std::vector<StrengthReading> readings;
  for (const double sigma_3 : {0.0, 5e6, 20e6})
    for (const double theta : {0.0, 30.0, 45.0, 60.0, 75.0})
      readings.push_back({theta, jaeger_sigma_1(plane, matrix(sigma_3), theta, sigma_3), sigma_3});
  const JaegerFit fit = fit_jaeger(readings, matrix);
  ASSERT_TRUE(fit.ok) << fit.reason;
  EXPECT_NEAR(fit.plane.cohesion, plane.cohesion, 1e-4 * plane.cohesion);
  EXPECT_NEAR(fit.plane.friction, plane.friction, 1e-3);
}

}  // namespace
}  // namespace phy::theory
