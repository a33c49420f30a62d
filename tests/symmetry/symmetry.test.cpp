// What physics does not see must not matter: mirror image, units, numbering of grains.
//
// Scaling by powers of two multiplies every intermediate result by a power of two, so the bits of what has no
// dimension must be the same to the last. A mirror and another numbering reorder sums, so the runs part by
// rounding.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "analysis/analyse.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "study/worker.hpp"

namespace phy {
namespace {

Recipe base_recipe() {
  Recipe r;
  r.specimen = {0.008, 0.016};
  r.packing.n_grains = 330;
  r.matrix.sigma_c = r.matrix.tau_c = 40e6;
  r.bedding = {BeddingRecipe{}};
  r.bedding[0].spacing = 0.002;
  r.test.angles = {30.0};
  r.test.platen_speed = 0.2;
  r.test.n_snapshots = 0;
  return r;
}

const Packing& base_packing() {
  static const Packing packing = [] {
    const Recipe r = base_recipe();
    return genesis::make_packing(r.specimen, r.packing, r.matrix);
  }();
  return packing;
}

TestResult run(const Recipe& r, Packing packing) {
  packing.hash = genesis::packing_hash(packing.discs);
  std::vector<std::shared_ptr<const Specimen>> specimens;
  for (Specimen& s : genesis::make_specimens(std::make_shared<const Packing>(std::move(packing)), r))
    specimens.push_back(std::make_shared<const Specimen>(std::move(s)));
  return study::run_tests(specimens, r, study::MachineOptions{}).front();
}

double ucs(const TestResult& r) { return analysis::find(r.numbers, "ucs")->value; }

/// Lengths by 2^p, stresses by 2^q; densities by 2^s. Time then scales by 2^(p + (s - q)/2).
void expect_scaled(int p, int q, int s) {
  const double L = std::ldexp(1.0, p), S = std::ldexp(1.0, q), D = std::ldexp(1.0, s);
  const double T = std::ldexp(1.0, p + (s - q) / 2);
  Recipe r = base_recipe();
  const TestResult expected = run(r, base_packing());
  Packing packing = base_packing();
  packing.width *= L, packing.height *= L;
  for (Disc& d : packing.discs) d = {L * d.x, L * d.y, L * d.r};
  r.specimen = {packing.width, packing.height};
  r.matrix.density *= D;
  for (double* stress : {&r.matrix.E_c, &r.matrix.E_b, &r.matrix.sigma_c, &r.matrix.sigma_c_sd,
                         &r.matrix.tau_c, &r.matrix.tau_c_sd, &r.bedding[0].sigma_n, &r.bedding[0].cohesion})
    *stress *= S;
  r.bedding[0].k_n *= S / L, r.bedding[0].k_s *= S / L;
  r.bedding[0].spacing *= L, r.bedding[0].zone_thickness *= L;
  r.test.platen_speed *= L / T;
  const TestResult scaled = run(r, std::move(packing));
  ASSERT_EQ(scaled.history.rows.size(), expected.history.rows.size());
  for (std::size_t i = 0; i < expected.history.rows.size(); ++i) {
    const HistoryRow &a = expected.history.rows[i], &b = scaled.history.rows[i];
    ASSERT_EQ(b.axial_strain, a.axial_strain) << "row " << i;
    ASSERT_EQ(b.axial_stress, S * a.axial_stress) << "row " << i;
    ASSERT_EQ(b.lateral_strain_gauge, a.lateral_strain_gauge) << "row " << i;
    ASSERT_EQ(b.time, T * a.time) << "row " << i;
    ASSERT_EQ(b.damping, S * L * L * a.damping) << "row " << i;
  }
  EXPECT_GT(expected.cracks.size(), 20U) << "breakage is to be covered";
  EXPECT_EQ(scaled.cracks.size(), expected.cracks.size());
}

TEST(Units, LengthScaleHasNoEffect) { expect_scaled(3, 0, 0); }
// A field specimen of 16 x 33 m.
TEST(Units, TheSizeOfAQuarryHasNoEffect) { expect_scaled(11, 0, 0); }
TEST(Units, StressScaleHasNoEffect) { expect_scaled(0, -4, 0); }
TEST(Units, DensityScaleHasNoEffect) { expect_scaled(0, 0, 6); }
TEST(Units, AllScalesAtOnceHaveNoEffect) { expect_scaled(-5, 10, 4); }

/// Two runs that may differ by the order of sums only. Without damping (its sign(v) drives neighbouring
/// trajectories apart) they stay together to rounding until the first crack; with it, through breakage, the
/// strength must be the same within chance, which on 330 grains is some per cent.
void expect_same(Recipe r, const std::pair<Packing, double>& one, const std::pair<Packing, double>& other) {
  const auto result = [&](const std::pair<Packing, double>& which) {
    r.test.angles = {which.second};
    return run(r, which.first);
  };
  EXPECT_NEAR(ucs(result(other)) / ucs(result(one)), 1.0, 0.1);
  r.engine.damping = 0.0;
  r.test.history_interval = 20;
  r.test.max_strain = 1e-3;
  const TestResult a = result(one), b = result(other);
  double stress = 0.0, strain = 0.0, largest_stress = 0.0, largest_strain = 0.0;
  std::size_t i = 0;
  for (; i < a.history.rows.size() && a.history.rows[i].n_cracks == 0.0; ++i) {
    const HistoryRow &p = a.history.rows[i], &q = b.history.rows[i];
    EXPECT_EQ(q.n_cracks, 0.0);
    stress = std::max(stress, std::fabs(p.axial_stress - q.axial_stress));
    strain = std::max(strain, std::fabs(p.lateral_strain_gauge - q.lateral_strain_gauge));
    largest_stress = std::max(largest_stress, p.axial_stress);
    largest_strain = std::max(largest_strain, std::fabs(p.lateral_strain_gauge));
  }
  EXPECT_GT(i, 20U);
  EXPECT_LT(stress, 1e-12 * largest_stress);
  EXPECT_LT(strain, 1e-12 * largest_strain);
}

TEST(Units, ALargePackingIsASmallOneMagnified) {
  constexpr double L = 2048.0;
  Recipe r = base_recipe();
  r.specimen.width *= L, r.specimen.height *= L;
  r.packing.radius_min *= L, r.packing.radius_max *= L;
  const Packing large = genesis::make_packing(r.specimen, r.packing, r.matrix);
  const std::vector<Disc>& small = base_packing().discs;
  ASSERT_EQ(large.discs.size(), small.size());
  for (std::size_t i = 0; i < small.size(); ++i) {
    EXPECT_EQ(large.discs[i].x, L * small[i].x) << i;
    EXPECT_EQ(large.discs[i].y, L * small[i].y) << i;
    EXPECT_EQ(large.discs[i].r, L * small[i].r) << i;
  }
}

TEST(Mirror, ThetaAnd180MinusTheta) {
  Packing mirrored = base_packing();
  for (Disc& d : mirrored.discs) d.x = mirrored.width - d.x;
  for (const double theta : {30.0, 60.0, 75.0})
    expect_same(base_recipe(), {base_packing(), theta}, {mirrored, 180.0 - theta});
}

TEST(Numbering, OfGrainsHasNoEffect) {
  Recipe r = base_recipe();
  r.matrix.sigma_c_sd = r.matrix.tau_c_sd = 0.0;  // the scatter is drawn by grain numbers
  const std::size_t n = base_packing().discs.size();
  Packing renumbered = base_packing();
  for (std::size_t i = 0; i < n; ++i) renumbered.discs[i] = base_packing().discs[(i * 7 + 5) % n];
  ASSERT_NE(n % 7, 0U);
  expect_same(r, {base_packing(), 30.0}, {renumbered, 30.0});
}

}  // namespace
}  // namespace phy
