// Closed forms of an interface of length 2R, derived here, and sums over thin slices where there is none.
//   E = 76 GPa over R1 + R2 = 0.66 mm: k_n = 1.1515e14 Pa/m, k_s = 0.3 k_n, R = 0.3 mm
//   sigma_c = 20 MPa, c = 100 MPa, mu = 0.5
#include "laws/flat_joint/flat_joint.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/rng.hpp"

namespace phy::laws {
namespace {

constexpr double k_n = 76e9 / 0.66e-3, k_s = 0.3 * k_n, R = 3e-4, sigma_c = 20e6, cohesion = 100e6, mu = 0.5;
constexpr double A = 2.0 * R, I = 2.0 / 3.0 * R * R * R;

flat_joint::Parameters<double> rock(double tan_phi = 0.0, double edge = 0.0) {
  return {k_n * A, k_s * A, 1.0 / (k_s * A), R, mu, cohesion * A, tan_phi, edge, sigma_c * A, 0.0};
}

template <int N>
struct Interface {
  static constexpr int elements = N;
  flat_joint::Parameters<double> p = rock();
  flat_joint::State<double, N> s{flat_joint::whole<N>, 0.0, {}};
  flat_joint::Cracks<double, N> cracks{};
  Motion<double> at{0.0, 0.0, 0.0, 0.0};
  Reaction<double> r{};
  double dissipated = 0.0, released = 0.0;
  int n_cracks = 0;

