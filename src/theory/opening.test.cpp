// Stress around a hole against what it must obey: its wall, far away, equilibrium, strains that fit together,
// and published values at the wall.
#include "theory/opening.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <vector>

#include "base/exact_math.hpp"
#include "theory/anisotropic_roots.hpp"

namespace phy::theory {
namespace {

constexpr double R = 0.02;
const Opening skew{R, {12e6, 30e6, -7e6}, 4e6};
const TransverseIsotropy shale{38e9, 19e9, 0.21, 0.16, 7e9};
const std::array<double, 7> angles = {0.0, 20.0, 75.0, 90.0, 163.0, 211.0, 300.0};

using Field = std::function<StressInPlane(double, double)>;
struct Body {
  const char* name;
  PlaneCompliance S;
  Field stress;
  std::function<double(double, Loaded)> closure;
};

TransverseIsotropy isotropic(double E, double nu) { return {E, E, nu, nu, 0.5 * E / (1.0 + nu)}; }

Body anisotropic_body(const char* name, const PlaneCompliance& S, const Opening& opening) {
  const AnisotropicOpening a(S, opening);
  return {name, S, [a](double x, double y) { return a.at(x, y); },
          [a](double angle, Loaded when) { return a.closure(angle, when); }};
}

std::vector<Body> bodies(const Opening& o) {
  const PlaneCompliance rock = plane_compliance(isotropic(40e9, 0.25), PlaneState::stress);
  const PlaneCompliance beds = plane_compliance(shale, PlaneState::strain);
  return {{"Kirsch", rock, [o](double x, double y) { return kirsch(o, x, y); },
           [o](double angle, Loaded when) {
             return kirsch_closure(o, {40e9, 0.25}, angle, when);
           }},
          anisotropic_body("isotropic", rock, o),
          anisotropic_body("beds", beds, o),
          anisotropic_body("inclined beds", rotated(beds, 35.0), o)};
}

PolarStress at_polar(const Field& f, double r, double angle) {
  const double a = angle * pi / 180.0;
  return polar(f(r * std::cos(a), r * std::sin(a)), angle);
}

TEST(Opening, PolarTurnsTheAxes) {
  const PolarStress s = polar({5.0, 1.0, 2.0}, 90.0);
  EXPECT_DOUBLE_EQ(s.radial, 1.0);
  EXPECT_DOUBLE_EQ(s.hoop, 5.0);
  EXPECT_DOUBLE_EQ(s.shear, -2.0);
  // Pure shear is tension and compression along the diagonals.
  EXPECT_NEAR(polar({0.0, 0.0, 1.0}, 45.0).radial, 1.0, 1e-15);
  EXPECT_NEAR(polar({0.0, 0.0, 1.0}, 45.0).hoop, -1.0, 1e-15);
}

TEST(Opening, WallCarriesThePressureAndNothingElse) {
  for (const Body& body : bodies(skew))
    for (const double angle : angles) {
      const PolarStress s = at_polar(body.stress, R, angle);
      EXPECT_NEAR(s.radial, 4e6, 1.0) << body.name << " " << angle;
      EXPECT_NEAR(s.shear, 0.0, 1.0) << body.name << " " << angle;
    }
}

TEST(Opening, FarAwayTheHoleIsForgotten) {
  for (const Body& body : bodies(skew))
    for (const double angle : angles) {
      const double a = angle * pi / 180.0, r = 1e4 * R;
      const StressInPlane s = body.stress(r * std::cos(a), r * std::sin(a));
      EXPECT_NEAR(s.x, 12e6, 10.0) << body.name;
      EXPECT_NEAR(s.y, 30e6, 10.0) << body.name;
      EXPECT_NEAR(s.xy, -7e6, 10.0) << body.name;
    }
}

/// Derivatives by differences of fourth order, of a scalar along a step.
double first(const std::function<double(double)>& f, double h) {
  return (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
}
double second(const std::function<double(double)>& f, double h) {
  return (16.0 * (f(h) + f(-h)) - (f(2.0 * h) + f(-2.0 * h)) - 30.0 * f(0.0)) / (12.0 * h * h);
}

TEST(Opening, StressesAreInEquilibrium) {
  constexpr double h = 1e-3 * R;
  for (const Body& body : bodies(skew))
    for (const double angle : angles) {
      const double a = angle * pi / 180.0, x = 1.2 * R * std::cos(a), y = 1.2 * R * std::sin(a);
      const auto along_x = [&](double d) { return body.stress(x + d, y); };
      const auto along_y = [&](double d) { return body.stress(x, y + d); };
      const double in_x = first([&](double d) { return along_x(d).x; }, h) +
                          first([&](double d) { return along_y(d).xy; }, h);
      const double in_y = first([&](double d) { return along_x(d).xy; }, h) +
                          first([&](double d) { return along_y(d).y; }, h);
      // One derivative alone is of the order 1e9 Pa/m.
      EXPECT_NEAR(in_x, 0.0, 100.0) << body.name << " " << angle;
      EXPECT_NEAR(in_y, 0.0, 100.0) << body.name << " " << angle;
    }
}

TEST(Opening, StrainsFitTogether) {
  constexpr double h = 4e-3 * R;
  for (const Body& body : bodies(skew)) {
    const PlaneCompliance& S = body.S;
    const auto xx = [&](const StressInPlane& s) { return S.S_xx * s.x + S.S_xy * s.y + S.S_xs * s.xy; };
    const auto yy = [&](const StressInPlane& s) { return S.S_xy * s.x + S.S_yy * s.y + S.S_ys * s.xy; };
    const auto xy = [&](const StressInPlane& s) { return S.S_xs * s.x + S.S_ys * s.y + S.S_ss * s.xy; };
    for (const double angle : angles) {
      const double a = angle * pi / 180.0, x = 1.3 * R * std::cos(a), y = 1.3 * R * std::sin(a);
      const double bend_x = second([&](double d) { return xx(body.stress(x, y + d)); }, h);
      const double bend_y = second([&](double d) { return yy(body.stress(x + d, y)); }, h);
      const double twist = first(
          [&](double d) { return first([&](double e) { return xy(body.stress(x + d, y + e)); }, h); }, h);
      const double size = 30e6 * (S.S_xx + S.S_yy) / (R * R);
      EXPECT_NEAR((bend_x + bend_y - twist) / size, 0.0, 1e-6) << body.name << " " << angle;
    }
  }
}

// From the strains of polar axes, u the inward motion of the wall: u'' + u = R (gamma' + eps_r - R d
// eps_hoop/dr), primes along the angle. It leaves a body's translation open, which symmetry forbids.
TEST(Opening, WallMovesAsTheStrainsBehindItSay) {
  for (const Body& body : bodies(skew))
    for (const double angle : angles) {
      const auto strains = [&](double r, double turn) {
        const PolarStress s = at_polar(body.stress, r, angle + turn);
        const PlaneCompliance S = rotated(body.S, -(angle + turn));
        return std::array<double, 3>{S.S_xx * s.radial + S.S_xy * s.hoop + S.S_xs * s.shear,
                                     S.S_xy * s.radial + S.S_yy * s.hoop + S.S_ys * s.shear,
                                     S.S_xs * s.radial + S.S_ys * s.hoop + S.S_ss * s.shear};
      };
      constexpr double degree = pi / 180.0, h = 1e-4;
      const double shear_rate = first([&](double t) { return strains(R, t)[2]; }, 0.05) / degree;
      const double outer = strains(R * (1.0 + 2.0 * h), 0.0)[1], middle = strains(R * (1.0 + h), 0.0)[1];
      const double hoop_rate = (4.0 * middle - outer - 3.0 * strains(R, 0.0)[1]) / (2.0 * h);
      const auto u = [&](double t) { return body.closure(angle + t, Loaded::with_hole); };
      const double left = second(u, 0.5) / (degree * degree) + u(0.0);
      const double right = R * (shear_rate + strains(R, 0.0)[0] - hoop_rate);
      EXPECT_NEAR(left / R, right / R, 1e-8) << body.name << " " << angle;  // strains are of the order 1e-3
    }
}

// Cutting a hole from which nothing was carried moves its wall by the strain of the body less.
TEST(Opening, OrderOfLoadAndHoleIsTheUniformStrain) {
  for (const Body& body : bodies(skew))
    for (const double angle : angles) {
      const PolarStress s = polar(skew.far, angle);
      const PlaneCompliance S = rotated(body.S, -angle);
      const double strain = S.S_xx * s.radial + S.S_xy * s.hoop + S.S_xs * s.shear;
      EXPECT_NEAR(body.closure(angle, Loaded::with_hole) - body.closure(angle, Loaded::before_hole),
                  R * strain, 1e-9 * R)
          << body.name;
    }
}

TEST(Opening, KirschIsThreeAndMinusOne) {
  const Opening pressed{R, {0.0, 1.0, 0.0}, 0.0};
  EXPECT_NEAR(kirsch(pressed, R, 0.0).y, 3.0, 1e-14);
  EXPECT_NEAR(kirsch(pressed, 0.0, -R).x, -1.0, 1e-14);
  // Equal stresses: twice the stress all round; a wall under that pressure feels no hole.
  EXPECT_NEAR(at_polar(
                  [](double x, double y) {
                    return kirsch({R, {1.0, 1.0, 0.0}, 0.0}, x, y);
                  },
                  R, 77.0)
                  .hoop,
              2.0, 1e-13);
  EXPECT_NEAR(kirsch({R, {1.0, 1.0, 0.0}, 1.0}, 0.0, 1.7 * R).x, 1.0, 1e-14);
}

// Lekhnitskii's values where an orthotropic body is loaded along an axis of its own.
TEST(Opening, OrthotropicWallHasThePublishedConcentrations) {
  const double E_1 = shale.E, E_2 = shale.E_n, nu_12 = shale.nu_n * E_1 / E_2, G = shale.G_n;
  const AnisotropicOpening along(plane_compliance(shale, PlaneState::stress), {R, {1.0, 0.0, 0.0}, 0.0});
  EXPECT_NEAR(along.at(0.0, R).x, 1.0 + std::sqrt(2.0 * (std::sqrt(E_1 / E_2) - nu_12) + E_1 / G), 1e-9);
  EXPECT_NEAR(along.at(R, 0.0).y, -std::sqrt(E_2 / E_1), 1e-9);
  const AnisotropicOpening across(plane_compliance(shale, PlaneState::stress), {R, {0.0, 1.0, 0.0}, 0.0});
  EXPECT_NEAR(across.at(R, 0.0).y, 1.0 + std::sqrt(2.0 * (std::sqrt(E_2 / E_1) - shale.nu_n) + E_2 / G),
              1e-9);
  EXPECT_NEAR(across.at(0.0, R).x, -std::sqrt(E_1 / E_2), 1e-9);
}

// Hoop stress at the wall under pressure alone, as M.H. Sadd, "Elasticity", prints it (tension positive).
TEST(Opening, WallUnderPressureHasTheTextbookHoop) {
  using Complex = std::complex<double>;
  const Complex i{0.0, 1.0};
  const PlaneCompliance S = rotated(plane_compliance(shale, PlaneState::stress), 25.0);
  const auto [a, b] = anisotropic_roots(S);
  const Body body = anisotropic_body("", S, {R, {}, 1.0});
  for (const double angle : angles) {
    const double c = std::cos(angle * pi / 180.0), s = std::sin(angle * pi / 180.0);
    const Complex sum = (a * b - i * a - i * b) * s * s * s + i * (a * b - 2.0) * s * s * c +
                        (2.0 * a * b - 1.0) * s * c * c + (a + b - i) * c * c * c;
    const double hoop = (i * Complex(c, -s) / ((s - a * c) * (s - b * c)) * sum).real();
    EXPECT_NEAR(at_polar(body.stress, R, angle).hoop, -hoop, 1e-9) << angle;
  }
}

TEST(Opening, TurnedBedsUnderATurnedLoadAreTheTurnedPicture) {
  const PlaneCompliance beds = plane_compliance(shale, PlaneState::stress);
  const AnisotropicOpening level(beds, skew);
  for (const double theta : {30.0, 90.0, 128.0}) {
    const PolarStress far = polar(skew.far, -theta);
    const Opening turned{R, {far.radial, far.hoop, far.shear}, skew.pressure};
    const AnisotropicOpening inclined(rotated(beds, theta), turned);
    for (const double angle : angles) {
      const PolarStress a = at_polar([&](double x, double y) { return level.at(x, y); }, 1.4 * R, angle);
      const PolarStress b =
          at_polar([&](double x, double y) { return inclined.at(x, y); }, 1.4 * R, angle + theta);
      EXPECT_NEAR(a.radial, b.radial, 1.0);
      EXPECT_NEAR(a.hoop, b.hoop, 1.0);
      EXPECT_NEAR(a.shear, b.shear, 1.0);
      EXPECT_NEAR(level.closure(angle, Loaded::before_hole),
                  inclined.closure(angle + theta, Loaded::before_hole), 1e-9 * R);
    }
  }
}

/// Largest difference from Kirsch's stress on a ring, over the stress far away.
double from_kirsch(double anisotropy) {
  TransverseIsotropy m = isotropic(40e9, 0.25);
  m.E_n /= 1.0 + anisotropy;
  const AnisotropicOpening a(rotated(plane_compliance(m, PlaneState::stress), 20.0), skew);
  double worst = 0.0;
  for (double angle = 0.0; angle < 360.0; angle += 5.0) {
    const double x = 1.1 * R * std::cos(angle * pi / 180.0), y = 1.1 * R * std::sin(angle * pi / 180.0);
    const StressInPlane s = a.at(x, y), k = kirsch(skew, x, y);
    worst = std::max({worst, std::abs(s.x - k.x), std::abs(s.y - k.y), std::abs(s.xy - k.xy)});
  }
  return worst / 30e6;
}

TEST(Opening, IsKirschsAsAnisotropyVanishes) {
  double before = from_kirsch(0.1);
  EXPECT_GT(before, 0.01);
  for (const double anisotropy : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const double now = from_kirsch(anisotropy);
    EXPECT_NEAR(now / before, 0.1, 0.015) << anisotropy;  // no step where roots are held apart
    before = now;
  }
  EXPECT_LT(from_kirsch(0.0), 3e-8);
}

// Equal roots that are not i: the body of Kirsch, stretched.
TEST(Opening, EqualRootsOfAnAnisotropicBodyAreNoSpecialCase) {
  TransverseIsotropy m = shale;
  m.G_n = 1.0 / (2.0 / std::sqrt(m.E * m.E_n) + 2.0 * m.nu_n / m.E_n);
  const AnisotropicOpening equal(plane_compliance(m, PlaneState::stress), skew);
  m.G_n *= 1.0 + 1e-5;  // roots apart by far more than any that are moved
  const AnisotropicOpening near(plane_compliance(m, PlaneState::stress), skew);
  for (const double angle : angles) {
    const auto hoop = [&](const AnisotropicOpening& o) {
      return at_polar([&](double x, double y) { return o.at(x, y); }, R, angle).hoop;
    };
    EXPECT_NEAR(hoop(equal) / 30e6, hoop(near) / 30e6, 2e-5) << angle;
    EXPECT_NE(hoop(equal), hoop(near));
  }
}

}  // namespace
}  // namespace phy::theory
