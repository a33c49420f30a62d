// Stress intensity from movements: known fields are found again, the compliance of a lattice is its closed
// form.
#include "statics/crack_tip.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "records/assembly.hpp"

namespace phy::statics {
namespace {

constexpr double R = 2.5e-4;
constexpr double pi = std::numbers::pi;
const double root3 = std::sqrt(3.0);

/// Plane strain-like isotropic body: E' and nu' of the plane.
Compliance isotropic(double E, double nu) {
  return {{{1.0 / E, -nu / E, 0.0}, {-nu / E, 1.0 / E, 0.0}, {0.0, 0.0, 2.0 * (1.0 + nu) / E}}};
}

/// Discs around the origin, no contacts.
Network places() {
  const Specimen s = assembly(hexagonal(60, 70, R), soft_contact());
  Network net = make_network(s);
  for (Vec2& x : net.x) x = x - Vec2{60.0 * R, 60.0 * R};
  return net;
}

// Irwin's field of an isotropic body, kappa = (3 - nu)/(1 + nu) of the plane, with a rigid movement beside
// it; the crack points up or along x.
TEST(CrackTip, FindsTheFieldOfAnIsotropicBody) {
  const Network net = places();
  const double E = 50e9, nu = 0.3, G = 0.5 * E / (1.0 + nu), kappa = (3.0 - nu) / (1.0 + nu);
  const double K_I = 1.3e6, K_II = -0.4e6;
  for (const Vec2 ahead : {Vec2{0.0, 1.0}, Vec2{1.0, 0.0}, Vec2{0.6, -0.8}}) {
    const Vec2 across = tangent(ahead);
    Movements u(3 * net.x.size(), 0.0);
    for (std::size_t i = 0; i < net.n_grains; ++i) {
      const double x = dot(net.x[i], ahead), y = dot(net.x[i], across);
      const double r = std::hypot(x, y), t = std::atan2(y, x), c = std::cos(0.5 * t), s = std::sin(0.5 * t);
      const double f = std::sqrt(0.5 * r / pi) / (2.0 * G);
      const double u_1 = f * (K_I * c * (kappa - 1.0 + 2.0 * s * s) + K_II * s * (kappa + 1.0 + 2.0 * c * c));
      const double u_2 = f * (K_I * s * (kappa + 1.0 - 2.0 * c * c) - K_II * c * (kappa - 1.0 - 2.0 * s * s));
      const Vec2 v = u_1 * ahead + u_2 * across + Vec2{1e-6 + 1e-4 * net.x[i].y, 2e-6 - 1e-4 * net.x[i].x};
      u[3 * i] = v.x, u[3 * i + 1] = v.y;
    }
    const StressIntensity K =
        stress_intensity(net, u, {{0.0, 0.0}, ahead, 4.0 * R, 40.0 * R}, isotropic(E, nu));
    // 1e-4: the double root of an isotropic body is told apart by 1e-3.
    EXPECT_NEAR(K.K_I, K_I, 1e-4 * K_I);
    EXPECT_NEAR(K.K_II, K_II, 1e-4 * K_I);
    EXPECT_LT(K.residual, 1e-4);
  }
}

// An orthotropic body: Sih, Paris & Irwin's energy release rate, G = K_I^2 sqrt(S11 S22/2) sqrt(sqrt(S22/S11)
// + (2 S12 + S66)/(2 S11)), closes the crack that K_I opens: u_2 on a flank = 4 G/K_I sqrt(r/(2 pi)). Here
// the other way round: a field made of the two roots with a given opening and free flanks.
TEST(CrackTip, FindsTheFieldOfAnOrthotropicBody) {
  const Network net = places();
  const double S11 = 1.0 / 60e9, S22 = 1.0 / 20e9, S12 = -0.2 / 60e9, S66 = 1.0 / 10e9;
  const Compliance S = {{{S11, S12, 0.0}, {S12, S22, 0.0}, {0.0, 0.0, S66}}};
  // mu = i b: S11 b^4 - (2 S12 + S66) b^2 + S22 = 0
  const double half = 0.5 * (2.0 * S12 + S66) / S11, root = std::sqrt(half * half - S22 / S11);
  const double b[2] = {std::sqrt(half + root), std::sqrt(half - root)};
  const double K_I = 0.8e6;
  Movements u(3 * net.x.size(), 0.0);
  for (std::size_t i = 0; i < net.n_grains; ++i) {
    for (int k = 0; k < 2; ++k) {
      // z^(1/2) = rho^(1/2) (cos + i sin)(phi/2); c_1 + c_2 = K_I/sqrt(2 pi), b_1 c_1 + b_2 c_2 = 0
      const double y = b[k] * net.x[i].y, rho = std::hypot(net.x[i].x, y), phi = std::atan2(y, net.x[i].x);
      const double c = K_I / std::sqrt(2.0 * pi) * b[1 - k] / (b[1 - k] - b[k]);
      u[3 * i] += 2.0 * c * (S12 - S11 * b[k] * b[k]) * std::sqrt(rho) * std::cos(0.5 * phi);
      u[3 * i + 1] -= 2.0 * c * (S12 * b[k] - S22 / b[k]) * std::sqrt(rho) * std::sin(0.5 * phi);
    }
  }
  const StressIntensity K = stress_intensity(net, u, {{0.0, 0.0}, {1.0, 0.0}, 4.0 * R, 40.0 * R}, S);
  EXPECT_NEAR(K.K_I, K_I, 1e-9 * K_I);
  EXPECT_NEAR(K.K_II, 0.0, 1e-9 * K_I);
  EXPECT_LT(K.residual, 1e-9);
  const double G = K_I * K_I * std::sqrt(0.5 * S11 * S22) *
                   std::sqrt(std::sqrt(S22 / S11) + 0.5 * (2.0 * S12 + S66) / S11);
  // Opening of the flank at r, from the same roots: 2 c_k (S22/b_k - S12 b_k) sqrt(r).
  double opening = 0.0;
  for (int k = 0; k < 2; ++k)
    opening += 2.0 * K_I / std::sqrt(2.0 * pi) * b[1 - k] / (b[1 - k] - b[k]) * (S22 / b[k] - S12 * b[k]);
  EXPECT_NEAR(opening, 4.0 * G / K_I / std::sqrt(2.0 * pi), 1e-9 * opening);
}

// E = 2 sqrt3 K_n (K_n + K_s)/(3 K_n + K_s), nu = (K_n - K_s)/(3 K_n + K_s) of the lattice (V1). The window
// cuts through grains at its edge, which counts a row of contacts more or less: 2 R over its size.
TEST(CrackTip, ComplianceOfALattice) {
  Specimen s = assembly(hexagonal(60, 70, R), soft_contact());
  bond_touching(s);
  const double n = s.matrix.E_c + s.matrix.E_b;
  const double t = s.matrix.E_c * s.matrix.ks_over_kn + s.matrix.E_b * s.matrix.bond_ks_over_kn;
  // A whole number of lattice constants across, 2 R and 2 sqrt3 R.
  const Window w{{20.1 * R, 10.2 * root3 * R}, {100.1 * R, 58.2 * root3 * R}};
  const EffectiveCompliance found =
      effective_compliance(make_network(s), std::span(&w, 1), 4.0 * R, {0.0, 1.0});
  ASSERT_TRUE(found.outcome.ok()) << found.outcome.reason;
  const double E = 2.0 * root3 * n * (n + t) / (3.0 * n + t), nu = (n - t) / (3.0 * n + t);
  EXPECT_NEAR(found.S[0][0] * E, 1.0, 1e-6);
  EXPECT_NEAR(found.S[1][1] * E, 1.0, 1e-6);
  EXPECT_NEAR(found.S[0][1] * E, -nu, 1e-6);
  EXPECT_NEAR(found.S[2][2] * E, 2.0 * (1.0 + nu), 1e-6);
  EXPECT_NEAR(found.S[0][2] * E, 0.0, 1e-6);
}

}  // namespace
}  // namespace phy::statics
