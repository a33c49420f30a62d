#include "engine/stable_step.hpp"

#include <gtest/gtest.h>

#include "base/exact_math.hpp"
#include "base/rng.hpp"
#include "contact/wall.hpp"
#include "engine/small_groups_fixture.hpp"

namespace phy::engine {
namespace {

constexpr GrainInertia both_inertias[] = {GrainInertia::disc, GrainInertia::equal};

Inertia discs(const Specimen& s) { return {*s.packing, GrainInertia::disc}; }

/// Touching discs of two sizes in rows of one size each.
std::vector<Disc> two_sizes() {
  std::vector<Disc> all;
  double y = 0.0, last = 0.0;
  for (int row = 0; row < 10; ++row) {
    const double r = row % 2 == 0 ? 3e-4 : 2e-4;
    y += row == 0 ? 0.0 : last + r, last = r;
    for (int i = 0; i < 12; ++i) all.push_back({2.0 * 3e-4 * i, y, r});
  }
  return all;
}

// The bound is compared with the frequency that the engine itself shows at the edge of stability: a step a
// little below 2/omega_max keeps the energy bounded, which a bound on the unsafe side would not.
void expect_stable_at_full_step(std::vector<Disc> discs, GrainInertia inertia) {
  Specimen s = assembly(std::move(discs), soft_contact());
  bond_touching(s);
  GroupOptions options;
  options.isa = native_isa();
  options.inertia = inertia;
  auto group = make_group(s.packing, options);
  LaneSetup setup;
  setup.damping = 0.0;
  setup.step_safety = 1.0;
  const auto shared = std::make_shared<const Specimen>(s);
  group->load(0, shared, setup);
  for (std::uint32_t i = 0; i < s.packing->discs.size(); ++i)
    group->set_motion(0, i, {}, {1e-6 * normal(1, Stream::test, i, 0), 1e-6 * normal(1, Stream::test, i, 1)},
                      1e-3 * normal(1, Stream::test, i, 2));
  group->advance();
  const double start = group->row(0).kinetic + group->row(0).strain_bond;
  for (int i = 0; i < 100; ++i) group->advance();
  EXPECT_LT(group->row(0).kinetic + group->row(0).strain_bond, 3.0 * start);
}

TEST(FrequencyBound, FullStepIsStable) {
  for (const GrainInertia inertia : both_inertias) {
    expect_stable_at_full_step(hexagonal(12, 12, 3e-4), inertia);
    expect_stable_at_full_step(two_sizes(), inertia);
  }
}

// A chain of grains of two sizes that all weigh the same: along it w^2 = 4 K_n/m; a ring of m r^2 rolls
// against its neighbours with 2 (2 K_s) 2 r^2/(m r^2) = 8 K_s/m where all are as large.
TEST(FrequencyBound, OfEqualMassesIsTheChains) {
  std::vector<Disc> discs;
  for (int i = 0; i < 60; ++i) discs.push_back({6e-4 * i, 0.0, 3e-4});
  Specimen s = assembly(discs, soft_contact());
  bond_touching(s);
  const double mass = s.matrix.density * pi * 9e-8;
  const laws::Tangent<double> k = initial_stiffnesses(contact::models_of(s), s)[0].k;
  // alternating turns bend, equal ones slide
  const double exact = std::max({4.0 * k.k_n, 8.0 * k.k_s, 4.0 * k.k_m / 9e-8}) / mass;
  const Inertia equal(*s.packing, GrainInertia::equal);
  const double bound =
      std::pow(FrequencyBound(s, initial_stiffnesses(contact::models_of(s), s), equal).omega(), 2.0);
  EXPECT_GE(bound, exact * (1.0 - 1e-9));
  EXPECT_LE(bound, 1.3 * exact);
}

TEST(Inertia, OfEqualMassesKeepsThatOfTheRock) {
  const Specimen s = assembly(two_sizes(), soft_contact());
  double mass[2] = {0.0, 0.0};
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < s.packing->discs.size(); ++i)
      mass[k] += Inertia(*s.packing, both_inertias[k]).mass(i, s.matrix.density);
  EXPECT_NEAR(mass[1], mass[0], 1e-12 * mass[0]);
}

// One disc of mass m that rolls on a rough body: k_n along the normal; along the face slide and rotation
// share the one spring k_s, so m w^2 = k_s (1 + m r^2/I) = 3 k_s.
TEST(FrequencyBound, CountsThatADiscRollsOnARoughBody) {
  Specimen s = assembly({{0.0, 3e-4, 3e-4}}, MatrixRecipe{});
  const double mass = s.matrix.density * pi * 9e-8;
  for (const double ratio : {0.2, 1.0})
    for (const double degrees : {0.0, 35.0, 90.0}) {
      s.matrix.ks_over_kn = ratio;
      const double k_n = contact::wall::normal_stiffness(s.matrix);
      Boundary boundary;
      boundary.bodies = {{"face", {{0, plane_normal(degrees), 0.0}}, {}, true}};
      EXPECT_NEAR(std::pow(FrequencyBound(s, {}, discs(s), boundary, 0.5).omega(), 2.0) * mass / k_n,
                  std::max(1.0, 3.0 * ratio), 1e-6);
    }
}

TEST(FrequencyBound, NewContactsOnlyRaiseIt) {
  for (const GrainInertia inertia : both_inertias) {
    Specimen s = assembly(hexagonal(6, 6, 3e-4), soft_contact());
    bond_touching(s);
    FrequencyBound bound(s, initial_stiffnesses(contact::models_of(s), s), {*s.packing, inertia});
    const double before = bound.omega();
    s.matrix = MatrixRecipe{};
    bound.add(stiffness_of(contact::models_of(s), s, {3, 4, ContactKind::touching}, {1.0, 0.0}));
    EXPECT_GT(bound.omega(), before);
    EXPECT_TRUE(bound.loose());
  }
}

// A stiffness that couples is the same spring seen in another frame: turned by alpha, closure' = c closure -
// s slide and slide' = s closure + c slide; by a right angle, what couples closure and rotation couples slide
// and rotation.
TEST(FrequencyBound, DoesNotDependOnTheFrameOfACoupledStiffness) {
  Specimen s = assembly({{0.0, 0.0, 3e-4}, {7e-4, 0.0, 4e-4}}, soft_contact());
  const auto omega = [&](const laws::Tangent<double>& k, Vec2 normal) {
    return FrequencyBound(s, {{0, 1, k, normal, {1.0, 0.0}, 0.0}}, discs(s)).omega();
  };
  const double k_n = 5e9, k_s = 2e9, k_m = 300.0, k_nm = 4e5;
  const double plain = omega({k_n, k_s, k_m}, {1.0, 0.0});
  for (const double degrees : {20.0, 70.0, -45.0}) {
    const SinCos a = sin_cos_degrees(degrees);
    laws::Tangent<double> turned{a.cos * a.cos * k_n + a.sin * a.sin * k_s,
                                 a.sin * a.sin * k_n + a.cos * a.cos * k_s, k_m};
    turned.k_ns = a.cos * a.sin * (k_n - k_s);
    EXPECT_NEAR(omega(turned, {a.cos, a.sin}), plain, 1e-7 * plain) << degrees;
  }
  laws::Tangent<double> closing{k_n, k_s, k_m}, sliding{k_s, k_n, k_m};
  closing.k_nm = sliding.k_sm = k_nm;
  const double coupled = omega(closing, {1.0, 0.0});
  EXPECT_NEAR(omega(sliding, {0.0, 1.0}), coupled, 1e-7 * coupled);
  EXPECT_GT(std::fabs(coupled - plain), 1e-3 * plain);
}

}  // namespace
}  // namespace phy::engine