  void go(double d_closure, double d_slide, double d_rotation) {
    to(at.closure + d_closure, d_slide, at.rotation + d_rotation);
  }
  void to(double closure, double d_slide, double rotation) {
    at = {closure, closure - at.closure, d_slide, rotation, rotation - at.rotation};
    r = flat_joint::respond<N, double>(p, s, at, cracks);
    dissipated += r.dissipated, released += r.released;
    if (!cracks.some) return;
    for (int e = 0; e < N; ++e) n_cracks += cracks.tension[e] || cracks.shear[e] ? 1 : 0;
  }
  double energy() const { return flat_joint::strain_energy<N, double>(p, s, at); }
  bool bonded(int e) const { return (static_cast<int>(s.bonds) >> e & 1) != 0; }
  /// Turns it at a given normal force: where that is balanced by the bonds that hold, until none breaks
  /// there.
  void hold(double F_n, double rotation) {
    const int before = n_cracks;
    double low = -2e-4, high = 2e-4;
    for (int i = 0; i < 100; ++i) {
      auto trial = *this;
      trial.p.extra_strength = 1e30;
      trial.to(0.5 * (low + high), 0.0, rotation);
      (trial.r.F_n < F_n ? low : high) = trial.at.closure;
    }
    to(0.5 * (low + high), 0.0, rotation);
    if (n_cracks > before) hold(F_n, rotation);
  }
};

template <class Check>
void for_all_divisions(const Check& check) {
  check(Interface<1>{}), check(Interface<2>{}), check(Interface<3>{}), check(Interface<4>{});
}

/// The same by 240,000 slices: F_n, M and energy of stresses that bonded elements carry both ways.
template <int N>
std::array<double, 3> by_slices(const Interface<N>& i) {
  constexpr int n = 240000;
  std::array<double, 3> sum{};
  for (int k = 0; k < n; ++k) {
    const double x = R * ((2.0 * k + 1.0) / n - 1.0), c = i.at.closure + i.at.rotation * x;
    const double pressed = i.bonded(k * N / n) ? c : std::max(c, 0.0), dF = k_n * pressed * A / n;
    sum[0] += dF, sum[1] -= dF * x, sum[2] += 0.5 * dF * pressed;
  }
  return sum;
}

TEST(FlatJoint, WholeIsAParallelBondOfItsLength) {
  for_all_divisions([](auto i) {
    i.to(1e-8, 2e-7, 1e-4);
    EXPECT_NEAR(i.r.F_n, k_n * A * 1e-8, 1e-12 * i.r.F_n);
    EXPECT_NEAR(i.r.F_s, -k_s * A * 2e-7, 1e-12 * k_s * A * 2e-7);
    EXPECT_NEAR(i.r.M, -k_n * I * 1e-4, 1e-12 * k_n * I * 1e-4);
    const double U = 0.5 * (k_n * A * 1e-16 + k_s * A * 4e-14 + k_n * I * 1e-8);
    EXPECT_NEAR(i.energy(), U, 1e-12 * U);
  });
}

// All elements at the stress sigma_c at once; released is what springs of 2R sigma_c hold.
TEST(FlatJoint, PulledApartAlongItsAxis) {
  for_all_divisions([](auto i) {
    const double opening = sigma_c / k_n;
    i.to(-0.999999 * opening, 0.0, 0.0);
    EXPECT_NEAR(i.r.F_n, -12000.0, 0.02);
    EXPECT_EQ(i.n_cracks, 0);
    i.to(-1.000001 * opening, 0.0, 0.0);
    EXPECT_EQ(i.n_cracks, i.elements);
    EXPECT_TRUE(i.r.broke_tension);
    EXPECT_EQ(i.r.F_n, 0.0);
    EXPECT_NEAR(i.released, sigma_c * sigma_c * R / k_n, 1e-5 * i.released);
    EXPECT_EQ(i.energy(), 0.0);
    i.to(0.0, 0.0, 0.0);
    EXPECT_EQ(i.r.F_n, 0.0) << "it closes where it opened";
    i.to(1e-8, 0.0, 0.0);
    EXPECT_NEAR(i.r.F_n, k_n * A * 1e-8, 1e-9);
  });
}

// |S| = 2R (c + p tan phi), and mu p 2R is left; none under tension.
TEST(FlatJoint, ShearedAtConstantNormalStress) {
  const double tan_phi = std::tan(std::numbers::pi / 6.0);
  for (const double p : {0.0, 50e6, -10e6})
    for_all_divisions([&](auto i) {
      i.p = rock(tan_phi);
      i.to(p / k_n, 0.0, 0.0);
      const double peak = A * (cohesion + p * tan_phi), slide = peak / (k_s * A);
      i.go(0.0, 0.999999 * slide, 0.0);
      EXPECT_NEAR(i.r.F_s, -peak, 2e-6 * peak);
      i.go(0.0, 2e-6 * slide, 0.0);
      EXPECT_TRUE(i.r.broke_shear);
      EXPECT_EQ(i.n_cracks, i.elements);
      EXPECT_NEAR(i.r.F_s, -mu * std::max(p, 0.0) * A, 1e-9 * peak);
    });
}

// The outermost element has its centre at R (1 - 1/N), where the stress is M x/I; what is left of the moment
// when it has gone is the sum over the slices that hold.
TEST(FlatJoint, BentUntilItsOutermostElementBreaks) {
  for_all_divisions([](auto i) {
    const double N = i.elements, x = R * (1.0 - 1.0 / N);
    if (i.elements == 1) {
      i.to(0.0, 0.0, 1.0);
      EXPECT_EQ(i.n_cracks, 0) << "bending has no mean stress";
      return;
    }
    const double theta = sigma_c / (k_n * x), M = 2.0 / 3.0 * sigma_c * R * R / (1.0 - 1.0 / N);
    i.to(0.0, 0.0, 0.999999 * theta);
    EXPECT_NEAR(i.r.M, -M, 2e-6 * M);
    i.to(0.0, 0.0, 1.000001 * theta);
    EXPECT_EQ(i.n_cracks, 1);
    EXPECT_FALSE(i.bonded(0)) << "positive rotation opens at negative x";
    const auto slices = by_slices(i);
    EXPECT_NEAR(i.r.M, slices[1], 1e-6 * M);
    EXPECT_NEAR(i.energy(), slices[2], 1e-6 * slices[2]);
  });
}

// An unbonded interface under the force P: it stays closed up to theta_0 = P/(2 k_n R^2), where its edge is
// free of stress (M = k_n I theta = P R/3). Beyond, the stress is a triangle over the length l, with
// P = k_n theta l^2/2, and acts l/3 from the closed edge: M = P (R - l/3), l = 2R sqrt(theta_0/theta).
TEST(FlatJoint, OpensUnderBending) {
  const double P = 20e3, theta_0 = P / (2.0 * k_n * R * R);
  for_all_divisions([&](auto i) {
    i.s.bonds = 0.0;
    for (const double turn : {0.3, 1.0, 1.5, 3.0, 10.0, 100.0}) {
      const double theta = turn * theta_0, l = A / std::sqrt(turn);
      i.hold(P, theta);
      const double M = turn <= 1.0 ? k_n * I * theta : P * (R - l / 3.0);
      EXPECT_NEAR(i.r.M, -M, 1e-11 * M) << turn;
      i.hold(P, -theta);
      EXPECT_NEAR(i.r.M, M, 1e-11 * M) << turn;
    }
  });
}

// Turned without normal force: every break happens where the pull at the centre of the next element is
// sigma_c. The axis is found by hand from the elements that hold and the stress that the broken ones press
// with.
TEST(FlatJoint, BreaksElementByElement) {
  const auto turns = [](auto i, double until) {
    std::vector<double> at;
    for (double theta = 0.0; theta < until; theta += 1e-7) {
      const int before = i.n_cracks;
      i.hold(0.0, theta);
      if (i.n_cracks > before) at.push_back(theta);
    }
    return at;
  };
  // Two: pull k_n theta R/2; then one element alone turns about its centre for ever.
  const double theta = sigma_c / (k_n * R);
  const auto two = turns(Interface<2>{}, 3e-3), three = turns(Interface<3>{}, 3e-3);
  ASSERT_EQ(two.size(), 1u);
  EXPECT_NEAR(two[0], 2.0 * theta, 2e-7);
  // Three: pull k_n theta 2R/3; then two of them about the middle of their length, R/3 from each centre.
  ASSERT_EQ(three.size(), 2u);
  EXPECT_NEAR(three[0], 1.5 * theta, 2e-7);
  EXPECT_NEAR(three[1], 3.0 * theta, 2e-7);
  const auto four = turns(Interface<4>{}, 3e-3);  // 3R/4; then three, R/2; then two, R/4
  ASSERT_EQ(four.size(), 3u);
  EXPECT_NEAR(four[0], 4.0 / 3.0 * theta, 2e-7);
  EXPECT_NEAR(four[1], 2.0 * theta, 2e-7);
  EXPECT_NEAR(four[2], 4.0 * theta, 2e-7);
}

// At the edge the interface of one element is a parallel bond with beta = 1: sigma = 3 M/(2 R^2).
TEST(FlatJoint, BreaksAtAnEdge) {
  for_all_divisions([](auto i) {
    i.p = rock(0.0, 1.0);
    const double theta = sigma_c / (k_n * R);
    i.to(0.0, 0.0, 0.999999 * theta);
    EXPECT_EQ(i.n_cracks, 0);
    i.to(0.0, 0.0, 1.000001 * theta);
    EXPECT_EQ(i.n_cracks, 1);
  });
}

// Stiffness of what is left: lengths, first and second moments of the elements that hold; and differences of
// forces where part of an element is closed.
TEST(FlatJoint, TangentOfAPart) {
  Interface<3> i;
  i.s.bonds = 6.0;  // without the first: 2h of 3 at R/3 from the centre
  i.at = {-1e-8, 0.0, 0.0, 0.0};
  auto k = flat_joint::tangent<3, double>(i.p, i.s, i.at);
  EXPECT_NEAR(k.k_n, 2.0 / 3.0 * k_n * A, 1e-12 * k.k_n);
  EXPECT_NEAR(k.k_s, 2.0 / 3.0 * k_s * A, 1e-12 * k.k_s);
  EXPECT_NEAR(k.k_nm, 2.0 / 3.0 * k_n * A * R / 3.0, 1e-12 * k.k_nm);
  EXPECT_NEAR(k.k_m, k_n * (R * R * R + R * R * R / 27.0) / 3.0, 1e-12 * k.k_m);
  i.s.bonds = 2.0;
  k = flat_joint::tangent<3, double>(i.p, i.s, i.at);
  EXPECT_NEAR(k.k_m, k_n * I / 27.0, 1e-12 * k.k_m);
  EXPECT_EQ(k.k_nm, 0.0);
  i.s.bonds = 1.0;
  for (const double rotation : {-4e-4, 3e-4}) {
    const Motion<double> m{1e-8, 0.0, 0.0, rotation};
    i.at = m;
    k = flat_joint::tangent<3, double>(i.p, i.s, i.at);
    const double d = 1e-12, turn = 1e-8;
    const auto force = [&](double closure, double rotation_now) {
      auto moved = i;
      moved.to(closure, 0.0, rotation_now);
      return moved.r;
    };
    const auto up = force(m.closure + d, m.rotation), down = force(m.closure - d, m.rotation);
    const auto left = force(m.closure, m.rotation + turn), right = force(m.closure, m.rotation - turn);
    EXPECT_NEAR((up.F_n - down.F_n) / (2 * d), k.k_n, 1e-6 * k.k_n);
    EXPECT_NEAR(-(up.M - down.M) / (2 * d), k.k_nm, 1e-6 * std::fabs(k.k_nm));
    EXPECT_NEAR((left.F_n - right.F_n) / (2 * turn), k.k_nm, 1e-6 * std::fabs(k.k_nm));
    EXPECT_NEAR(-(left.M - right.M) / (2 * turn), k.k_m, 1e-6 * k.k_m);
  }
}

// However far it has opened, mu P is what friction carries.
TEST(FlatJoint, SlidesAtFrictionWhateverItsOpening) {
  const double P = 20e3, theta_0 = P / (2.0 * k_n * R * R);
  for_all_divisions([&](auto i) {
    i.s.bonds = 0.0;
    for (const double turn : {0.0, 0.5, 2.0, 20.0}) {
      i.hold(P, turn * theta_0);
      i.go(0.0, 1e-5, 0.0);
      EXPECT_NEAR(i.r.F_s, -mu * P, 1e-9 * P);
    }
  });
}

// Forces of any state against slices: bonds of any pattern, any opening.
TEST(FlatJoint, ForcesAndEnergyOfAnyState) {
  for_all_divisions([](auto i) {
    i.p.extra_strength = 1e30;
    for (std::uint32_t k = 0; k < 24; ++k) {
      i.s.bonds = static_cast<double>(k % (1u << i.elements));
      i.to(2e-7 * normal(3, Stream::test, k, 0), 0.0, 1e-3 * normal(3, Stream::test, k, 1));
      const auto exact = by_slices(i);
      const double scale = k_n * A * (std::fabs(i.at.closure) + R * std::fabs(i.at.rotation));
      EXPECT_NEAR(i.r.F_n, exact[0], 1e-8 * scale);
      EXPECT_NEAR(i.r.M, exact[1], 1e-8 * scale * R);
      EXPECT_NEAR(i.energy(), exact[2], 1e-8 * scale * scale / (k_n * A));
    }
  });
}

/// A path that breaks and slides, and its work by the mean of the forces before and after each step.
template <int N>
struct Path {
  Interface<N> i;
  double work = 0.0, turnover = 0.0;
  void go(double dc, double ds, double dr) {
    const Reaction<double> before = i.r;
    i.go(dc, ds, dr);
    const double dW =
        0.5 * ((before.F_n + i.r.F_n) * dc - (before.F_s + i.r.F_s) * ds - (before.M + i.r.M) * dr);
    work += dW, turnover += std::fabs(dW);
  }
  double lost() const { return std::fabs(work - i.energy() - i.released - i.dissipated) / turnover; }
};

template <int N>
double imbalance(int steps) {
  Path<N> p;
  for (int k = 1; k <= steps; ++k) {
    const double u = static_cast<double>(k) / steps, last = static_cast<double>(k - 1) / steps;
    const auto closure = [](double s) { return 1e-7 * std::sin(7.0 * s) - 0.5e-7 * s; };
    const auto slide = [](double s) { return 4e-6 * std::sin(5.0 * s); };
    const auto rotation = [](double s) { return 2.5e-3 * std::sin(4.0 * s); };
    p.go(closure(u) - closure(last), slide(u) - slide(last), rotation(u) - rotation(last));
  }
  EXPECT_GE(p.i.n_cracks, N > 1 ? 2 : 1);
  EXPECT_GT(p.i.dissipated, 0.0);
  return p.lost();
}

// Second order in the step: what is left is the trapezoid of an interface that opens or closes within a step.
TEST(FlatJoint, EnergyBalanceOfAPath) {
  EXPECT_LT(imbalance<1>(20000), 1e-9);
  EXPECT_LT(imbalance<2>(20000), 1e-9);
  EXPECT_LT(imbalance<3>(20000), 1e-9);
  EXPECT_LT(imbalance<4>(20000), 1e-9);
  EXPECT_GT(imbalance<3>(2000), 50.0 * imbalance<3>(20000));
}

// However coarse the step in which an element breaks: pulled, bent, and sheared while pressed.
TEST(FlatJoint, ReleasesWhatWentIntoIt) {
  struct Step {
    double dc, ds, dr;
  };
  for (const Step s : {Step{-4e-8, 5e-8, 0.0}, Step{-1e-8, 2e-7, 3e-4}, Step{2e-8, -8e-7, 1e-5}})
    for_all_divisions([&](auto i) {
      Path<decltype(i)::elements> p;
      for (int k = 0; k < 100 && p.i.n_cracks == 0; ++k) p.go(s.dc, s.ds, s.dr);
      ASSERT_GE(p.i.n_cracks, 1);
      EXPECT_GT(p.i.released, 0.0);
      EXPECT_LT(p.lost(), 1e-13);
    });
}

}  // namespace
}  // namespace phy::laws
