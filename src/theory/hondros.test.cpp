// The closed form against Hondros's Fourier series, against the equilibrium of half discs, and against point
// loads.
#include "theory/hondros.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/exact_math.hpp"

namespace phy::theory {
namespace {

const BrazilianDisc disc{0.05, 0.025, 8.0, 9e3};
double pressure(const BrazilianDisc& d) {
  return d.P / (d.diameter * d.thickness * std::sin(d.alpha * pi / 180.0));
}

struct Polar {
  double radial, hoop;
};

// Fourier series of the uniform radial pressure on two arcs; phi from the load axis, compression positive.
Polar series(const BrazilianDisc& d, double rho, double phi) {
  const double a = d.alpha * pi / 180.0;
  Polar s{a, a};
  for (int n = 1; n < 4000; ++n) {
    const double common = std::pow(rho, 2 * n - 2) * std::sin(2.0 * n * a) * std::cos(2.0 * n * phi);
    s.radial += (1.0 - (1.0 - 1.0 / n) * rho * rho) * common;
    s.hoop -= (1.0 - (1.0 + 1.0 / n) * rho * rho) * common;
  }
  const double scale = 2.0 * pressure(d) / pi;
  return {scale * s.radial, scale * s.hoop};
}

TEST(Hondros, ClosedFormIsTheSumOfTheSeries) {
  for (double rho : {0.0, 0.2, 0.5, 0.8, 0.97}) {
    const Polar on = series(disc, rho, 0.0);
    const DiameterStress loaded = hondros_loaded_diameter(disc, rho);
    EXPECT_NEAR(loaded.sigma_y / pressure(disc), on.radial / pressure(disc), 1e-12) << rho;
    EXPECT_NEAR(loaded.sigma_x / pressure(disc), on.hoop / pressure(disc), 1e-12) << rho;
    const Polar off = series(disc, rho, 0.5 * pi);
    const DiameterStress cross = hondros_cross_diameter(disc, rho);
    EXPECT_NEAR(cross.sigma_x / pressure(disc), off.radial / pressure(disc), 1e-12) << rho;
    EXPECT_NEAR(cross.sigma_y / pressure(disc), off.hoop / pressure(disc), 1e-12) << rho;
  }
}

double simpson(const std::function<double(double)>& f, double from, double to, int n) {
  const double h = (to - from) / n;
  double sum = f(from) + f(to);
  for (int i = 1; i < n; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(from + i * h);
  return sum * h / 3.0;
}

TEST(Hondros, HalfDiscsAreInEquilibrium) {
  const double R = 0.5 * disc.diameter;
  const double a = disc.alpha * pi / 180.0;
  const double along =
      simpson([](double r) { return hondros_cross_diameter(disc, r).sigma_y; }, -1.0, 1.0, 2000);
  EXPECT_NEAR(along * R * disc.thickness / disc.P, 1.0, 1e-10);
  // The right half is pushed to the left by half of each arc: 2 p R (1 - cos alpha) per thickness.
  const double across =
      simpson([](double r) { return hondros_loaded_diameter(disc, r).sigma_x; }, -1.0, 1.0, 20000);
  EXPECT_NEAR(across * R, 2.0 * pressure(disc) * R * (1.0 - std::cos(a)), 1e-8 * pressure(disc) * R);
}

TEST(Hondros, SurfaceCarriesThePressureAndIsFreeElsewhere) {
  EXPECT_NEAR(hondros_loaded_diameter(disc, 1.0).sigma_y / pressure(disc), 1.0, 1e-13);
  EXPECT_NEAR(hondros_cross_diameter(disc, 1.0).sigma_x / pressure(disc), 0.0, 1e-13);
  EXPECT_DOUBLE_EQ(hondros_loaded_diameter(disc, 0.3).sigma_x, hondros_loaded_diameter(disc, -0.3).sigma_x);
}

TEST(Hondros, NarrowArcsApproachPointLoads) {
  double previous = 1.0;
  for (double alpha : {8.0, 4.0, 2.0, 1.0}) {
    BrazilianDisc d = disc;
    d.alpha = alpha;
    const double s = brazilian_strength(d.P, d.diameter, d.thickness);
    double worst = 0.0;
    for (double rho : {0.0, 0.25, 0.5}) {
      worst = std::max(
          worst,
          std::abs(hondros_loaded_diameter(d, rho).sigma_x - point_load_loaded_diameter(d, rho).sigma_x) / s);
      worst = std::max(
          worst,
          std::abs(hondros_loaded_diameter(d, rho).sigma_y - point_load_loaded_diameter(d, rho).sigma_y) / s);
      worst = std::max(
          worst,
          std::abs(hondros_cross_diameter(d, rho).sigma_x - point_load_cross_diameter(d, rho).sigma_x) / s);
      worst = std::max(
          worst,
          std::abs(hondros_cross_diameter(d, rho).sigma_y - point_load_cross_diameter(d, rho).sigma_y) / s);
    }
    EXPECT_LT(worst, 0.3 * previous) << alpha;  // the error falls with alpha squared
    previous = worst;
  }
  EXPECT_LT(previous, 0.01);
}

TEST(Hondros, CentreOfTheDisc) {
  const double s = brazilian_strength(disc.P, disc.diameter, disc.thickness);
  EXPECT_NEAR(s, 2.0 * 9e3 / (pi * 0.05 * 0.025), 1e-6);
  EXPECT_NEAR(point_load_loaded_diameter(disc, 0.0).sigma_y / s, 3.0, 1e-14);
  EXPECT_NEAR(hondros_cross_diameter(disc, 0.0).sigma_x, hondros_loaded_diameter(disc, 0.0).sigma_x, 1e-6);
  EXPECT_NEAR(hondros_cross_diameter(disc, 0.0).sigma_y, hondros_loaded_diameter(disc, 0.0).sigma_y, 1e-6);
}

}  // namespace
}  // namespace phy::theory
