// The press against the direct solution on a small packing, at all angles; the paper's specimen: tests/soak.
#include "study/press_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "statics/uniaxial.hpp"

namespace phy::study {
namespace {

/// About 340 grains in 8 x 16 mm with seven planes, different ratios in contacts and bonds.
Recipe small_recipe() {
  Recipe r;
  r.specimen = {0.008, 0.016};
  r.packing.n_grains = 340;
  r.matrix.bond_ks_over_kn = 0.4;
  r.bedding.resize(1);
  r.bedding[0].spacing = 0.002;
  r.test.angles = {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0};
  r.test.intact = true;
  return r;
}

MachineOptions machine() {
  MachineOptions m;
  m.isa = engine::native_isa();
  m.threads = 2;
  return m;
}

std::vector<Specimen> specimens_of(const Recipe& r) {
  const auto packing =
      std::make_shared<const Packing>(genesis::make_packing(r.specimen, r.packing, r.matrix));
  return genesis::make_specimens(packing, r);
}

struct Both {
  std::vector<ElasticResult> direct;
  std::vector<PressModuli> press;  ///< nothing breaks and nothing slips
};
Both solve_both(const Recipe& r) {
  const std::vector<Specimen> specimens = specimens_of(r);
  return {statics::solve_all(specimens, {}, 2), press_moduli(specimens, r, machine(), true)};
}

class PressCheck : public testing::TestWithParam<BeddingRule> {};

TEST_P(PressCheck, DirectSolutionIsTheSlopeOfThePress) {
  Recipe r = small_recipe();
  r.bedding[0].rule = GetParam();
  r.test.approach_strain = 1e-3, r.test.approach_speed = 1.0;  // of another test: this one has its own speed
  const auto& [direct, press] = solve_both(r);
  ASSERT_EQ(press.size(), 8U);
  for (std::size_t i = 0; i < press.size(); ++i) {
    ASSERT_TRUE(press[i].outcome.empty()) << press[i].outcome;
    EXPECT_EQ(press[i].n_cracks, 0);
    EXPECT_LT(press[i].slip_share, 1e-4);  // contacts that part let go of what shear force they have
    EXPECT_NEAR(press[i].E / direct[i].E_gauge, 1.0, 0.01) << press[i].name;
    EXPECT_NEAR(press[i].nu, direct[i].nu_gauge, 0.01) << press[i].name;
  }
}

INSTANTIATE_TEST_SUITE_P(Rules, PressCheck, testing::Values(BeddingRule::zone, BeddingRule::crossing),
                         [](const auto& rule) {
                           return rule.param == BeddingRule::zone ? "zone" : "crossing";
                         });

// A matrix with directions, with a bedding and without, and with soft layers about the planes.
TEST(PressCheck, DirectSolutionOfAMatrixWithDirections) {
  for (const bool bedded : {false, true}) {
    Recipe r = small_recipe();
    r.matrix.stiffness_ratio = 2.0;
    r.bedding[0].layer_thickness = 0.0008, r.bedding[0].layer_stiffness = 0.8;
    r.test.angles = {0.0, 30.0, 60.0, 90.0};
    r.test.intact = false;
    if (!bedded) r.bedding.clear();
    const auto& [direct, press] = solve_both(r);
    ASSERT_EQ(press.size(), 4U);
    // With joints single contacts that open on the way count in so small a packing, as above.
    const double exact = bedded ? 0.01 : 0.002;
    for (std::size_t i = 0; i < press.size(); ++i) {
      ASSERT_TRUE(press[i].outcome.empty()) << press[i].outcome;
      EXPECT_NEAR(press[i].E / direct[i].E_gauge, 1.0, exact) << press[i].name;
      EXPECT_NEAR(press[i].nu, direct[i].nu_gauge, 0.002) << press[i].name;
    }
    EXPECT_GT(direct[3].E_gauge, 1.2 * direct[0].E_gauge) << "stiff along the foliation";
  }
}

// Flat joints hold in tension as they do in compression, whatever their elements; between planes and intact.
TEST(PressCheck, DirectSolutionOfFlatJoints) {
  Recipe r = small_recipe();
  r.matrix.model = MatrixModel::flat_joint, r.matrix.elements = 2;
  r.matrix.bond_ks_over_kn = MatrixRecipe{}.bond_ks_over_kn;
  r.test.angles = {0.0, 45.0};
  const auto& [direct, press] = solve_both(r);
  ASSERT_EQ(press.size(), 3U);
  for (std::size_t i = 0; i < press.size(); ++i) {
    ASSERT_TRUE(press[i].outcome.empty()) << press[i].outcome;
    EXPECT_NEAR(press[i].E / direct[i].E_gauge, 1.0, 0.005) << press[i].name;
    EXPECT_NEAR(press[i].nu, direct[i].nu_gauge, 0.005) << press[i].name;
  }
}

// The direct solution is that of the uniaxial press, whatever test a recipe names.
TEST(PressCheckAsTheRecipeHasIt, IsOfTheUniaxialPress) {
  Recipe r = small_recipe();
  r.test.angles = {0.0};
  r.test.intact = false;
  const std::vector<Specimen> specimens = specimens_of(r);
  const std::vector<PressModuli> uniaxial = press_moduli(specimens, r, machine(), true);
  r.test.kind = TestKind("direct_tension");
  const std::vector<PressModuli> other = press_moduli(specimens, r, machine(), true);
  EXPECT_EQ(other[0].outcome, "");
  EXPECT_EQ(other[0].E, uniaxial[0].E);
}

TEST(PressCheckAsTheRecipeHasIt, WeakJointsBreakAndSoften) {
  Recipe r = small_recipe();
  r.test.angles = {0.0, 45.0};
  r.test.intact = false;
  r.bedding[0].sigma_n = r.bedding[0].cohesion = 0.5e6;
  r.bedding[0].mu = 0.1;
  const std::vector<Specimen> specimens = specimens_of(r);
  const std::vector<PressModuli> held = press_moduli(specimens, r, machine(), true);
  const std::vector<PressModuli> free = press_moduli(specimens, r, machine(), false);
  EXPECT_EQ(held[1].n_cracks, 0);
  EXPECT_GT(free[1].n_cracks, 10);
  EXPECT_GT(free[1].slip_share, 0.0);
  EXPECT_LT(free[1].E, 0.8 * held[1].E);
}

}  // namespace
}  // namespace phy::study
