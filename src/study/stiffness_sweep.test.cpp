// The sweep on a small packing: which specimens it makes, what lines it lays, what it says when Eq. 1
// refuses.
#include "study/stiffness_sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "statics/uniaxial.hpp"

namespace phy::study {
namespace {

Recipe small_recipe() {
  Recipe r;
  r.specimen = {0.008, 0.016};
  r.packing.n_grains = 340;
  r.bedding.resize(1);
  r.bedding[0].spacing = 0.002;
  r.bedding[0].rule = BeddingRule::crossing;
  r.test.angles = {0.0, 45.0, 90.0};
  r.sweep.factors = {2.0, 0.5, 1.0};
  return r;
}

const SweptPacking& swept() {
  static const SweptPacking s = [] {
    const Recipe r = small_recipe();
    return sweep_stiffness(
        std::make_shared<const Packing>(genesis::make_packing(r.specimen, r.packing, r.matrix)), 1, r,
        BeddingRule::crossing, 2);
  }();
  return s;
}

TEST(StiffnessSweep, SharesTheBaseAndOrdersTheFactors) {
  const SweptPacking& s = swept();
  const BeddingRecipe base = small_recipe().bedding[0];
  EXPECT_EQ(s.sets.size(), 5U);  // 3 + 3, the base once
  for (std::size_t i = 0; i < 3; ++i) {
    const double factor = std::array<double, 3>{0.5, 1.0, 2.0}[i];
    EXPECT_EQ(s.sets[s.swept[0][i]].k_n, factor * base.k_n);
    EXPECT_EQ(s.sets[s.swept[0][i]].k_s, base.k_s);
    EXPECT_EQ(s.sets[s.swept[1][i]].k_n, base.k_n);
    EXPECT_EQ(s.sets[s.swept[1][i]].k_s, factor * base.k_s);
  }
}

TEST(StiffnessSweep, EverySetIsTheDirectSolutionOfItsSpecimen) {
  const SweptPacking& s = swept();
  Recipe r = small_recipe();
  const SweptSet& set = s.sets[s.swept[1][2]];
  r.bedding[0].k_n = set.k_n, r.bedding[0].k_s = set.k_s;
  const Specimen specimen =
      genesis::make_specimen(s.packing, r.matrix, genesis::turned(r.bedding, 45.0), "again");
  statics::ElasticOptions options;
  for (const bool bilateral : {false, true}) {
    options.bilateral = bilateral;
    EXPECT_EQ(statics::solve_uniaxial(specimen, options).E_gauge, set.results[bilateral ? 1 : 0][1].E_gauge);
  }
}

TEST(StiffnessSweep, LinesAreThoseOfTheFits) {
  const SweptPacking& s = swept();
  const MacroReading reading{Contacts::pulling, StrainReading::gauge, theory::Eq1Loss::compliance,
                             theory::Eq1Reference::measured_90};
  const MacroLine line = fit_macro_line(std::span(&s, 1), SweptStiffness::normal, reading);
  ASSERT_EQ(line.slope.n, 1U) << line.refused;
  double K[3];
  for (std::size_t i = 0; i < 3; ++i)
    K[i] = fit_macro(s, s.sets[s.swept[0][i]], reading).rock.K_n_delta / s.spacing;
  EXPECT_LT(K[0], K[1]);
  EXPECT_LT(K[1], K[2]);
  // Three points at k, 2k, 4k: the least-squares slope is (-4 K0 - K1 + 5 K2)/(14 k).
  const double k = 0.5 * small_recipe().bedding[0].k_n;
  EXPECT_NEAR(line.slope.mean, (-4.0 * K[0] - K[1] + 5.0 * K[2]) / (14.0 * k), 1e-9);
  EXPECT_NEAR(line.slope.mean, s.bedding.overlap_ratio, 0.5 * s.bedding.overlap_ratio);
  EXPECT_TRUE(std::isnan(line.slope.half_width));  // one packing has no interval
}

TEST(StiffnessSweep, SoftJointsCarryAllTheStrainWithTheOverlapAsSlope) {
  // Joints a thousand times softer than the rock: at 0 degrees springs k_n sum(A)/L, one per plane, in
  // series.
  Recipe r = small_recipe();
  r.bedding[0].k_n *= 1e-3, r.bedding[0].k_s *= 1e-3, r.bedding[0].spacing = 0.003;
  const SweptPacking s = sweep_stiffness(swept().packing, 1, r, BeddingRule::crossing, 2);
  const SweptSet& base = s.sets[s.swept[0][1]];
  const Specimen level = genesis::make_specimen(s.packing, r.matrix, r.bedding, "level");
  const double n_planes = 5.0;  // of 16 mm, every 3 mm, one through the centre
  const double in_series = base.k_n * level.bedding_report[0].overlap_ratio * r.specimen.height / n_planes;
  EXPECT_NEAR(base.results[1][0].E_platen, in_series, 0.02 * in_series);
}

TEST(StiffnessSweep, SaysWhyThereIsNoLine) {
  Recipe r = small_recipe();
  r.test.angles = {0.0, 80.0, 90.0};
  const SweptPacking s = sweep_stiffness(swept().packing, 1, r, BeddingRule::crossing, 2);
  const MacroLine line = fit_macro_line(std::span(&s, 1), SweptStiffness::shear, {});
  EXPECT_EQ(line.slope.n, 0U);
  EXPECT_NE(line.refused.find("between 20 and 70"), std::string::npos);
}

TEST(StiffnessSweep, ThreadsDoNotMatter) {
  const SweptPacking one = sweep_stiffness(swept().packing, 1, small_recipe(), BeddingRule::crossing, 1);
  for (std::size_t i = 0; i < one.sets.size(); ++i)
    for (const std::size_t c : {0U, 1U})
      for (std::size_t a = 0; a < 3; ++a)
        EXPECT_EQ(one.sets[i].results[c][a].E_gauge, swept().sets[i].results[c][a].E_gauge);
}

}  // namespace
}  // namespace phy::study
